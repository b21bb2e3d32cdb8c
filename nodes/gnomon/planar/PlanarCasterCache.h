// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/planar/PlanarCasters.h>

#include <OpenThreads/Mutex>

#include <cstddef>
#include <unordered_map>

namespace gnomon {

/// The casters above the planes of a PlanarShadowNode, so that no view and no light makes them again, nor what of them has
/// not changed.
///
/// Threads
/// - Any number.
class PlanarCasterCache {
public:
    /// The casters above a plane. It searches for solids in those meshes that were asked for in an earlier frame.
    /// @param groupPlane,under  see PlanarCasters.
    /// @param frame             the frame that asks.
    /// @param most              how many it keeps.
    osg::ref_ptr<PlanarCasters> of(const CasterLayers& layers, const glm::dvec4& groupPlane, bool under, unsigned frame,
                                   std::size_t most);
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    osg::ref_ptr<PlanarCasters> make(const CasterLayers& layers, const glm::dvec4& groupPlane, bool under,
                                     unsigned frame);
    osg::ref_ptr<const PlanarMesh> wholeOf(const CasterMesh& mesh, unsigned frame);

    mutable OpenThreads::Mutex _mutex;
    RecentCache<osg::ref_ptr<PlanarCasters>> _entries;
    std::unordered_map<const CasterMesh*, osg::ref_ptr<const PlanarMesh>> _wholes; ///< of bodies, which these hold.
};

} // namespace gnomon
