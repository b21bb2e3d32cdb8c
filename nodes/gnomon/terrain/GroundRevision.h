// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>
#include <gnomon/Selection.h>

#include <osg/Drawable>
#include <osg/Matrixd>

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

namespace gnomon {

/// The ground in one revision.
struct GroundRevision : public osg::Referenced {
    std::uint64_t revision = 0;
    std::set<const osg::Drawable*> drawables; ///< of all levels of detail; to be told apart from others only.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< see CasterExtraction::getSources().
    bool hasLevels = false; ///< what is drawn may be coarser than this ground, for there are levels of detail.
    std::shared_ptr<const Ground> ground;
    double steepest = 0.0; ///< slope of all of it, as a tangent.

    /// True if some of it may be as steep as a sun's rays, or as that share of their slope: it throws shadows then, wherever
    /// it is turned away from the sun.
    bool isAsSteepAs(const glm::dvec3& towardsSun, double share = 1.0) const;

protected:
    ~GroundRevision() override = default;
};

/// Where the terrain is to be looked for, and in which frame it is wanted.
struct TerrainPlace {
    osg::Node& root;
    Selection terrain; ///< under the root; of it nothing casts.
    osg::Matrixd groundFromRoot;

    /// Under the group, or wherever in the graph, in the group's frame.
    static TerrainPlace inFrameOf(const osg::Node& group, const Selection& terrain);
    /// Fingerprint of what is drawn there, see CasterFingerprint.
    std::uint64_t revision() const;
    /// @param known  may be null. @return `known` itself if nothing changed.
    osg::ref_ptr<const GroundRevision> drawn(const osg::ref_ptr<const GroundRevision>& known) const;
};

} // namespace gnomon
