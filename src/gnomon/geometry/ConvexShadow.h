// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ConvexHull.h>

#include <array>
#include <cstdint>

namespace gnomon {

/// All points that a convex caster keeps a light from: the caster itself and what lies behind it.
struct ConvexShadow {
    /// Planes with unit normals to the inside; a point is in shadow if it is on the inner side of all of them.
    std::vector<glm::dvec4> planes;
    /// Corners of the hull on the rim between what the light meets and what it does not, in order, counter-clockwise as
    /// seen from the light.
    std::vector<glm::dvec3> silhouette;

    /// On the rim itself, too.
    bool holds(const glm::dvec3& point) const;
};

/// @param light  homogeneous: w = 0 the way towards a sun, of any length; w > 0 a lamp.
/// @return nullopt if there is no shadow: the lamp is inside the hull or in the plane of a plate, or the light is nowhere.
///
/// The planes are those of the faces turned to the light, and one through each edge of the silhouette and the light. Faces
/// that the light grazes count as turned away. Cost  linear in the faces.
std::optional<ConvexShadow> convexShadow(const ConvexHull& hull, const glm::dvec4& light);

/// Clips triangles, with memory that is used again, and tells where each corner comes from.
///
/// Source: I. E. Sutherland and G. W. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974.
class Clipper {
public:
    static constexpr int none = 3; ///< neither of the triangle's three corners nor of its edges.
    /// Edge i of a triangle runs from its corner i to the next one.
    struct Corner {
        glm::dvec3 place;
        int from;  ///< the triangle's corner that it is; or the edge that it is on, `none` inside.
        int plane; ///< that cuts the edge there; -1: it is the triangle's corner.
        int edge;  ///< of the triangle, that leads on from here; `none`: that is one of the planes.
    };
    struct Polygon {
        const Corner* corners;
        std::size_t size;
    };
    /// What of a triangle is on the inner side of all planes: a convex polygon in the triangle's plane, in the triangle's
    /// sense, of fewer than three corners if nothing is. Linear, hence exact. What triangles that share an edge get on it is
    /// the same bit for bit.
    /// @param inside  a bit for each of the first 64 planes that need not be asked. @return until the next call.
    Polygon clip(const std::array<glm::dvec3, 3>& triangle, const std::vector<glm::dvec4>& planes,
                 std::uint64_t inside);

private:
    bool clipBy(const glm::dvec4& plane, int number);
    std::vector<Corner> _polygon, _next;
    std::vector<double> _distances;
    std::size_t _count = 0;
};

} // namespace gnomon
