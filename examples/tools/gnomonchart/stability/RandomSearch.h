// SPDX-License-Identifier: MIT
#pragma once
#include "RandomScene.h"
#include "StabilityScene.h"

#include <functional>

namespace gnomon::examples {

/// What a search looks through.
struct RandomSearch {
    unsigned first = 1, count = 500; ///< seeds.
    std::vector<StabilityContender> contenders;
    int width = 128, height = 96; ///< of the pictures, pixels.
    unsigned workers = 1;         ///< child processes at a time.
    unsigned batch = 400;         ///< seeds after which faults are told, at least 1.
};

/// A scene in which a technique breaks, as plain as it still does.
struct RandomFault {
    std::string technique;
    unsigned seed = 0;
    RandomScene plainest;
    StabilityCell cell; ///< of the plainest.
};

/// Whether a cell is a catastrophe among random scenes: a crash, a hang, a failure, NaN, or an IoU below 0.5 where more than
/// 200 pixels are shadowed, or wrong away from edges, and no limit is stated. A technique with a receiver of its own is judged there.
bool isRandomFault(const StabilityCell& cell);

/// Measures random scenes, and makes each fault's scene plainer for as long as the fault stays.
/// @param progress  see runStability().
/// @param found     called for each fault, after its batch.
/// @return scenes of which all faults were told; less than search.count if `progress` ended the search.
unsigned searchRandomScenes(const RandomSearch& search,
                            const std::function<bool(std::size_t done, const std::string&)>& progress,
                            const std::function<void(const RandomFault&)>& found);

/// A sentence a fault, with all that makes its scene.
std::string faultText(const RandomFault& fault);

} // namespace gnomon::examples
