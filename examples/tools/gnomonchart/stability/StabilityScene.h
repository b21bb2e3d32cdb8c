// SPDX-License-Identifier: MIT
#pragma once
#include "../measure/Contender.h"
#include "../scenes/ChartScene.h"
#include "StabilityResults.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// A scene that is hard on shadows, at one value of its parameter.
struct StabilityCase {
    ChartScene scene;               ///< drawn by every contender. Its receivers come first in the graph.
    osg::ref_ptr<osg::Group> truth; ///< what rays see; null: the scene's content.
};

/// A scene with one parameter, swept from harmless to hostile.
struct StabilityScene : StabilitySceneText {
    /// @param width,height  of the picture, pixels.
    std::function<StabilityCase(double value, int width, int height)> make;
};

/// All scenes, section by section.
const std::vector<StabilityScene>& stabilityScenes();

/// The scenes of these ids, in the table's order; all without ids.
/// @throws std::invalid_argument, one sentence that lists what is allowed, for an id that no scene has.
std::vector<StabilityScene> stabilityScenes(const std::vector<std::string>& ids);

/// What a run measures.
struct StabilityPlan {
    std::vector<StabilityScene> scenes;
    std::vector<Entrant> contenders; ///< a row each; best settings are looked for at the middle value of each scene.
    int width = 160, height = 120;   ///< of the pictures, pixels.
    double seconds = 60.0;           ///< of processor time for one cell, and 20 times as long by
                                     ///< the clock, truth included: after that it hangs.
    unsigned workers = 1;            ///< child processes at a time.
    std::string folder;              ///< for pictures; empty: none are written.
    std::vector<std::pair<std::string, std::string>> made; ///< how it is made, for the results.
};

/// Gnomon's techniques at their defaults and osgShadow's; at their best, too, if asked for, which of Gnomon's are smooth edges.
/// @param parts  of techniques' names; none: all.
/// @throws std::invalid_argument, one sentence, if one of them is in no technique's name.
std::vector<Entrant> stabilityContenders(const std::vector<std::string>& parts, bool best);

/// Measures the table. Each scene has a child process, which draws all that is drawn: what crashes or hangs there costs
/// its own cell, and another child goes on after it. This process touches neither OpenGL nor rays nor threads, and must
/// not have done so before.
///
/// @param progress  called after each cell and at least once a second, with cells done and what was done last;
///                  false ends the run.
/// @return all that was measured.
/// @throws std::runtime_error, one sentence, if no process can be started.
StabilityResults runStability(const StabilityPlan& plan,
                              const std::function<bool(std::size_t done, const std::string&)>& progress);

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
