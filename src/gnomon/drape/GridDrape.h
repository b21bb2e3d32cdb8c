// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/geometry/ConvexShadow.h>
#include <gnomon/geometry/KeyNumbers.h>
#include <gnomon/ground/HeightPyramid.h>

namespace gnomon {

struct ShadowKernel;

/// Triangles by the numbers of their corners, three each.
struct DrapeMesh {
    std::vector<glm::dvec3> corners; ///< what triangles that share a post or an edge have there is one.
    std::vector<unsigned> indices;
};

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
    /// @param error     in plan, see heightError(); 0 is exact.
    /// @param tangent   of the light's elevation.
    /// @return nullptr if the rectangle has too many posts for this to be quick; else triangles about the anchor.
    const DrapeMesh* drape(const HeightPyramid& ground, const Planes& planes, const glm::dvec2& low,
                           const glm::dvec2& high, double error, double tangent, const ShadowKernel& kernel);

private:
    void askPlanes(const ShadowKernel& kernel);
    void visit(int level, int x, int y);
    void take(int left, int low, int side, bool falls);
    void add(std::size_t a, std::size_t b, std::size_t c);
    unsigned numberOfPost(std::size_t post);
    unsigned numberOf(const Clipper::Corner& corner, const std::array<std::size_t, 3>& posts);
    unsigned newNumber(const glm::dvec3& place);
    glm::dvec3 post(std::size_t i) const { return {_x[i], _y[i], _z[i]}; }

    const HeightPyramid* _ground = nullptr;
    const Planes* _planes = nullptr;
    HeightPyramid::Cells _cells{};
    double _off = 0.0;
    std::vector<double> _x, _y, _z, _sides; ///< of the rectangle's posts.
    std::vector<unsigned> _postNumbers;     ///< of those that are corners.
    KeyNumbers<std::uint64_t> _cuts;        ///< places where planes cut edges between posts.
    std::vector<unsigned> _cutNumbers;      ///< of those.
    std::vector<unsigned> _corners;         ///< of one polygon.
    Clipper _clipper;
    DrapeMesh _mesh;
};

} // namespace gnomon
