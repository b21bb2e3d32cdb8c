// SPDX-License-Identifier: MIT
#pragma once
#include "CommandLine.h"
#include <metrics/CauseSplit.h>

namespace gnomon::examples {

/// What gnomoncompare is asked for.
struct CompareOptions {
    std::string casting, notCasting, truth; ///< files; all three are needed
    std::string shadowed;                   ///< file; empty: `ambient` everywhere
    double ambient = 0.0;
    std::string overlay, json; ///< files to write; empty: none
    metrics::CauseLimits limits;
    bool help = false;
};

/// @throws std::invalid_argument, one sentence, for what cannot be used.
CompareOptions readCompareOptions(osg::ArgumentParser& arguments);
std::string compareHelp();

} // namespace gnomon::examples
