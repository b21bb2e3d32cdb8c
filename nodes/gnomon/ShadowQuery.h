// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/RayScene.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/ShadowTechnique.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

namespace gnomon {

class ShadowCasterGroup;
struct ShadowProbe;

/// "Is this point lit?", "is this line blocked?": asked of the technique that is drawn, so that the answer is the
/// picture's, or by exact() of rays at the casters whatever is drawn.
///
///     gnomon::ShadowQuery query(*planar, {0, sun});
///     if (query.isLit(player->position())) …
///
/// Points are of the group's frame, in double. It keeps the casters as they were when it was made: make another one
/// when ShadowCasterGroup::revision() has risen.
///
/// Cost    making it: a tree over the casters, see RayScene, unless a TracedShadowTechnique of their group or
///         another query has one, which is shared; a question: about 0.25 µs of one core.
/// Needs   Embree. No OpenGL, no view.
/// Limits  a point does not tell what it belongs to: where a technique names a receiver, its answer holds for points of
///         that. Points on a surface that the light hardly grazes, sine 0.01 or less, may be called either way.
/// Threads any number may ask one query.
class GNOMON_EXPORT ShadowQuery {
public:
    /// @param technique  a child of a ShadowCasterGroup, directly or not; of several groups the first one's.
    /// @throws std::invalid_argument if there is no group above it or the light is nowhere (zero, or not finite).
    /// @throws std::runtime_error, see RayScene.
    ShadowQuery(const ShadowTechnique& technique, const ShadowLight& light);

    /// The same questions, answered by rays at the casters.
    ShadowQuery exact() const;

    bool isLit(const osg::Vec3d& point) const;
    /// True if a caster is between two points; those that they lie on do not count.
    bool isBlocked(const osg::Vec3d& from, const osg::Vec3d& to) const;
    /// Share of a box's volume that is lit, 0 … 1, asked at `side`³ points. @param side  1 … 256; clamped.
    double litShare(const osg::BoundingBoxd& box, unsigned side = 8) const;

    /// Many at once, on all cores: 1 is lit.
    std::vector<std::uint8_t> areLit(const std::vector<osg::Vec3d>& points) const;
    /// From one point to many: 1 is blocked.
    std::vector<std::uint8_t> areBlocked(const osg::Vec3d& from, const std::vector<osg::Vec3d>& to) const;

private:
    ShadowProbe probe() const;

    osg::ref_ptr<const ShadowTechnique> _technique; ///< null: exact.
    osg::ref_ptr<const ShadowCasterGroup> _group;
    osg::ref_ptr<const CasterMesh> _mesh;
    std::shared_ptr<const RayScene> _scene;
    osg::Vec3d _origin;
    glm::dvec4 _light{0.0};
    osg::Matrixd _groupFromTechnique;
    osg::ref_ptr<const osg::Referenced> _answers; ///< of the technique; null: exact.
};

} // namespace gnomon
