// SPDX-License-Identifier: MIT
// Grids found in loose triangles, cells cut either way, against the triangles themselves.
#include "Compare.h"
#include "GroundTriangles.h"

#include <gnomon/ground/HeightField.h>
#include <gnomon/ground/HeightPyramid.h>

#include <algorithm>

using gnomon::CellCut;
using gnomon::gridOf;
using gnomon::GroundTriangle;
using gnomon::HeightField;
using gnomon::HeightPyramid;
using gnomon::test::near;
using gnomon::test::Random;
using test::LooseTriangles;

namespace {

constexpr int columns = 60, rows = 40;
const glm::dvec2 step(10.0, 12.5);

/// Rough ground in which each cell is cut as chance will have it, some left out.
HeightField mixed(const glm::dvec2& origin) {
    Random random(1);
    std::vector<float> heights;
    for (int i = 0; i < columns * rows; ++i) heights.push_back(float(random.between(-3.0, 3.0)));
    std::vector<CellCut> cuts;
    for (int i = 0; i < (columns - 1) * (rows - 1); ++i)
        cuts.push_back(CellCut(std::min(2, int(random.between(0.0, 2.1)))));
    return {{columns, rows, origin, step, 500.0}, heights, cuts};
}

std::optional<HeightField> gridIn(std::vector<GroundTriangle> triangles, double tolerance = 1e-6) {
    std::shuffle(triangles.begin(), triangles.end(), std::mt19937(2));
    const LooseTriangles loose(triangles);
    return gridOf(loose.vertices, loose.indices, tolerance);
}

/// 3 × 3 posts 1 apart, level.
std::vector<GroundTriangle> small() { return test::trianglesOf({{3, 3, {}, {1.0, 1.0}}, std::vector<float>(9, 0.0f)}); }

} // namespace

TEST(TriangleGrid, FindsTheGridThatTrianglesWereCutFromInAnyOrder) {
    for (const glm::dvec2& origin : {glm::dvec2(0.0), glm::dvec2(433000.3, 5410000.7)}) {
        const HeightField expected = mixed(origin);
        const auto found = gridIn(test::trianglesOf(expected));
        ASSERT_TRUE(found);
        ASSERT_EQ(found->columns(), columns);
        ASSERT_EQ(found->rows(), rows);
        for (int y = 0; y + 1 < rows; ++y)
            for (int x = 0; x + 1 < columns; ++x) {
                ASSERT_EQ(found->cut(x, y), expected.cut(x, y)) << x << ", " << y;
                if (expected.isHole(x, y)) continue;
                // Floats of up to 3.
                EXPECT_TRUE(near(found->post(x, y), expected.post(x, y), 2e-7));
            }
    }
}

TEST(HeightPyramid, OfCellsCutEitherWayIsTheGroundOfItsTriangles) {
    const HeightPyramid grid(mixed({}));
    const gnomon::TriangleGround triangles = LooseTriangles(test::trianglesOf(grid.field())).ground();
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 at(random.between(0.0, 590.0), random.between(0.0, 487.0), 520.0);
        const auto height = grid.height(at.x, at.y), expected = triangles.height(at.x, at.y);
        ASSERT_EQ(bool(height), bool(expected));
        EXPECT_NEAR(height.value_or(0.0), expected.value_or(0.0), 1e-9);
        const glm::dvec3 along(random.between(-9.0, 9.0), random.between(-9.0, 9.0), -1.0);
        const auto hit = grid.hit(at, along), expectedHit = triangles.hit(at, along);
        ASSERT_EQ(bool(hit), bool(expectedHit));
        EXPECT_TRUE(near(hit.value_or(at), expectedHit.value_or(at), 1e-9));
    }
}

TEST(TriangleGrid, LeavesSkirtsOut) {
    std::vector<GroundTriangle> triangles = small();
    for (int i = 0; i < 2; ++i) {
        triangles.push_back({glm::dvec3(i, 0, 0), glm::dvec3(i + 1, 0, 0), glm::dvec3(i, 0, -5)});
        triangles.push_back({glm::dvec3(2, i, -5), glm::dvec3(2, i + 1, 0), glm::dvec3(2, i + 1, -5)});
    }
    const auto grid = gridIn(triangles);
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->height(0.5, 0.0), 0.0);
}

