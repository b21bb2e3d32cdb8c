// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>
#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/ground/BoxMethod.h>

#include <array>
#include <string>
#include <vector>

namespace gnomon {

/// A convex part of a caster as hullSolids() takes it; the same in every light.
struct HullPart {
    glm::dvec3 anchor{0.0};         ///< one of its corners, the ground's frame.
    std::vector<glm::vec3> corners; ///< all of them, about the anchor: floats are off by 10⁻⁷ of its size at most.
    std::vector<glm::vec4> faces;   ///< planes outwards, about the anchor.
    double size = 0.0;              ///< from the anchor to its farthest corner.
    glm::dvec4 front{0.0};          ///< see ConvexPart, about the anchor; (0, 0, 0, 0): none.

    HullPart() = default;
    explicit HullPart(const ConvexPart& part);
};

/// What became of a caster's shadow.
enum class HullOutcome : unsigned char {
    cast,        ///< it is there.
    boxed,       ///< that of the bounding box, which is not the caster's own.
    lightInside, ///< all of the ground is dark, for the lamp is inside the part, or in its surface.
    unseen,      ///< none of its own: edge on, turned away behind another plate, or in the ground.
    lightBelow,  ///< none, for the light is not above the horizon, or is a lamp in the ground.
    noGround     ///< none, for it meets no ground.
};
constexpr std::size_t hullOutcomes = 6;

/// Shadows as closed solids: what of the ground is inside one is in shadow, on whatever level of detail or storey. A solid
/// begins at the silhouette of a convex part, inside the part, and follows the light down until all of the ground that it
/// could meet is above it.
///
/// A vertex is a place about the origin, and how far it goes on away from the light, in lengths of `light.w * place -
/// light.xyz`: below 0 without an end. So the same vertices serve a sun that has turned a little: see HullSolids::turn.
struct HullSolids {
    glm::dvec3 origin{0.0}; ///< ground's frame.
    glm::dvec4 light{0.0};  ///< about the origin; w = 0: of length 1.
    std::vector<glm::vec4> vertices;
    /// Three a triangle, counter-clockwise from outside: of each layer in turn sides and beginnings, then of each the
    /// ends. Nothing in a layer overlaps.
    std::vector<unsigned> corners;
    std::vector<unsigned> sides, ends; ///< where those of each layer end, in `corners`.
    unsigned mostOver = 0;             ///< not more solids hold any one point.
    glm::dvec3 low{0.0}, high{0.0};    ///< bounds of all, about the origin.
    double widest = 0.0;               ///< the longest shadow, across.
    double largest = 0.0;              ///< the largest caster, across.
    double turn = 0.0;                 ///< by how much a sun may turn, in radians, until some end is above the ground.
    std::array<std::size_t, hullOutcomes> outcomes{};

    /// How many of them a place is in, as they are drawn. @param place  ground's frame.
    int around(const glm::dvec3& place) const;
};

/// A ground, and how far from it, as a share of a shadow's diameter, what is drawn of it may be.
struct HullGround {
    const Ground& ground;
    double margin;
    GroundRange all; ///< of all of it. No ground: low > high.
    bool hasStoreys; ///< there may be ground below ground.

    explicit HullGround(const Ground& of, double margin = 0.05);
};

/// @param light   homogeneous, ground's frame: w = 0 the way towards a sun, w > 0 a lamp.
///
/// Cost    of a house 4 to 20 triangles, its silhouette, and a few questions to the ground's bounds.
/// Limits  exact for convex parts. What is behind the first crest that all of a shadow meets is left out.
/// Threads any number.
HullSolids hullSolids(const HullGround& ground, const std::vector<HullPart>& parts, const glm::dvec4& light,
                      const glm::dvec3& origin);

/// The same of the pentagons of boxShadow(): upright, through all of the ground about them.
HullSolids boxSolids(const HullGround& ground, const std::vector<BoxCaster>& boxes, const glm::dvec4& light,
                     const glm::dvec3& origin);

/// Whether there is no light for the ground: a sun that is not above the horizon, or a lamp in the ground.
bool isLightBelow(const Ground& ground, const glm::dvec4& light);

} // namespace gnomon
