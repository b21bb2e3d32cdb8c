// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <limits>

namespace gnomon {

class ShadowCasterGroup;

/// What a ShadowTechnique needs to answer for one light and one revision of the casters, without a view.
struct ShadowProbe {
    const RayScene& casters; ///< about `origin`.
    const ShadowCasterGroup& group;
    osg::Vec3d origin; ///< group frame.
    glm::dvec4 light;  ///< about `origin`: w = 0 the way towards a sun, length 1; w = 1 a lamp's position.
    osg::Matrixd groupFromTechnique;             ///< see ViewFrame.
    osg::ref_ptr<const osg::Referenced> answers; ///< the technique's own, see ShadowTechnique::answersFor().

    /// The way to the light; of a lamp the whole way.
    glm::dvec3 towardsLight(const glm::dvec3& point) const {
        return light.w == 0.0 ? glm::dvec3(light) : glm::dvec3(light) - point;
    }
    /// True if no caster is between the light and a point that may lie on a caster.
    ///
    /// A ray that gets through is right. One that does not may have met the surface it starts on, if it grazes that: then
    /// another from further on gets through, and a short one past the point tells which surface it is, and its normal.
    bool reachesFrom(const glm::dvec3& point) const {
        const glm::dvec3 step = casters.margin(point) * glm::normalize(towardsLight(point));
        if (reaches(point + step)) return true;
        if (!reaches(point + 16.0 * step)) return false;
        const RayHit surface = casters.closest({point + 16.0 * step, -32.0 * step, 1.0});
        if (!surface) return false;
        return reaches(casters.lifted(point, glm::dot(surface.normal, step) > 0.0 ? surface.normal : -surface.normal));
    }
    /// True if no caster is between `start` and the light.
    bool reaches(const glm::dvec3& start) const {
        const double infinity = std::numeric_limits<double>::infinity();
        return !casters.blocked({start, towardsLight(start), light.w == 0.0 ? infinity : 1.0});
    }
};

} // namespace gnomon
