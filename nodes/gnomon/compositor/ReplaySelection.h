// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/ShadowJob.h>

#include <vector>

namespace gnomon {

/// A leaf to be drawn again, and the lights (bit i: light i) that it loses.
struct ReplayedLeaf {
    DrawnLeaf entry;
    unsigned lost;
};

/// Which leaves must be drawn again so that marked pixels get exactly what a full redraw would give them.
///
/// Left out: leaves whose screen bounds miss `bounds`. If every job names its receiver, marks lie only where a receiver
/// is what one sees; then a plain leaf (see PlainTest) drawn after the last receiver cannot show there and is left out
/// too.
std::vector<ReplayedLeaf> leavesToReplay(const CompositorStage& draw, const std::vector<const ShadowJob*>& jobs,
                                         const ScreenRect& bounds);

/// Leaves that a nested camera lays over the view of a job: no shadow of that view falls on them.
std::vector<ReplayedLeaf> notOfView(const ShadowJob& job, const std::vector<DrawnLeaf>& leaves);

} // namespace gnomon
