// SPDX-License-Identifier: MIT
#pragma once
#include "../measure/Contender.h"
#include "StabilityResults.h"
#include "StabilityScene.h"

namespace gnomon::examples {

/// One row of the table.
struct StabilityContender {
    Contender contender;
    const Peer* sought = nullptr; ///< its best settings are looked for at the middle value of each scene.
};

/// What a run measures.
struct StabilityPlan {
    std::vector<StabilityScene> scenes;
    std::vector<StabilityContender> contenders;
    int width = 160, height = 120;                         ///< of the pictures, pixels.
    double seconds = 60.0;                                 ///< of processor time for one cell, and 20 times as long by
                                                           ///< the clock, truth included: after that it hangs.
    unsigned workers = 1;                                  ///< child processes at a time.
    std::string folder;                                    ///< for pictures; empty: none are written.
    std::vector<std::pair<std::string, std::string>> made; ///< how it is made, for the results.
};

/// Gnomon's techniques at their defaults and osgShadow's, those at their best too if asked for.
/// @param parts  of techniques' names; none: all.
/// @throws std::invalid_argument, one sentence, if one of them is in no technique's name.
std::vector<StabilityContender> stabilityContenders(const std::vector<std::string>& parts, bool best);

} // namespace gnomon::examples
