// SPDX-License-Identifier: MIT
// Meshes that are their own hulls, and those that only look so.
#include <gnomon/geometry/ConvexParts.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using gnomon::convexSolid;

namespace {

struct Mesh {
    std::vector<glm::dvec3> points;
    std::vector<std::array<unsigned, 3>> triangles;
};

constexpr double flatness = 1e-6; // of meshes of a size about 1

/// Corners are numbered by x + 2 y + 4 z.
Mesh cube() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {1, 3, 7}, {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
    return mesh;
}

Mesh tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

std::optional<gnomon::ConvexHull> solid(const Mesh& mesh) { return convexSolid(mesh.points, mesh.triangles, flatness); }

} // namespace

TEST(ConvexSolid, OfACubeHasItsSixPlanes) {
    const auto hull = solid(cube());
    ASSERT_TRUE(hull);
    ASSERT_EQ(hull->faces.size(), 12u);
    std::set<std::array<double, 4>> planes;
    for (const auto& face : hull->faces) planes.insert({face.plane.x, face.plane.y, face.plane.z, face.plane.w});
    EXPECT_EQ(planes, (std::set<std::array<double, 4>>{
                          {-1, 0, 0, 0}, {1, 0, 0, -1}, {0, -1, 0, 0}, {0, 1, 0, -1}, {0, 0, -1, 0}, {0, 0, 1, -1}}));
    EXPECT_TRUE(solid(tetrahedron()));
}

/// Of floats the two triangles of a turned wall are not quite in one plane.
TEST(ConvexSolid, OfATurnedBoxOfFloatsHasSixFlatFaces) {
    std::mt19937 dice(3);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (int i = 0; i < 100; ++i) {
        Mesh box = cube();
        const glm::dvec3 axis = glm::normalize(glm::dvec3(any(dice), any(dice), any(dice) - 0.5));
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 6.28 * any(dice), axis);
        const glm::dvec3 size(0.1 + any(dice), 0.1 + any(dice), 0.1 + any(dice));
        for (glm::dvec3& point : box.points)
            point = glm::dvec3(glm::vec3(glm::dvec3(turn * glm::dvec4(size * point, 1.0))));
        const auto hull = solid(box);
        ASSERT_TRUE(hull);
        std::set<std::array<double, 4>> planes;
        for (const auto& face : hull->faces) planes.insert({face.plane.x, face.plane.y, face.plane.z, face.plane.w});
        EXPECT_EQ(planes.size(), 6u);
    }
}

TEST(ConvexSolid, IsNoneWhereACornerIsDentedIn) {
    Mesh dented = cube();
    dented.points[7] = glm::dvec3(0.3);
    EXPECT_FALSE(solid(dented));
}

/// Outwards, but one triangle looks in: the surface of no solid.
TEST(ConvexSolid, IsNoneWhereATriangleIsTurnedOver) {
    Mesh turned = tetrahedron();
    std::swap(turned.triangles[2][0], turned.triangles[2][1]);
    EXPECT_FALSE(solid(turned));
}

/// A point in the middle of a face, and one in the middle of an edge.
TEST(ConvexSolid, IsNoneWithPointsThatAreNoCorners) {
    Mesh inFace = cube();
    inFace.points.emplace_back(0.5, 0.75, 0.0); // in {0, 2, 3}
    inFace.triangles[0] = {0, 2, 8};
    inFace.triangles.push_back({2, 3, 8});
    inFace.triangles.push_back({3, 0, 8});
    EXPECT_FALSE(solid(inFace));
    Mesh onEdge = cube();
    onEdge.points.emplace_back(0.5, 0.0, 0.0); // of {0, 3, 1} and {0, 1, 5}
    onEdge.triangles[1] = {0, 3, 8};
    onEdge.triangles.push_back({8, 3, 1});
    onEdge.triangles[4] = {0, 8, 5};
    onEdge.triangles.push_back({8, 1, 5});
    EXPECT_FALSE(solid(onEdge));
}

/// Cut the other way the second time, so that no triangle is there twice.
TEST(ConvexSolid, IsNoneWhereItIsCoveredTwice) {
    Mesh twice = cube();
    for (std::size_t i = 0; i < 12; i += 2) {
        const auto a = twice.triangles[i], b = twice.triangles[i + 1]; // (p, q, r) and (p, r, s)
        twice.triangles.push_back({a[0], a[1], b[2]});
        twice.triangles.push_back({a[1], a[2], b[2]});
    }
    EXPECT_FALSE(solid(twice));
}

TEST(ConvexSolid, IsNoneOfManyFaces) {
    constexpr unsigned sides = 40; // of a pyramid: 41 planes, 41 points
    Mesh pyramid;
    for (unsigned i = 0; i < sides; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / sides;
        pyramid.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        pyramid.triangles.push_back({i, (i + 1) % sides, sides});
        if (i > 1) pyramid.triangles.push_back({0, i, i - 1});
    }
    pyramid.points.emplace_back(0.0, 0.0, 1.0);
    EXPECT_FALSE(solid(pyramid));
}
