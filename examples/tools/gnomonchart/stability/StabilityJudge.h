// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityResults.h"

#include <metrics/PixelSets.h>

namespace gnomon::examples {

/// Judges one picture over the pixels of `within`. A wrong pixel is away from edges if none of the 24 pixels about it is on
/// an edge or truly otherwise: nearer ones are what the boundary's distance measures. Pixels that the truth leaves undecided
/// are not wrong.
StabilityJudgement judge(const metrics::Picture& visibility, const metrics::TruthMaps& truth,
                         const metrics::PixelSets& sets, const metrics::Mask& within);

} // namespace gnomon::examples
