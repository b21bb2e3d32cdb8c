// SPDX-License-Identifier: MIT
#include <gnomon/Ground.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon {

bool isHeight(float value) {
    const float none[] = {-9999.0f, -99999.0f, -32767.0f, -32768.0f};
    return std::abs(value) <= 1e18f && std::find(std::begin(none), std::end(none), value) == std::end(none);
}

} // namespace gnomon
