// SPDX-License-Identifier: MIT
#pragma once
#include "../measure/Contender.h"
#include "../scenes/ChartScene.h"
#include "StabilityResults.h"

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

/// Gnomon's techniques at their defaults and osgShadow's, those at their best too if asked for.
/// @param parts  of techniques' names; none: all.
/// @throws std::invalid_argument, one sentence, if one of them is in no technique's name.
std::vector<Entrant> stabilityContenders(const std::vector<std::string>& parts, bool best);

} // namespace gnomon::examples
