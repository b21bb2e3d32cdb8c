// SPDX-License-Identifier: MIT
#include <gnomon/choice/EdgeError.h>

#include <algorithm>
#include <cmath>

namespace gnomon {

double mapEdgeError(const EdgeFilter& filter, double pixelsATexel) {
    return std::hypot(filter.pixel, filter.spread * pixelsATexel);
}

double missedEdgeError(double apart) {
    constexpr double spread = 1.5; // what is off by one distance, as what is off by any up to a limit
    return std::max(sampledEdge, spread * apart);
}

double polygonEdgeError(double pixelsOff) { return std::hypot(sampledEdge, pixelsOff); }

} // namespace gnomon
