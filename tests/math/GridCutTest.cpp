// SPDX-License-Identifier: MIT
// Polygons cut along a grid's triangles: areas and heights in closed form, no gaps.
#include <gnomon/drape/GridCut.h>
#include <gnomon/ground/GroundIntersection.h>
#include <gtest/gtest.h>

#include <set>

namespace {

/// On the edge of a convex polygon, to rounding.
bool isOnBorder(const std::vector<glm::dvec3>& polygon, const glm::dvec3& a, const glm::dvec3& b) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        if (std::abs(gnomon::doubleArea(from, to, a)) + std::abs(gnomon::doubleArea(from, to, b)) < 1e-9) return true;
    }
    return false;
}

/// Each edge of a triangle is that of another one, the other way round, by the same two corners, or on the border: so
/// there are no gaps, and no corner of one piece is within an edge of another.
void expectNoGaps(const gnomon::DrapeMesh& mesh, const std::vector<glm::dvec3>& polygon) {
    std::set<std::pair<unsigned, unsigned>> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        EXPECT_TRUE(edges.insert({mesh.indices[i], mesh.indices[i % 3 == 2 ? i - 2 : i + 1]}).second);
    for (const auto& [a, b] : edges)
        EXPECT_TRUE(edges.count({b, a}) || isOnBorder(polygon, mesh.corners[a], mesh.corners[b])) << a << ' ' << b;
}

gnomon::HeightField cutField(const std::vector<gnomon::CellCut>& cuts) {
    std::vector<float> heights;
    for (int i = 0; i < 42; ++i) heights.push_back(float(i * i % 17));
    return {7, 6, {-20.0, 5.0}, {10.0, 8.0}, heights, 100.0, cuts};
}

const std::vector<glm::dvec3> hexagon = {{-9.0, 20.0, 0.0}, {3.0, 9.0, 0.0},   {29.0, 11.0, 0.0},
                                         {36.0, 24.0, 0.0}, {21.0, 39.0, 0.0}, {-2.0, 35.0, 0.0}};

} // namespace

TEST(GridCut, PiecesAreOnTheGroundAndShareTheirCorners) {
    for (const auto cut : {gnomon::CellCut::rising, gnomon::CellCut::falling}) {
        const gnomon::HeightField field = cutField(std::vector<gnomon::CellCut>(30, cut));
        gnomon::GridCut cutter;
        const gnomon::DrapeMesh& mesh = cutter.cut(field, hexagon);
        for (const glm::dvec3& corner : mesh.corners) EXPECT_NEAR(corner.z, *field.height(corner.x, corner.y), 1e-9);
        expectNoGaps(mesh, hexagon);
        double area = 0.0, expected = 0.0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return mesh.corners[mesh.indices[i + k]]; };
            const glm::dvec3 middle = (at(0) + at(1) + at(2)) / 3.0;
            EXPECT_NEAR(middle.z, *field.height(middle.x, middle.y), 1e-9);
            area += gnomon::doubleArea(at(0), at(1), at(2));
        }
        for (std::size_t i = 2; i < hexagon.size(); ++i)
            expected += gnomon::doubleArea(hexagon[0], hexagon[i - 1], hexagon[i]);
        EXPECT_NEAR(area, expected, 1e-9 * expected);
    }
}

/// A corner on a post, edges along lines of the grid and along a diagonal: nothing is cut there.
TEST(GridCut, LeavesAloneWhatEndsAtTheGridsLines) {
    const gnomon::HeightField field = cutField({});
    gnomon::GridCut cutter;
    const std::vector<glm::dvec3> triangle = {{0.0, 13.0, 0.0}, {10.0, 13.0, 0.0}, {10.0, 21.0, 0.0}};
    const gnomon::DrapeMesh& mesh = cutter.cut(field, triangle);
    EXPECT_EQ(mesh.indices.size(), 3u);
    EXPECT_EQ(mesh.corners.size(), 3u);
    for (const glm::dvec3& corner : mesh.corners) EXPECT_EQ(corner.z, *field.height(corner.x, corner.y));
}

TEST(GridCut, LeavesOutHoles) {
    std::vector<gnomon::CellCut> cuts(30, gnomon::CellCut::rising);
    cuts[2 * 6 + 2] = gnomon::CellCut::hole; // x 0 to 10, y 21 to 29
    const gnomon::HeightField field = cutField(cuts);
    gnomon::GridCut cutter;
    const std::vector<glm::dvec3> square = {{-5.0, 20.0, 0.0}, {15.0, 20.0, 0.0}, {15.0, 30.0, 0.0}, {-5.0, 30.0, 0.0}};
    const gnomon::DrapeMesh& mesh = cutter.cut(field, square);
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return mesh.corners[mesh.indices[i + k]]; };
        area += gnomon::doubleArea(at(0), at(1), at(2)) / 2.0;
        const glm::dvec3 middle = (at(0) + at(1) + at(2)) / 3.0;
        EXPECT_FALSE(middle.x > 0.0 && middle.x < 10.0 && middle.y > 21.0 && middle.y < 29.0);
    }
    EXPECT_NEAR(area, 20.0 * 10.0 - 10.0 * 8.0, 1e-9);
}
