// SPDX-License-Identifier: MIT
#pragma once
#include "Keys.h"
#include "Town.h"
#include "TownScene.h"
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

/// What a user changes while looking at the town: technique, composite and time of day.
class TownControls {
public:
    explicit TownControls(TownScene& town);

    /// none, box, hull, and on from the first; that of the command line as it was given there.
    void nextTechnique();
    void toggleComposite();
    /// Hours; stops while the sun is up.
    void passTime(double hours);
    /// How things stand, a line each, the keys, and why shadows are missing.
    std::vector<std::string> describe() const;

private:
    TownScene& _town;
    std::vector<ShadowSpec> _choices;
    std::size_t _chosen = 0;
};

const std::vector<Key<TownControls>>& townKeys();

} // namespace gnomon::examples
