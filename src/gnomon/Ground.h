// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace gnomon {

/// A triangle of the ground, counter-clockwise from above.
using GroundTriangle = std::array<glm::dvec3, 3>;

/// Bounds of the ground over a rectangle; see Ground::range().
struct GroundRange {
    double low;         ///< Least height.
    double high;        ///< Greatest height.
    double steepest;    ///< Greatest slope, as a tangent.
    bool holes = false; ///< True if rays may pass through holes there and hit ground behind.
};

/// Terrain that shadows fall on: triangles, z up, in double. groundOf() reads one from a scene graph.
///
/// Use it to ask for heights and slopes and to cast rays at terrain. Most places in plan have one triangle. Places
/// without a triangle are holes.
///
/// Cost
/// - height() and hit() use a spatial structure, and do not visit all triangles.
/// Threads
/// - Any number, once the ground is built.
class GNOMON_EXPORT Ground {
public:
    virtual ~Ground() = default;

    /// Height at a place in plan. nullopt beside the ground and in a hole.
    virtual std::optional<double> height(double x, double y) const = 0;
    /// First point of the ground on a ray, from either side. nullopt if there is none.
    /// @param along  direction, any length but 0. The ray has no end.
    virtual std::optional<glm::dvec3> hit(const glm::dvec3& start, const glm::dvec3& along) const = 0;
    /// Conservative bounds of height, slope and holes over a rectangle in plan. They may include nearby ground.
    /// nullopt if there is no ground.
    virtual std::optional<GroundRange> range(const glm::dvec2& low, const glm::dvec2& high) const = 0;
};

/// True if a post of an elevation model has a height.
///
/// The values -9999, -99999, -32767 and -32768 stand for missing data, as do non-finite values and values beyond 10¹⁸.
/// All are refused, because OpenSceneGraph's readers do not say which of them a file uses.
GNOMON_EXPORT bool isHeight(float value);

} // namespace gnomon
