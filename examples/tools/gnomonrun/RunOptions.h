// SPDX-License-Identifier: MIT
#pragma once
#include "ViewOptions.h"

#include <string>
#include <vector>

namespace gnomon::examples {

/// What gnomonrun's command line asks for.
struct RunOptions {
    RunOptions();

    ViewOptions view;
    int frames = 0;        ///< after which the program is ended; 0: it ends by itself.
    std::string out;       ///< picture of the last frame; empty: none.
    std::string compare;   ///< folder for the last frame, drawn in every way; empty: none.
    bool diagnose = false; ///< try every technique in turn.
    bool help = false;

    /// Frames in which each technique is tried.
    int framesEach() const { return frames > 0 ? frames : 60; }
};

/// The variables of the environment by which gnomonrun tells its library what to do, and where to say what it met.
constexpr const char* optionsVariable = "GNOMON_RUN_OPTIONS";
constexpr const char* reportVariable = "GNOMON_RUN_REPORT";

/// What the library met in the program, a line each in the report's file.
constexpr const char* metProgram = "program";
constexpr const char* metOsg = "osg"; ///< it needs a library of OpenSceneGraph.
constexpr const char* metSceneView = "sceneview";
constexpr const char* metScene = "scene";
constexpr const char* metFrame = "frame";

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
RunOptions readRunOptions(osg::ArgumentParser& arguments);

/// Options as one text, and back.
std::string joined(const std::vector<std::string>& arguments);
std::vector<std::string> separated(const std::string& arguments);

/// What --help prints.
std::string runHelp();

} // namespace gnomon::examples
