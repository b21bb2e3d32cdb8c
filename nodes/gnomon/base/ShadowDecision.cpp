// SPDX-License-Identifier: MIT
#include <gnomon/ShadowDecision.h>

#include <sstream>

namespace gnomon {

std::string ShadowDecision::text() const {
    std::ostringstream line;
    line.precision(2);
    line << "light " << light << ": " << chosen.spec << ", predicted " << chosen.error << " px and " << chosen.time
         << " ms; " << reason;
    return line.str();
}

} // namespace gnomon
