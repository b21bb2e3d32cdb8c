// SPDX-License-Identifier: MIT
#pragma once
#include "Curves.h"

#include <string>
#include <vector>

namespace gnomon::examples {

/// What one scene says of the techniques, in words.
struct SceneFinding {
    std::string scene, title;
    LightMotion light;
    bool judged = false;      ///< both kits were tried: timed, or failed.
    bool peerBeatsUs = false; ///< a peer's point for which no sound one of Gnomon costs and errs as little.
    bool peerIsAhead = false; ///< and by more than runs differ by: 1 ms or a tenth of it, a tenth of what it errs.
    std::vector<std::string> sentences; ///< plain text.
};

/// Of every scene that has points, its still light first. Catastrophic points neither beat nor are beaten.
std::vector<SceneFinding> findings(const ChartResults& results);

/// The same counted, in a sentence or two.
std::string findingsSummary(const std::vector<SceneFinding>& findings);

} // namespace gnomon::examples