namespace {

std::vector<GroundTriangle> smallWith(const std::vector<GroundTriangle>& more) {
    std::vector<GroundTriangle> all = small();
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

std::vector<GroundTriangle> smallWithoutItsLast() {
    std::vector<GroundTriangle> fewer = small();
    fewer.pop_back();
    return fewer;
}

std::vector<GroundTriangle> smallWithACornerOffBy(double distance) {
    std::vector<GroundTriangle> moved = small();
    moved[3][1].x += distance;
    return moved;
}

std::vector<GroundTriangle> smallTurned() {
    std::vector<GroundTriangle> turned = small();
    for (GroundTriangle& t : turned)
        for (glm::dvec3& corner : t)
            corner = {0.8 * corner.x - 0.6 * corner.y, 0.6 * corner.x + 0.8 * corner.y, corner.z};
    return turned;
}

} // namespace

TEST(TriangleGrid, IsNoneInTrianglesThatAreSpoilt) {
    const struct {
        const char* name;
        std::vector<GroundTriangle> triangles;
        double tolerance = 1e-6;
    } cases[] = {
        {"no triangles", {}},
        {"one half of a cell twice", smallWith({small().front()})},
        {"one over another", smallWith({{glm::dvec3(0, 0, 5), glm::dvec3(1, 0, 5), glm::dvec3(0, 1, 5)}})},
        {"a wall that stands up", smallWith({{glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, 0, 5)}})},
        {"a wall between posts", smallWith({{glm::dvec3(0.5, 0, 0), glm::dvec3(0.5, 1, 0), glm::dvec3(0.5, 0, -5)}})},
        {"a wide cell", smallWith({{glm::dvec3(2, 0, 0), glm::dvec3(4, 0, 0), glm::dvec3(4, 1, 0)},
                                   {glm::dvec3(2, 0, 0), glm::dvec3(4, 1, 0), glm::dvec3(2, 1, 0)}})},
        {"a step", smallWith({{glm::dvec3(2, 0, 1), glm::dvec3(3, 0, 1), glm::dvec3(3, 1, 1)},
                              {glm::dvec3(2, 0, 1), glm::dvec3(3, 1, 1), glm::dvec3(2, 1, 1)}})},
        {"half a cell more", smallWith({{glm::dvec3(2, 0, 0), glm::dvec3(3, 0, 0), glm::dvec3(2, 1, 0)}})},
        {"mostly holes", smallWith({{glm::dvec3(1e7, 0, 0), glm::dvec3(1e7 + 1, 0, 0), glm::dvec3(1e7, 1, 0)}})},
        {"half a cell less", smallWithoutItsLast()},
        // 1/1000 of a step is allowed at most, whatever the tolerance.
        {"a corner beside its post", smallWithACornerOffBy(0.01), 1.0},
        {"a turned grid", smallTurned()},
    };
    EXPECT_TRUE(gridIn(small()));
    for (const auto& [name, triangles, tolerance] : cases) EXPECT_FALSE(gridIn(triangles, tolerance)) << name;
}

TEST(TriangleGrid, IsNoneWithAnIndexOutOfTheVertices) {
    const LooseTriangles loose(small());
    EXPECT_FALSE(gridOf(loose.vertices, {0, 1, 99}, 1e-6));
}

TEST(TriangleGrid, IsNoneWithAVertexThatIsNotFinite) {
    const LooseTriangles loose(small());
    for (const double broken : {gnomon::test::notANumber, gnomon::test::infinite}) {
        std::vector<glm::dvec3> vertices = loose.vertices;
        vertices[4].y = broken;
        EXPECT_FALSE(gridOf(vertices, loose.indices, 1e-6)) << broken;
    }
}

TEST(HeightField, NeedsACutForEachCellOrNone) {
    EXPECT_THROW(HeightField({2, 3, {}, {1.0, 1.0}}, std::vector<float>(6), std::vector<CellCut>(3)),
                 std::invalid_argument);
    const HeightField falling({2, 2, {}, {1.0, 1.0}}, {0, 4, 0, 8}, {CellCut::falling});
    EXPECT_DOUBLE_EQ(*falling.height(0.5, 0.5), 2.0) << "amid 4 and 0, not 0 and 8";
    EXPECT_DOUBLE_EQ(*falling.height(0.25, 0.5), 1.0);
    EXPECT_DOUBLE_EQ(*falling.height(0.75, 0.5), 4.0) << "half way from (0.5, 0.5) with 2 to (1, 0.5) with 6";
}
