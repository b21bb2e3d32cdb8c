// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>

#include <glm/vec2.hpp>

#include <vector>

namespace gnomon {

/// How a cell becomes two triangles, or none.
enum class CellCut : unsigned char {
    rising,  ///< from its lower left to its upper right corner.
    falling, ///< from its upper left to its lower right corner.
    hole
};

/// Where the posts of a regular grid stand.
struct GridPosts {
    int columns, rows;       ///< at least 2 of each.
    glm::dvec2 origin, step; ///< of the first post and between posts, any unit; step > 0.
    double base = 0.0;       ///< that heights are about.
};

/// Ground given by its height on a regular grid, z up. Each cell is two triangles, cut from its lower left to its upper
/// right corner unless told otherwise; a cell with a height that is not finite at a corner is a hole.
///
/// Cost 4 bytes a post, and one a cell where cuts are given.
class HeightField {
public:
    /// @param heights  row by row, the row of the least y first.
    /// @param cuts     cell by cell as the heights; empty: all are rising.
    /// @throws std::invalid_argument, one sentence, if the numbers do not fit.
    HeightField(const GridPosts& posts, std::vector<float> heights, std::vector<CellCut> cuts = {});

    int columns() const { return _posts.columns; }
    int rows() const { return _posts.rows; }
    /// Cell, or post, below and to the left of a place; may be beside the grid.
    glm::dvec2 cellOf(double x, double y) const { return (glm::dvec2(x, y) - _posts.origin) / _posts.step; }
    bool isHole(int x, int y) const; ///< of a cell.
    /// As given: a rising or falling cell may still be a hole by its heights.
    CellCut cut(int x, int y) const {
        return _cuts.empty() ? CellCut::rising : _cuts[std::size_t(y) * std::size_t(columns() - 1) + std::size_t(x)];
    }
    const glm::dvec2& origin() const { return _posts.origin; }
    const glm::dvec2& step() const { return _posts.step; }
    glm::dvec3 post(int x, int y) const {
        const float height = _heights[std::size_t(y) * std::size_t(columns()) + std::size_t(x)];
        return {origin().x + x * step().x, origin().y + y * step().y, _posts.base + double(height)};
    }
    /// The two triangles of a cell.
    std::array<GroundTriangle, 2> triangles(int x, int y) const;
    /// Heights of their planes over a place in the cell, the lower one's first. @param u,v  0 … 1 along x and y.
    std::array<double, 2> planesOver(int x, int y, double u, double v) const;
    /// nullopt beside the ground and in a hole.
    std::optional<double> height(double x, double y) const;

private:
    GridPosts _posts;
    std::vector<float> _heights;
    std::vector<CellCut> _cuts;
};

/// The height field that triangles are, where they are one: a regular grid along x and y whose cells are two triangles each,
/// cut along either diagonal, or a hole. Their order and winding do not matter. Vertical triangles that hang from its posts,
/// the skirts of terrain tiles, are left out.
///
/// @param vertices,indices  as TriangleGround's.
/// @param tolerance  how far off its place a corner may be along each axis, scene's unit; never more than 1/1000 of a step.
/// @return nullopt for all else. Heights are floats about the middle of their range.
///
/// Cost  one pass over the triangles.
std::optional<HeightField> gridOf(const std::vector<glm::dvec3>& vertices, const std::vector<unsigned>& indices,
                                  double tolerance);

} // namespace gnomon
