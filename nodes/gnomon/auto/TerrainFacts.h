// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoView.h>
#include <gnomon/terrain/GroundRevision.h>

#include <string>

namespace gnomon {

/// What a named receiver is like as terrain.
struct TerrainFacts {
    std::string obstacle; ///< empty: a TerrainShadowGeode draws all of the shadow.
    double off = 0.0;     ///< of a hull's shadow in plan: 95 % of its edges lie within this distance; group's unit.
};

/// Terrain that was looked at last, so that it is read once a revision.
///
/// Threads one at a time.
class TerrainKnowledge {
public:
    /// @param receiver  that the technique names.
    TerrainFacts of(const AutoView& view, const Selection& receiver);

private:
    osg::ref_ptr<const GroundRevision> _drawn;
};

} // namespace gnomon
