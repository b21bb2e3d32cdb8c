// SPDX-License-Identifier: MIT
#pragma once
#include "../scenes/ChartScene.h"

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
struct StabilityScene {
    std::string id;             ///< "L7"
    std::string section;        ///< "light"
    std::string title;          ///< a few words.
    std::string about;          ///< one sentence: what is hard, and what is right.
    std::string parameter;      ///< what the values are.
    std::string unit;           ///< of the values; empty: none.
    std::vector<double> values; ///< from harmless to hostile.
    /// @param width,height  of the picture, pixels.
    std::function<StabilityCase(double value, int width, int height)> make;
};

/// All scenes, section by section.
const std::vector<StabilityScene>& stabilityScenes();

/// The scenes of these ids, in the table's order; all without ids.
/// @throws std::invalid_argument, one sentence that lists what is allowed, for an id that no scene has.
std::vector<StabilityScene> stabilityScenes(const std::vector<std::string>& ids);

} // namespace gnomon::examples
