// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/mapfit/PlacedTriangles.h>

#include <glm/vec2.hpp>

#include <array>
#include <functional>
#include <vector>

namespace gnomon {

/// Some thousand rays that are points in a picture, so that a triangle is tested only with those that may meet it. It is for
/// a look at a mesh that is seen once: a tree over the mesh would take longer to make.
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

    /// A ray on a triangle, by their numbers.
    struct Met {
        std::size_t ray, triangle;
        double reach;      ///< in lengths of the ray's way; below 0 behind its start.
        glm::dvec3 normal; ///< of any length, to either side.
    };
    using Hit = std::function<void(const Met&)>;
    /// Calls `hit` for each ray and each triangle that it meets.
    void meet(const PlacedTriangles& triangles, const Hit& hit) const;

private:
    static constexpr int bins = 64; ///< on a side.
    struct Rect {
        glm::dvec2 low, high;
    };
    static int binOf(double at);
    bool anyIn(const Rect& rect) const;
    void meet(std::size_t triangle, const std::array<glm::dvec3, 3>& corners, const Rect& rect, const Hit& hit) const;

    glm::dmat4 _pictureFromScene;
    std::vector<Ray> _rays;
    std::vector<std::size_t> _order;  ///< numbers of the rays, bin by bin, row by row.
    std::vector<std::size_t> _starts; ///< of each bin in `_order`, and the end.
};

} // namespace gnomon
