// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/planar/PlanarCasters.h>

#include <OpenThreads/Mutex>

#include <cstddef>

namespace gnomon {

/// The casters above the planes of a PlanarShadowNode, so that no view and no light makes them again.
///
/// Threads
/// - Any number.
class PlanarCasterCache {
public:
    /// The casters above a plane. It searches for solids once they were asked for in a second frame.
    /// @param groupPlane,under  see PlanarCasters.
    /// @param frame             the frame that asks.
    /// @param most              how many it keeps.
    osg::ref_ptr<PlanarCasters> of(const CasterMesh& mesh, const glm::dvec4& groupPlane, bool under, unsigned frame,
                                   std::size_t most);
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    mutable OpenThreads::Mutex _mutex;
    RecentCache<osg::ref_ptr<PlanarCasters>> _entries;
};

} // namespace gnomon
