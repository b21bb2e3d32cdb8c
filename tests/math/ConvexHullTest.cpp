// SPDX-License-Identifier: MIT
// Convex hulls, by closed forms.
// Meshes that are their own hulls, and those that only look so.
#include <gnomon/geometry/ConvexHull.h>
#include <gnomon/geometry/ConvexParts.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

using gnomon::ConvexHull;
using gnomon::convexHull;
using Points = std::vector<glm::dvec3>;

namespace {

Points boxPoints(const glm::dvec3& low, const glm::dvec3& high) {
    Points points;
    for (int i = 0; i < 8; ++i)
        points.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return points;
}

/// By the divergence theorem.
double volume(const ConvexHull& hull) {
    double sum = 0.0;
    for (const ConvexHull::Face& face : hull.faces)
        for (std::size_t i = 1; i + 1 < face.corners.size(); ++i)
            sum += glm::dot(hull.vertices[face.corners[0]],
                            glm::cross(hull.vertices[face.corners[i]], hull.vertices[face.corners[i + 1]]));
    return sum / 6.0;
}

Points cloud(int seed, int count, double flatten = 1.0) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::normal_distribution<double> normal;
    Points points;
    for (int i = 0; i < count; ++i) points.emplace_back(normal(random), normal(random), flatten * normal(random));
    return points;
}

TEST(ConvexHull, OfABoxIsTheBoxWhateverElseIsInside) {
    Points points = boxPoints({1.0, 2.0, 3.0}, {2.0, 4.0, 6.0});
    points.push_back({1.5, 3.0, 4.0});
    points.push_back({1.5, 3.0, 3.0}); // in a face
    points.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    const auto hull = convexHull(points);
    ASSERT_TRUE(hull);
    EXPECT_NEAR(volume(*hull), 6.0, 1e-12);
    for (const ConvexHull::Face& face : hull->faces) {
        for (const glm::dvec3& vertex : hull->vertices)
            EXPECT_LE(glm::dot(glm::dvec3(face.plane), vertex) + face.plane.w, 1e-12);
        EXPECT_NEAR(glm::length(glm::dvec3(face.plane)), 1.0, 1e-12);
    }
}

TEST(ConvexHull, IsTheSameShapeAtUtmCoordinatesAndInMillimetres) {
    const glm::dvec3 utm(432100.25, 6400000.5, 812.0);
    EXPECT_NEAR(volume(*convexHull(boxPoints(glm::dvec3(-1.0), glm::dvec3(1.0)))), 8.0, 1e-12);
    ConvexHull far = *convexHull(boxPoints(utm - 1.0, utm + 1.0));
    for (glm::dvec3& v : far.vertices) v -= utm;
    EXPECT_NEAR(volume(far), 8.0, 1e-8) << "rounding of 6,400,000 in double";
    EXPECT_NEAR(volume(*convexHull(boxPoints(glm::dvec3(-1e-3), glm::dvec3(1e-3)))), 8e-9, 1e-20);
}

TEST(ConvexHull, OfPointsInAPlaneIsAPlateAndOfALineNothing) {
    const glm::dvec3 along(1.0, 2.0, -1.0), across(0.5, -0.25, 0.0);
    const Points flat{{}, along, across, along + across, 0.3 * along + 0.4 * across};
    const auto plate = convexHull(flat);
    ASSERT_TRUE(plate);
    ASSERT_EQ(plate->faces.size(), 2u);
    EXPECT_EQ(plate->vertices.size(), 4u);
    EXPECT_NEAR(glm::dot(glm::dvec3(plate->faces[0].plane), glm::dvec3(plate->faces[1].plane)), -1.0, 1e-12);
    EXPECT_FALSE(convexHull({{}, along, 2.0 * along, 0.1 * along}));
    EXPECT_FALSE(convexHull({along, along}));
    EXPECT_FALSE(convexHull({along}));
    EXPECT_FALSE(convexHull({}));
}

TEST(ConvexHull, OfANeedleIsThereOrNotAndNeverAnError) {
    for (int seed = 0; seed < 40; ++seed)
        for (double thin = 1e-14; thin < 1.0; thin *= 3.0) {
            Points points = cloud(seed, 20);
            for (glm::dvec3& p : points) p = {p.x + thin * p.y, 0.3 * p.x - thin * p.z, 0.7 * p.x + thin * p.y};
            EXPECT_NO_THROW(convexHull(points)) << seed << ", " << thin;
        }
}

} // namespace

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

/// Or one triangle looks in: the surface of no solid.
TEST(ConvexSolid, IsNoneWhereACornerIsDentedInOrATriangleTurnedOver) {
    Mesh dented = cube(), turned = tetrahedron();
    dented.points[7] = glm::dvec3(0.3);
    std::swap(turned.triangles[2][0], turned.triangles[2][1]);
    EXPECT_FALSE(solid(dented));
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
