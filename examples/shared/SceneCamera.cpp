// SPDX-License-Identifier: MIT
#include "SceneCamera.h"

#include <algorithm>

namespace gnomon::examples {

namespace {

constexpr double leastNearToFar = 0.0005; // CullSettings' own near-far ratio
constexpr double slack = 1.01;            // so that nothing lies on a plane

struct Depths {
    double near, far;
};

Depths depthsOf(const osg::BoundingBoxd& bounds, const osg::Matrixd& view) {
    double nearest = -(bounds.corner(0) * view).z(), farthest = nearest;
    for (unsigned i = 1; i < 8; ++i) {
        const double depth = -(bounds.corner(i) * view).z();
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const double far = farthest > 0.0 ? farthest * slack : 1.0; // all of it may be behind the camera
    return {std::max(nearest / slack, far * leastNearToFar), far};
}

} // namespace

SceneCamera sceneCamera(const osg::Camera& camera, int width, int height, const osg::BoundingBoxd& bounds) {
    SceneCamera result{camera.getViewMatrix(), camera.getProjectionMatrix(), width, height};
    double fovy, aspect, near, far;
    if (camera.getComputeNearFarMode() == osg::Camera::DO_NOT_COMPUTE_NEAR_FAR || !bounds.valid() ||
        !result.projection.getPerspective(fovy, aspect, near, far))
        return result;
    const Depths depths = depthsOf(bounds, result.view);
    result.projection.makePerspective(fovy, aspect, depths.near, depths.far);
    return result;
}

} // namespace gnomon::examples
