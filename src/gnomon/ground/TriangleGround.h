// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/GroundSearch.h>

#include <vector>

namespace gnomon {

/// Ground given as loose triangles: a TIN, a tile of any file's, many of them. A tree of boxes finds them.
///
/// Terrain files agree on no winding: a triangle that is clockwise from above is turned. Vertical ones, as in a cliff, have
/// no height, but rays meet them and they are covered like the others: shadows fall on walls as well. Where triangles lie
/// over one another, as at a bridge, height() is that of the highest, and all are covered: what is under the bridge is in
/// the shadow too. Left out are triangles that are a line or a point, or have a corner that is not finite. Without any
/// triangle there is no height, no hit and nothing to cover.
///
/// range() has holes where an edge is of one triangle alone (corners at exactly the same place are one corner), but for the
/// ground's ends on its bounding rectangle, beyond which rays meet nothing; at a wall's edges it may have some, too.
///
/// Cost    24 bytes a vertex, 44 a triangle. Of a grid of 2,000,000, on one core: building 1.0 to 1.4 µs a triangle, a height
///         4 µs, a ray 6 µs.
/// Limits  range() takes seams at which corners do not meet, and ends that are on no side of the bounding rectangle, for holes;
///         it does not tell where rays come in under an end of one of several layers.
class TriangleGround : public Ground {
public:
    /// @param vertices  doubles: coordinates of a map grid lose nothing.
    /// @param indices   three a triangle; a triangle with an index out of the vertices is left out.
    TriangleGround(std::vector<glm::dvec3> vertices, const std::vector<unsigned>& indices);

    std::size_t triangles() const { return _triangles.size(); }

    std::optional<double> height(double x, double y) const override;
    std::optional<glm::dvec3> hit(const glm::dvec3& start, const glm::dvec3& along) const override;
    std::optional<GroundRange> range(const glm::dvec2& low, const glm::dvec2& high) const override;

private:
    using Corners = std::array<unsigned, 3>;
    struct Node {
        GroundBox box;
        double slope = 0.0; ///< steepest.
        bool holes = false; ///< as GroundRange.
    };
    /// A node's place and its triangles. Leaves have up to `leafSize`, and each left half a multiple of it: so the nodes'
    /// places follow from the counts alone.
    struct Part {
        std::size_t node, first, count;
        bool isLeaf() const;
        Part left() const;
        Part right() const;
    };
    static constexpr std::size_t leafSize = 4;

    Part all() const { return {0, 0, _triangles.size()}; }
    GroundTriangle triangle(const Corners& corners) const;
    void findHoles();
    bool isAtHole(const Corners& corners) const;
    std::optional<Corners> upward(const unsigned* corners) const;
    Node leafNode(const Part& part) const;
    void build(const Part& part);
    void split(const Part& part);
    /// Goes down wherever `enter` says so, to the corners of the leaves' triangles.
    template <class Enter, class Take>
    void descend(const Part& part, const Enter& enter, const Take& take) const;

    std::vector<glm::dvec3> _vertices;
    std::vector<bool> _atHole;       ///< for each vertex.
    std::vector<Corners> _triangles; ///< in the order of the tree's leaves.
    std::vector<Node> _nodes;
};

} // namespace gnomon
