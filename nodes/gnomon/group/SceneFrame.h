// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Vec3d>

#include <optional>
#include <string>

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

/// A light in the scene: w is 0 and the direction has length 1, or w is 1. Nullopt if it is nowhere.
std::optional<glm::dvec4> lightInScene(const osg::Vec4d& inGroup, const SceneFrame& scene);

/// Of a lamp that is a spot; nullopt of all others.
std::optional<SpotCone> spotOf(const ShadowLight& light);

/// The cause for ShadowTechnique::report() where there is none.
std::string notUsable(const osg::Vec4d& light);

/// A box and everything behind it as a usable light sees it: each corner, and where its shadow goes. Nullopt if nothing of it
/// is in sight. @param inGroup  group frame.
std::optional<ScreenRect> boundsBehind(const osg::BoundingBoxd& inGroup, const SceneFrame& scene,
                                       const glm::dmat4& clipFromScene, const glm::dvec4& light);

/// The same of casters.
inline std::optional<ScreenRect> shadowBounds(const CasterLayers& casters, const glm::dmat4& clipFromScene,
                                              const glm::dvec4& light) {
    return boundsBehind(casters.bounds, SceneFrame(casters.origin), clipFromScene, light);
}

} // namespace gnomon
