// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CullableFaces.h>

#include <osg/State>
#include <osg/ref_ptr>

#include <cstddef>
#include <unordered_map>

namespace gnomon {

/// Bodies as maps draw them, wherever they are: one a geometry. See CasterBodies.
///
/// Threads
/// - One at a time. The owner locks.
class MapBodies {
public:
    /// A picture begins, in which solids are looked for in some of those that move.
    void startPicture() { _searched = 0; }
    /// All faces, or the solids of one that moves and has been drawn before.
    osg::ref_ptr<const CullableFaces> of(const CasterMesh& mesh, bool moving);
    /// The faces with solids told apart.
    osg::ref_ptr<const CullableFaces> solidsOf(const CasterMesh& mesh);
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
    std::size_t _searched = 0; ///< triangles, in this picture.
};

} // namespace gnomon
