// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>
#include <gnomon/Selection.h>

#include <osg/Drawable>

#include <cstdint>
#include <memory>
#include <set>
#include <vector>

namespace gnomon {

/// The ground in one revision.
struct GroundRevision : public osg::Referenced {
    std::uint64_t revision = 0;               ///< fingerprint of what is drawn there, see CasterFingerprint.
    std::set<const osg::Drawable*> drawables; ///< of all levels of detail; to be told apart from others only.
    std::vector<osg::ref_ptr<const osg::Referenced>> sources; ///< see CasterExtraction::getSources().
    bool hasLevels = false; ///< what is drawn may be coarser than this ground, for there are levels of detail.
    std::shared_ptr<const Ground> ground;
    double steepest = 0.0; ///< slope of all of it, as a tangent.

protected:
    ~GroundRevision() override = default;
};

/// Terrain as it is drawn now, group's frame.
/// @param terrain  under the group, or anywhere in its graph.
/// @param known    may be null. @return `known` itself if nothing changed.
osg::ref_ptr<const GroundRevision> groundRevision(const osg::Node& group, const Selection& terrain,
                                                  const osg::ref_ptr<const GroundRevision>& known);

} // namespace gnomon
