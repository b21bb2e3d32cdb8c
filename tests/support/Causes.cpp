// SPDX-License-Identifier: MIT
#include <support/Causes.h>

#include <algorithm>

namespace test {

std::vector<std::string> causesButLitSurfaces(const gnomon::ShadowTechnique& technique) {
    std::vector<std::string> causes = technique.diagnose();
    const auto isOfLitSurface = [](const std::string& cause) {
        return cause.find("which this technique leaves lit") != std::string::npos;
    };
    causes.erase(std::remove_if(causes.begin(), causes.end(), isOfLitSurface), causes.end());
    return causes;
}

} // namespace test
