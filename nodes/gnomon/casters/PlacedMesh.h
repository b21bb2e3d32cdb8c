// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>

#include <glm/mat4x4.hpp>
#include <osg/BoundingBox>
#include <osg/ref_ptr>

namespace gnomon {

/// A mesh of casters at a place. Scene: the group's axes about the origin of its CasterLayers.
///
/// A body keeps its mesh while it moves, and shares it with all bodies of the same geometry. Keep what you derive of the
/// triangles by the mesh, and take lights and planes into its frame.
struct PlacedMesh {
    osg::ref_ptr<const CasterMesh> mesh;
    glm::dmat4 sceneFromMesh{1.0}; ///< Affine and invertible, from the mesh's vertices. Identity for what is no body.
    bool isBody = false;           ///< It moves as a whole.
    bool mirrored = false;         ///< What is counter-clockwise in the mesh is clockwise in the scene.
    double stretched = 1.0;        ///< The most by which sceneFromMesh lengthens anything.
    double rounding = 0.0;         ///< Largest error of a vertex by its float source, group's unit.
    Hiding hiding = Hiding::Both;  ///< Of a body; what is joined has its own for each drawable.
    osg::BoundingBoxd bounds;      ///< Of its triangles, group frame.
    bool ownDrawn = false;         ///< A body that maps draw by its own state: see CasterDrawable.
};

} // namespace gnomon
