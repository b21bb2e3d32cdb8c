// SPDX-License-Identifier: MIT
#pragma once
#include "Town.h"
#include "ViewOptions.h"

namespace gnomon::examples {

/// What arl_terrain's command line asks for.
struct TownOptions {
    ViewOptions view;      ///< one shadow, one of townTechniques(); the picture's size.
    std::string elevation; ///< file of the elevation model.
    double hour = 9.0;     ///< solar time.
    double sunSpeed = 0.0; ///< of the window's sun, 1 is the clock's.
    TownPlan plan;
    std::string out;    ///< picture; empty: none.
    std::string report; ///< folder for pictures; empty: none.
    bool help = false;
};

/// none, box, hull.
const std::vector<std::string>& townTechniques();

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
TownOptions readTownOptions(osg::ArgumentParser& arguments);

/// What --help prints.
std::string townHelp();

} // namespace gnomon::examples
