// SPDX-License-Identifier: MIT
#pragma once
#include "ViewOptions.h"

#include <optional>
#include <string>

namespace gnomon::examples {

/// What gnomonshot's command line asks for.
struct ShotOptions {
    ViewOptions view;
    std::optional<int> frames; ///< 1, or 20 with stats.
    std::string out;           ///< picture; empty: none.
    std::string stats;         ///< JSON file; empty: none.
    std::string truth;         ///< file of what is true; empty: none.
    bool recommend = false;    ///< print what could draw the shadows.
    bool help = false;

    int frameCount() const { return frames.value_or(stats.empty() ? 1 : 20); }
};

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
ShotOptions readShotOptions(osg::ArgumentParser& arguments);

/// What --help prints.
std::string shotHelp();

} // namespace gnomon::examples
