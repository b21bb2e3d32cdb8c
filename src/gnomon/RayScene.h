// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>

namespace gnomon {

/// Triangles as a caller holds them: nothing is copied before a RayScene is made of it.
struct TriangleSoup {
    const glm::vec3* vertices = nullptr; ///< floats about `origin`.
    std::size_t vertexCount = 0;
    const unsigned* indices = nullptr; ///< three a triangle.
    std::size_t indexCount = 0;
    glm::dvec3 origin{0.0}; ///< in the frame of the rays; near the middle of the triangles, for precision.
    /// Whether a triangle, by its place among those given, is there at a point: `u` and `v` are the point's barycentric
    /// weights of the second and third corner. Rays go on through what is not. Empty: all is solid. Kept as long as the
    /// scene, and asked by any thread that casts rays.
    std::function<bool(unsigned triangle, double u, double v)> solidAt{};
};

/// A ray, or with reach 1 the line from `start` to `start + along`.
struct Ray {
    glm::dvec3 start;
    glm::dvec3 along;                                       ///< any length but 0.
    double reach = std::numeric_limits<double>::infinity(); ///< in lengths of `along`.
};

/// What a ray meets first.
struct RayHit {
    static constexpr unsigned none = ~0u;
    unsigned triangle = none; ///< its place among the triangles given; `none` if nothing is met.
    double distance = std::numeric_limits<double>::infinity(); ///< in lengths of the ray's `along`.
    glm::dvec3 normal{0.0}; ///< geometric, unit; to the side from which the corners go round counter-clockwise.

    explicit operator bool() const { return triangle != none; }
    bool operator==(const RayHit& o) const {
        return triangle == o.triangle && distance == o.distance && normal == o.normal;
    }
};

/// Triangles to cast rays at: the nearest that a ray meets, or whether it meets any. Both faces of a triangle count.
///
/// Embree traverses in single precision about the scene's origin; the distance that is returned is then worked out in
/// double from the ray and the triangle's plane, so that a hit point is as good as the ray.
///
/// Cost    building, of one core: 0.57 µs a triangle of a terrain of 3,000,000, 0.76 of a town of as many; 90 bytes a
///         triangle where corners are shared, 120 where each triangle has three of its own, 30 more while building. A ray:
///         0.1 to 0.35 µs of one core.
/// Needs   Embree 3 (libembree3) on x86-64 with SSE2, or ARM.
/// Limits  a ray is decided with an error of some 10⁻⁶ of the distance between ray and origin: what is thinner is hit or
///         missed by chance, and so is a surface that the ray starts on; see lifted(). Triangles of no area, with
///         corners that are not finite or beyond 10¹⁸, or with indices out of the vertices are left out. A ray that is
///         not finite or goes nowhere meets nothing.
/// Threads any number at once ask one scene. The bulk calls use all cores, by TBB, and give the same bits as single ones.
/// Source: I. Wald et al., "Embree: A Kernel Framework for Efficient CPU Ray Tracing", ACM TOG 33(4), 2014;
///         RTC_SCENE_FLAG_ROBUST against rays slipping through shared edges.
class RayScene {
public:
    /// Told how much of the building is done, 0 … 1, now and then, from the threads that build, perhaps several at once.
    using ProgressLine = std::function<void(double)>;

    /// @throws std::runtime_error, one sentence, if Embree cannot start or there is not enough memory.
    explicit RayScene(const TriangleSoup& triangles, const ProgressLine& progress = {});
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    RayHit closest(const Ray& ray) const;
    bool blocked(const Ray& ray) const;

    /// `count` rays at once; `hits` and `answers` have as many places; 1 is blocked.
    void closest(const Ray* rays, std::size_t count, RayHit* hits) const;
    void blocked(const Ray* rays, std::size_t count, std::uint8_t* answers) const;

    /// A start for a ray that leaves a surface of this scene, so that it does not meet the surface itself: `point` moved
    /// along `normal` by 256 steps of a float of the size of each coordinate about the origin, or of a 16th of the
    /// scene's reach() where the coordinate is smaller.
    ///
    /// Moves a point at the edge of a scene of 100 m by no more than 2 mm, one near its middle by 0.1 mm.
    /// @param normal  unit, geometric, to the side on which the ray leaves.
    /// Source: C. Wächter and N. Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems,
    /// 2019, ch. 6. Theirs takes 1/65536 unit near the origin, which holds for one unit only: here the scene's size rules.
    glm::dvec3 lifted(const glm::dvec3& point, const glm::dvec3& normal) const;

    /// The largest step that lifted() takes along any axis there: how far to move a start along a direction that is no
    /// normal. lifted() itself must not be given one, for its steps differ from axis to axis and turn it.
    double margin(const glm::dvec3& point) const;

    /// Triangles that were left out.
    std::size_t leftOut() const;
    /// Half of the longest side of the bounds, about the origin: 0 for an empty scene.
    double reach() const;

private:
    struct Embree;
    const std::unique_ptr<Embree> _embree;
};

} // namespace gnomon
