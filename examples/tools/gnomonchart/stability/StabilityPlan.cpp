// SPDX-License-Identifier: MIT
#include "StabilityPlan.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

/// A specification without keys.
bool isAtDefaults(const Contender& contender) {
    for (const auto& [name, value] : contender.settings)
        if (name == "--shadow" && value.find(':') != std::string::npos) return false;
    return true;
}

} // namespace

std::vector<StabilityContender> stabilityContenders(const std::vector<std::string>& parts, bool best) {
    requireKnown(parts);
    std::vector<StabilityContender> chosen;
    for (Contender& contender : gnomonContenders()) {
        if (!isAtDefaults(contender) || !isAsked(contender.technique, parts)) continue;
        contender.setting = "defaults";
        chosen.push_back({std::move(contender)});
    }
    for (const Peer& peer : peers()) {
        if (!isAsked(peer.name, parts)) continue;
        chosen.push_back({peerContender(peer, "defaults", {})});
        if (best && !peer.knobs.empty()) chosen.push_back({peerContender(peer, "best", {}), &peer});
    }
    if (chosen.empty())
        throw std::invalid_argument("no technique whose name contains \"" + parts.front() +
                                    "\" has defaults. See --list.");
    return chosen;
}

} // namespace gnomon::examples
