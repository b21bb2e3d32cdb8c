// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CullableFaces.h>

#include <osg/State>
#include <osg/ref_ptr>

#include <unordered_map>

namespace gnomon {

/// Bodies as maps draw them, wherever they are: one a geometry. See CasterBodies.
///
/// Threads
/// - One at a time. The owner locks.
class MapBodies {
public:
    /// @param again  see MapLayer::faces().
    osg::ref_ptr<const CullableFaces> of(const CasterMesh& mesh, bool again);
    /// Lets go what nobody else draws.
    void prune();
    void resizeGLObjectBuffers(unsigned maxSize) const;
    void releaseGLObjects(osg::State* state) const;

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh;             // held, so that its address cannot be taken by another
        osg::ref_ptr<const CullableFaces> whole, solids; ///< null until they are asked for.
    };

    std::unordered_map<const CasterMesh*, Entry> _known;
};

} // namespace gnomon
