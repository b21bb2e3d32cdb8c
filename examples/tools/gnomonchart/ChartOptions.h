// SPDX-License-Identifier: MIT
#pragma once
#include "ViewOptions.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// What gnomonchart's command line asks for.
struct ChartOptions {
    ViewOptions view;                         ///< files, and how they are seen; its size is that of all pictures.
    std::vector<std::string> scenes;          ///< names of built-in ones.
    std::vector<std::string> techniques;      ///< parts of techniques' names; none: all.
    std::string out = "chart-out";            ///< folder.
    std::string again;                        ///< folder of results to be drawn again; empty: measure.
    std::optional<int> frames;                ///< 60, or 12 with quick.
    std::optional<int> flicker;               ///< frames of each film; 16, or 8 with quick; none below 2.
    bool resume = false;                      ///< go on with what is in `out`.
    bool stability = false;                   ///< the stability table, of the scenes in stabilityScenes.
    std::vector<std::string> stabilityScenes; ///< ids; empty: all.
    bool model = false;                       ///< judge techniques on the files against rays instead.
    std::optional<unsigned> random;           ///< search so many random scenes instead.
    unsigned seed = 1;                        ///< of the first of them.
    bool quick = false, list = false, help = false;

    int frameCount() const { return frames.value_or(quick ? 12 : 60); }
    int flickerFrames() const { return flicker.value_or(quick ? 8 : 16); }
};

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
ChartOptions readChartOptions(osg::ArgumentParser& arguments);

/// What --help prints.
std::string chartHelp();

} // namespace gnomon::examples
