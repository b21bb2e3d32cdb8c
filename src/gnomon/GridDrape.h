// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ConvexShadow.h>
#include <gnomon/Drape.h>
#include <gnomon/HeightPyramid.h>

namespace gnomon {

/// drape() on a grid where the shadow is known to lie in a rectangle: planes are asked at its posts, all posts at once, and
/// what no plane cuts is not clipped. Memory is used again for the next one.
class GridDrape {
public:
    /// Planes of a shadow about an anchor, on their inner sides at least 0; of any length.
    struct Planes {
        glm::dvec3 anchor{0.0};
        std::vector<glm::dvec4> about;
    };
    /// @param low,high  of the rectangle in plan, about the anchor.
    /// @param error     in plan, see heightError(). @param tangent  of the light's elevation.
    /// @return nullptr if the rectangle has too many posts for this to be quick; else triangles about the anchor.
    const Drape* drape(const HeightPyramid& ground, const Planes& planes, const glm::dvec2& low, const glm::dvec2& high,
                       double error, double tangent);

private:
    void askPlanes();
    void visit(int level, int x, int y);
    void take(int left, int low, int side, bool falls);
    void add(std::size_t a, std::size_t b, std::size_t c);
    glm::dvec3 post(std::size_t i) const { return {_x[i], _y[i], _z[i]}; }

    const HeightPyramid* _ground = nullptr;
    const Planes* _planes = nullptr;
    HeightPyramid::Cells _cells{};
    double _off = 0.0;
    std::vector<double> _x, _y, _z, _sides; ///< of the rectangle's posts.
    Clipper _clipper;
    Drape _triangles;
};

} // namespace gnomon
