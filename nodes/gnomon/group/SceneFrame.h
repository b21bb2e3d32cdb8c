// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/group/ViewFrame.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Vec3d>

namespace gnomon {

/// The frame in which a technique computes: the group's axes about an origin near the casters.
///
/// Floats about this origin are fine enough for casters that stand far from the group's own origin. Matrices to and from
/// this frame say Scene: clipFromScene, mapFromScene, coneFromScene.
struct SceneFrame {
    explicit SceneFrame(const glm::dvec3& about) : origin(about) {}
    explicit SceneFrame(const osg::Vec3d& about) : origin(toGlm(about)) {}

    glm::dvec3 origin; ///< Group frame.

    /// Takes the scene to a view's clip space.
    glm::dmat4 clipFromScene(const ViewFrame& view) const {
        return glm::translate(toGlm(view.eyeFromGroup * view.projection), origin);
    }
    /// Takes the scene to a view's eye space.
    glm::dmat4 eyeFromScene(const ViewFrame& view) const { return glm::translate(toGlm(view.eyeFromGroup), origin); }
    /// Takes a view's eye space to the scene.
    osg::Matrixd sceneFromEye(const ViewFrame& view) const {
        return osg::Matrixd::inverse(view.eyeFromGroup) * osg::Matrixd::translate(-origin.x, -origin.y, -origin.z);
    }

    /// A point of the group's frame, in the scene.
    glm::dvec3 point(const osg::Vec3d& inGroup) const { return toGlm(inGroup) - origin; }
    /// A plane of the group's frame, in the scene. @param inGroup  unit normal.
    glm::dvec4 plane(const glm::dvec4& inGroup) const { return {glm::dvec3(inGroup), distance(inGroup, origin)}; }
};

} // namespace gnomon
