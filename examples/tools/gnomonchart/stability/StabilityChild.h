// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityScene.h"

#include <nlohmann/json.hpp>

#include <functional>

namespace gnomon::examples {

/// A place in a scene's part of the table.
struct StabilityPlace {
    std::size_t contender = 0;
    int value = -1; ///< -1: before the first, where the best settings are looked for.
};

/// Measures one scene from a place on; runs in the child, and tells its parent a line of JSON each:
///     {"begin": [contender, value]}     before anything is done there
///     {"cell": …}                       what came of it
///     {"settings": [["size", "4096"]]}  what came of the search for the best
///     {"film": [contender, value]}      after the last value, if the child made all: before the film at this one
///     {"flicker": …}                    what came of it
/// @param settings  of the contender there, if they have been found.
/// @param say       sends a line.
void measureScene(const StabilityPlan& plan, const StabilityScene& scene, StabilityPlace from, const Settings& settings,
                  const std::function<void(const nlohmann::ordered_json&)>& say);

} // namespace gnomon::examples
