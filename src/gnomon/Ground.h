// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace gnomon {

using GroundTriangle = std::array<glm::dvec3, 3>; ///< counter-clockwise from above.

/// A bit for each of the first 64 planes.
using PlaneSet = std::uint64_t;

struct GroundRange {
    double low, high, steepest; ///< tangent of the slope.
    bool holes = false;         ///< rays may pass through holes there, and meet ground behind.
};

/// What shadows fall on: triangles, z up, mostly one over each place in plan. Where there is none is a hole.
///
/// Threads any number, once built.
class Ground {
public:
    virtual ~Ground() = default;

    /// nullopt beside the ground and in a hole.
    virtual std::optional<double> height(double x, double y) const = 0;
    /// Where a ray meets the ground first, from either side. @param along  any length but 0; the ray has no end.
    virtual std::optional<glm::dvec3> hit(const glm::dvec3& start, const glm::dvec3& along) const = 0;
    /// Triangles that stand for the ground to within `error` of its height, each point of it once in plan, wherever a
    /// point of them may be on the inner side of all `planes` (unit normals); others may be left out.
    /// @param error  scene's unit; 0 gives the ground's own triangles.
    /// @param take   gets a triangle, and some of the planes that all of it is on the inner side of.
    virtual void cover(const std::vector<glm::dvec4>& planes, double error,
                       const std::function<void(const GroundTriangle&, PlaneSet)>& take) const = 0;
    /// Tangent of the steepest slope where the ground may be on the inner side of all planes; 0 if it is nowhere.
    virtual double steepest(const std::vector<glm::dvec4>& planes) const = 0;
    /// No point of the ground over a rectangle in plan is lower, higher or steeper, and no hole is there that it does not tell;
    /// nullopt if there is no ground. Quick: others about may be taken for it.
    virtual std::optional<GroundRange> range(const glm::dvec2& low, const glm::dvec2& high) const = 0;
};

} // namespace gnomon
