// SPDX-License-Identifier: MIT
#pragma once
#include "ViewOptions.h"

namespace gnomon::examples {

/// What gnomonviewer's command line asks for.
struct ViewerOptions {
    ViewOptions view;
    double sunSpeed = 0.0; ///< 1 is the clock's.
    bool help = false;
};

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
ViewerOptions readViewerOptions(osg::ArgumentParser& arguments);

/// What --help prints.
std::string viewerHelp();

} // namespace gnomon::examples
