// SPDX-License-Identifier: MIT
#include <gnomon/ShadowReport.h>
#include <gnomon/base/NumberText.h>

#include <sstream>

namespace gnomon {
namespace {

std::string counted(unsigned number, const std::string& one, const std::string& several) {
    return std::to_string(number) + " " + (number == 1 ? one : several);
}

} // namespace

std::string ShadowReport::text() const {
    std::ostringstream line;
    line << technique << ": " << counted(lights, "light", "lights") << ", " << counted(marks, "mark", "marks");
    if (marks > 0) line << " within " << static_cast<long long>(pixels + 0.5) << " pixels";
    line << ", " << counted(passes, "pass", "passes") << ", cull " << roundedText(cull) << " ms, draw " << roundedText(draw)
         << " ms";
    return line.str();
}

} // namespace gnomon
