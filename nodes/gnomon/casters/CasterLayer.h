// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/PlacedMesh.h>

#include <osg/Referenced>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <cstddef>
#include <vector>

namespace gnomon {

class CasterBodies;

/// Some of a group's casters as meshes. Never changed once made.
struct CasterLayer : public osg::Referenced {
    /// Reads the graph as a cull traversal does.
    /// @param origin  of the scene, group frame.
    /// @param before  layers whose joined meshes are taken where they would be the same; may be null.
    CasterLayer(CasterDrawables::List pieces, const osg::Vec3d& origin, CasterBodies& bodies,
                const std::vector<const CasterLayer*>& before);

    const CasterDrawables::List pieces; ///< In the order in which a traversal meets them.
    const osg::Vec3d origin;            ///< Of the scene, group frame.
    CasterDrawables::List loosePieces;  ///< Those that are no bodies.
    osg::ref_ptr<CasterMesh> loose;     ///< These, joined, in the scene; null if there are none.
    std::vector<PlacedMesh> meshes;     ///< The joined one, if there is one, and all bodies.
    std::size_t triangles = 0;          ///< Of all.

protected:
    ~CasterLayer() override = default;

private:
    void join(const std::vector<const CasterLayer*>& before);
};

} // namespace gnomon
