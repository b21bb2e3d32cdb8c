// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace gnomon {

/// A mesh of others, at a place in the scene.
struct PlacedTriangles {
    const glm::vec3* corners;
    std::size_t cornerCount;
    const unsigned* indices; ///< three a triangle.
    std::size_t count;       ///< of the triangles.
    glm::dmat4 sceneFromMesh;
    std::vector<std::size_t> parts; ///< the first triangle of each object, ascending.
};

/// A box at a place in the scene.
struct PlacedBox {
    glm::dvec3 low, high;
    glm::dmat4 sceneFromBox{1.0};
};

/// Some thousand rays that are points in a picture, so that a triangle is tested only with those that may meet it. It is for
/// a look at casters that are seen once: a tree over them would take longer to make.
///
/// Cost  some 50 ns a triangle, and as much for each ray in its rectangle.
class RayBins {
public:
    /// In the scene.
    struct Ray {
        glm::dvec3 from, way;
        glm::dvec2 at; ///< in the picture; rays outside 0 to 1 meet nothing.
    };

    /// @param pictureFromScene  homogeneous; takes all that a ray meets to the ray's point.
    RayBins(const glm::dmat4& pictureFromScene, std::vector<Ray> rays);

    /// A ray on a surface.
    struct Met {
        std::size_t ray;
        std::size_t side;    ///< number of the triangle; of a box twice the axis, and 1 for its far end.
        double reach;        ///< in lengths of the ray's way; below 0 behind its start.
        glm::dvec3 normal;   ///< of any length, to either side.
        bool inside = false; ///< of a box: the ray starts in it.
    };
    using Hit = std::function<void(const Met&)>;
    /// Calls `hit` for each ray and each triangle that it meets.
    void meet(const PlacedTriangles& triangles, const Hit& hit) const;
    /// Calls `hit` for each ray that meets the box: where it goes in, or out, if it starts inside.
    void meet(const PlacedBox& box, const Hit& hit) const;

private:
    static constexpr int bins = 64; ///< on a side.
    static int binOf(double at);
    bool anyIn(const ScreenRect& rect) const;
    template <class Visit>
    void eachIn(const ScreenRect& rect, const Visit& visit) const;
    void meet(std::size_t triangle, const std::array<glm::dvec3, 3>& corners, const ScreenRect& rect,
              const Hit& hit) const;

    glm::dmat4 _pictureFromScene;
    std::vector<Ray> _rays;
    std::vector<std::size_t> _order;  ///< numbers of the rays, bin by bin, row by row.
    std::vector<std::size_t> _starts; ///< of each bin in `_order`, and the end.
};

} // namespace gnomon
