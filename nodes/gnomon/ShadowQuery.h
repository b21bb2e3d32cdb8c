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

class Casters;
class ShadowCasterGroup;
struct ShadowProbe;

/// Answers "is this point lit?" and "is this line blocked?" without drawing.
///
/// Use it for game logic and simulation: can the guard see the player, how much sun does the field get.
/// A query asks the drawn technique, so its answers match the picture. exact() asks rays at the casters.
///
///     gnomon::ShadowQuery query(*planar, {0, sun});
///     if (query.isLit(player->position())) player->hide();
///
/// Points are in the group's frame, in double. A query keeps the casters of the time when it was made. Make another one
/// when ShadowCasterGroup::revision() has risen.
///
/// Cost
/// - To make one: a ray tree over the casters, see RayScene. Queries and TracedShadowTechnique share trees.
/// - To ask: a ray, less than a microsecond.
/// Needs
/// - Embree: see OptionalPart::Traced. No OpenGL and no view.
/// Limits
/// - It has no view: the most detailed children of an LOD cast.
/// - Casters that draw themselves, or are made of patches, are not asked. Those that are clear in part let light through where
///   TracedShadowTechnique does, also if the technique takes them as solid.
/// - If the technique names a receiver, its answers hold for points on that receiver only.
/// - Points on a surface that the light grazes (sine 0.01 or less) may get either answer. Those at the terminator of a smooth
///   body get that of its facets: see ShadowCasterGroup::setTerminatorOffset().
/// Threads
/// - Any number may ask one query.
class GNOMON_EXPORT ShadowQuery {
public:
    /// Reads the casters as they are now. Call it where the graph may be read.
    /// @param technique  a technique below a ShadowCasterGroup, directly or not. If it is below several, the first one
    ///                   counts.
    /// @param light      the light to ask about.
    /// @throws std::invalid_argument if no group is above the technique, or the light is zero or not finite.
    /// @throws std::runtime_error if Embree is missing or fails, see RayScene, or if this build lacks what the technique
    ///         needs, see ShadowTechnique::whyUnavailable().
    ShadowQuery(const ShadowTechnique& technique, const ShadowLight& light);
    /// Copies share what they have found.
    ShadowQuery(const ShadowQuery& other);
    /// As a copy.
    ShadowQuery& operator=(const ShadowQuery& other);
    ~ShadowQuery();

    /// The same query, answered by rays at the casters, whatever technique is drawn.
    ShadowQuery exact() const;

    /// True if the light reaches a point.
    bool isLit(const osg::Vec3d& point) const;
    /// True if a caster is between two points. Surfaces that the points lie on do not count.
    bool isBlocked(const osg::Vec3d& from, const osg::Vec3d& to) const;
    /// Lit share of a box's volume, 0 … 1. Asks side³ points, on all cores.
    /// @param side  1 … 256. Clamped.
    double litShare(const osg::BoundingBoxd& box, unsigned side = 8) const;

    /// Asks for many points at once, on all cores.
    /// @return one value a point: 1 lit, 0 in shadow.
    std::vector<std::uint8_t> areLit(const std::vector<osg::Vec3d>& points) const;
    /// Asks for lines from one point to many, on all cores.
    /// @return one value a line: 1 blocked, 0 free.
    std::vector<std::uint8_t> areBlocked(const osg::Vec3d& from, const std::vector<osg::Vec3d>& to) const;

private:
    ShadowProbe probe() const;

    osg::ref_ptr<const ShadowTechnique> _technique; ///< null: exact.
    osg::ref_ptr<const ShadowCasterGroup> _group;
    osg::ref_ptr<const Casters> _casters;
    std::shared_ptr<const RayScene> _scene;
    osg::Vec3d _origin;
    glm::dvec4 _light{0.0};
    osg::Matrixd _groupFromTechnique;
    osg::ref_ptr<const osg::Referenced> _answers; ///< of the technique; null: exact.
};

} // namespace gnomon
