// SPDX-License-Identifier: MIT
#include <gnomon/ShadowDecision.h>

#include <sstream>

namespace gnomon {

std::string ShadowDecision::subject() const {
    return "light " + std::to_string(light) + (receivers.empty() ? "" : ", receivers " + receivers);
}

std::string ShadowDecision::text() const {
    std::ostringstream line;
    line.precision(2);
    line << subject() << ": " << chosen.spec << ", predicted " << chosen.error << " px and " << chosen.time << " ms; "
         << reason;
    return line.str();
}

} // namespace gnomon
