// SPDX-License-Identifier: MIT
#include <gnomon/RayScene.h>
#include <gnomon/geometry/TerminatorOffset.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using gnomon::terminatorOffset;
using gnomon::terminatorOffsets;

namespace {

struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<unsigned> corners;

    void vertex(const glm::dvec3& at, const glm::dvec3& normal) {
        positions.push_back(at);
        normals.push_back(glm::vec3(normal));
    }
    /// Of the last four vertices: two pairs, one beside the other.
    void quad() {
        const auto a = static_cast<unsigned>(positions.size()) - 4;
        corners.insert(corners.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
    }
    std::vector<glm::vec4> offsets() const { return terminatorOffsets(positions, normals, corners); }
};

constexpr double radius = 2.0, height = 50.0;

glm::dvec3 onCircle(int i, int segments) {
    const double angle = 2.0 * std::acos(-1.0) * i / segments;
    return {std::cos(angle), std::sin(angle), 0.0};
}

/// A wall of panels, each with vertices of its own, long along z.
Mesh cylinder(int segments, double lengthOfNormals = 1.0) {
    Mesh mesh;
    for (int i = 0; i < segments; ++i) {
        for (const glm::dvec3& at : {onCircle(i, segments), onCircle(i + 1, segments)})
            for (const double z : {0.0, height})
                mesh.vertex(radius * at + glm::dvec3(0.0, 0.0, z), lengthOfNormals * at);
        mesh.quad();
    }
    return mesh;
}

} // namespace

TEST(TerminatorOffsets, AreThePanelsOfACylinderAcrossItsAxis) {
    for (const int segments : {12, 24, 400}) {
        const double half = std::sin(std::acos(-1.0) / segments);
        for (const double length : {1.0, -3.0}) { // of normals, which may point inward
            const Mesh mesh = cylinder(segments, length);
            const std::vector<glm::vec4> offsets = mesh.offsets();
            ASSERT_EQ(offsets.size(), mesh.positions.size());
            for (std::size_t i = 0; i < offsets.size(); ++i) {
                EXPECT_NEAR(double(offsets[i].w), 2.0 * radius * half, 1e-5) << segments;
                EXPECT_NEAR(double(glm::length(glm::vec3(offsets[i]))) * 2.0 * half, 1.0, 1e-5) << segments;
                EXPECT_GT(std::abs(glm::dot(glm::normalize(glm::vec3(offsets[i])), glm::normalize(mesh.normals[i]))),
                          1.0f - 1e-5f);
            }
        }
    }
}

TEST(TerminatorOffsets, ArePartOfThemWhereTheLightGrazesAndNoneElsewhere) {
    const glm::vec4 offset(0.0f, 0.0f, 1.0f / 0.2f, 3.0f); // turns by 0.2
    const auto at = [&](double sine) { return terminatorOffset(offset, {std::sqrt(1.0 - sine * sine), 0.0, sine}); };
    EXPECT_NEAR(at(0.0), 3.0, 1e-6);
    EXPECT_NEAR(at(0.199), 3.0, 1e-6);
    EXPECT_NEAR(at(-0.199), 3.0, 1e-6);
    EXPECT_NEAR(at(0.25), 1.5, 1e-6);
    EXPECT_EQ(at(0.301), 0.0);
    EXPECT_EQ(at(-1.0), 0.0);
}

TEST(TerminatorOffsets, AreNoneOfFlatWallsAndOfAveragedCorners) {
    const glm::dvec3 up(0.0, 0.0, 1.0);
    Mesh wall, house, none = cylinder(24, 0.0), rough = cylinder(7); // 25.7 degrees
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0}) {
            wall.vertex({x, y, 0.0}, up);
            house.vertex({x, y, 0.0}, {2.0 * x - 1.0, 2.0 * y - 1.0, 1.0});
        }
    wall.quad();
    house.quad();
    EXPECT_TRUE(wall.offsets().empty());
    EXPECT_TRUE(house.offsets().empty());
    EXPECT_TRUE(none.offsets().empty());
    EXPECT_TRUE(rough.offsets().empty());
    none.normals[0].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(none.offsets().empty());
    EXPECT_TRUE(Mesh().offsets().empty());
}

/// The lid of a cylinder is flat, but moves with the rim that it shares.
TEST(TerminatorOffsets, AreOneAtOnePlace) {
    constexpr int segments = 24;
    Mesh mesh = cylinder(segments);
    const std::size_t wall = mesh.positions.size();
    for (int i = 0; i < segments; ++i) {
        const glm::dvec3 up(0.0, 0.0, 1.0), top(0.0, 0.0, height);
        const auto first = static_cast<unsigned>(mesh.positions.size());
        for (const glm::dvec3& at : {glm::dvec3(0.0), onCircle(i, segments), onCircle(i + 1, segments)})
            mesh.vertex(radius * at + top, up);
        mesh.corners.insert(mesh.corners.end(), {first, first + 1, first + 2});
    }
    const std::vector<glm::vec4> offsets = mesh.offsets();
    for (std::size_t i = wall; i < offsets.size(); ++i) {
        const bool atRim = glm::length(glm::dvec2(mesh.positions[i])) > 1.0;
        EXPECT_EQ(offsets[i].w > 0.0f, atRim);
        for (std::size_t k = 0; k < wall && atRim; ++k)
            if (mesh.positions[k] == mesh.positions[i]) EXPECT_EQ(offsets[k], offsets[i]);
    }
}

TEST(TerminatorOffsets, LetRaysToALightPassBeforeATriangle) {
    const std::vector<glm::vec3> places{{-9.0f, -9.0f, 5.0f}, {9.0f, -9.0f, 5.0f}, {0.0f, 18.0f, 5.0f}};
    const std::vector<unsigned> corners{0, 1, 2};
    const std::vector<glm::vec4> offsets(3, glm::vec4(10.0f, 0.0f, 0.0f, 2.0f)); // normals across the rays, as at a rim
    gnomon::TriangleSoup soup{places.data(), places.size(), corners.data(), corners.size()};
    soup.terminatorOffsets = offsets.data();
    const gnomon::RayScene scene(soup), body({{std::make_shared<const gnomon::RayScene>(soup)}});
    for (const gnomon::RayScene* of : {&scene, &body})
        for (const double length : {1.0, 0.25}) { // of the way, which has no unit
            const glm::dvec3 up(0.0, 0.0, length);
            const auto toLight = [&](double z, const glm::dvec3& way) {
                return of->blocked({{0.0, 0.0, z}, way, std::numeric_limits<double>::infinity(), true});
            };
            EXPECT_TRUE(toLight(2.9, up));
            EXPECT_FALSE(toLight(3.1, up));
            EXPECT_TRUE(toLight(3.1, {0.4, 0.0, 1.0})) << "not where its normal leaves the terminator";
            EXPECT_TRUE(of->blocked({{0.0, 0.0, 3.1}, up})) << "a line of sight";
            EXPECT_TRUE(of->closest({{0.0, 0.0, 3.1}, up})) << "the triangle is where it is";
        }
}
