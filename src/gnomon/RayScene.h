// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace gnomon {

/// Triangles in the caller's memory, to make a RayScene from. The RayScene copies them.
struct TriangleSoup {
    const glm::vec3* vertices = nullptr; ///< Floats relative to `origin`.
    std::size_t vertexCount = 0;         ///< Number of vertices.
    const unsigned* indices = nullptr;   ///< Three a triangle.
    std::size_t indexCount = 0;          ///< Number of indices.
    glm::dvec3 origin{0.0};              ///< Frame of the rays. Choose it near the triangles' middle, for precision.
    /// How far each vertex moves away from a light before it blocks it, as many as vertices: see terminatorOffsets().
    /// Null: not at all. For Ray::toLight.
    const glm::vec4* terminatorOffsets = nullptr;
    /// True if a triangle is solid at a point. Rays pass through other points. Default, empty: all is solid.
    /// `triangle` counts the given triangles; `u` and `v` are the barycentric weights of the second and third corner.
    /// The scene keeps the function, and calls it from any thread that casts rays.
    std::function<bool(unsigned triangle, double u, double v)> solidAt{};
};

/// A ray. With reach 1 it is the line from `start` to `start + along`.
struct Ray {
    glm::dvec3 start;                                       ///< Start point.
    glm::dvec3 along;                                       ///< Direction, any length but 0.
    double reach = std::numeric_limits<double>::infinity(); ///< End of the ray, in lengths of `along`.
    bool toLight = false; ///< blocked() lets it pass where TriangleSoup::terminatorOffsets say so.
};

/// The first triangle on a ray.
struct RayHit {
    static constexpr unsigned none = ~0u;                      ///< Value of `triangle` without a hit.
    unsigned triangle = none;                                  ///< Index among the given triangles of its part.
    unsigned part = 0;                                         ///< Index among the parts; 0 in a scene without parts.
    double distance = std::numeric_limits<double>::infinity(); ///< In lengths of the ray's `along`.
    glm::dvec3 normal{0.0}; ///< Geometric unit normal, to the side that sees the corners counter-clockwise.

    /// True if there is a hit.
    explicit operator bool() const { return triangle != none; }
    /// True if both are the same hit, to the bit.
    bool operator==(const RayHit& o) const {
        return triangle == o.triangle && part == o.part && distance == o.distance && normal == o.normal;
    }
};

class RayScene;

/// A scene at a place in another one: a body that moves as a whole, or one of many that are alike.
struct PlacedRayScene {
    std::shared_ptr<const RayScene> scene; ///< Without parts of its own.
    glm::dmat4 outerFromInner{1.0};        ///< Affine and invertible, to the frame of the outer scene's rays.
};

/// Casts rays at triangles: finds the first triangle on a ray, or whether there is any.
///
/// Use it for ray casting without a scene graph. ShadowQuery asks the same of a ShadowCasterGroup.
///
///     const gnomon::RayScene scene(soup);
///     const gnomon::RayHit hit = scene.closest({eye, direction});
///     if (hit) drawCross(eye + hit.distance * direction);
///
/// Both faces of a triangle count. Embree traverses in single precision about the scene's origin. The distance is then
/// computed in double from the ray and the triangle's plane, so a hit point is as precise as the ray. A triangle behind
/// the ray's start in double is never hit, however large it is.
///
/// Cost
/// - To build: less than a microsecond a triangle on one core. If only parts moved, their tree of two levels alone.
/// - Memory: 90 bytes a triangle if corners are shared, 120 if not, and 30 more while building.
/// - To cast: less than a microsecond a ray on one core.
/// Needs
/// - Embree 3 or 4 on x86-64 with SSE2, or ARM: see OptionalPart::Traced.
/// Limits
/// - A triangle's edges are right to about 10⁻⁶ of the distance between ray and origin. Smaller triangles are hit or
///   missed by chance.
/// - A ray may hit the surface that it starts on. Start it at lifted().
/// - Leaves out triangles without area, with a corner that is not finite or beyond 10¹⁸, or with an index out of range.
/// - A ray that is not finite or has no direction hits nothing.
/// Threads
/// - Any number may ask one scene. The bulk calls use all cores and give the same bits as single calls.
/// Source
/// - I. Wald et al., "Embree: A Kernel Framework for Efficient CPU Ray Tracing", ACM TOG 33(4), 2014.
/// - RTC_SCENE_FLAG_ROBUST keeps rays from slipping through shared edges.
class GNOMON_EXPORT RayScene {
public:
    /// Receives the finished share of a build, 0 … 1. The building threads call it, possibly several at once.
    using Progress = std::function<void(double)>;

    /// Builds the tree.
    /// @throws std::runtime_error with one sentence if Embree is missing or cannot start, or there is not enough memory.
    explicit RayScene(const TriangleSoup& triangles, const Progress& progress = {});
    /// Builds a tree of two levels over scenes that are there: a microsecond a part. It shares their triangles.
    /// Parts with a matrix that is not affine, finite and invertible are left out, and so are empty ones.
    /// @throws std::runtime_error as above, and std::invalid_argument if a part is null or has parts.
    explicit RayScene(const std::vector<PlacedRayScene>& parts);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Finds the first triangle on a ray.
    RayHit closest(const Ray& ray) const;
    /// True if any triangle is on a ray. A ray of finite reach ends before a triangle whose plane holds its end, to 10⁻⁶
    /// of the coordinates: a lamp in a ceiling is not blocked by the ceiling.
    bool blocked(const Ray& ray) const;

    /// Casts `count` rays on all cores. `hits` has room for as many.
    void closest(const Ray* rays, std::size_t count, RayHit* hits) const;
    /// Casts `count` rays on all cores. `answers` has room for as many: 1 blocked, 0 free.
    void blocked(const Ray* rays, std::size_t count, std::uint8_t* answers) const;

    /// Moves a point off a surface of this scene, so that a ray from there does not hit the surface.
    ///
    /// Each coordinate moves along the normal by eight float steps of its size about the origin. The least size is a 16th
    /// of the middle triangle's distance from the origin. In a scene of 100 m, a point moves by less than 0.1 mm.
    /// @param normal  geometric unit normal, to the side on which the ray leaves.
    ///
    /// Source
    /// - C. Wächter and N. Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019,
    ///   ch. 6. Near the origin, this function uses the scene's size and not a fixed 1/65536 unit.
    glm::dvec3 lifted(const glm::dvec3& point, const glm::dvec3& normal) const;

    /// Largest step of lifted() at a point, along any axis. Use it to move a start along a direction that is no normal.
    /// Do not pass such a direction to lifted(): its steps differ by axis and would turn the direction.
    double margin(const glm::dvec3& point) const;

    /// Number of triangles left out.
    std::size_t leftOut() const;
    /// Half of the longest side of the triangles' bounds. 0 for an empty scene.
    double reach() const;
    /// Longest side of a triangle. 0 for an empty scene.
    double longestSide() const;

private:
    struct Embree;
    const std::unique_ptr<Embree> _embree;
};

} // namespace gnomon
