// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/SceneProps.h>
#include <osg/BoundingBox>
#include <osg/Camera>
#include <osg/MatrixTransform>
#include <osg/Matrixd>

namespace gnomon::examples {

/// A camera of fixed near and far planes.
struct SceneCamera {
    osg::Matrixd view, projection;
    int width = 0, height = 0; ///< pixels.
};

/// What a camera sees. Where it leaves near and far to OpenSceneGraph, they stand close around `bounds`, near never closer
/// than 1/2000 of far, as OpenSceneGraph itself has it.
SceneCamera sceneCamera(const osg::Camera& camera, int width, int height, const osg::BoundingBoxd& bounds);

} // namespace gnomon::examples
