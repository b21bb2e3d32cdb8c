// SPDX-License-Identifier: MIT
// Convex hulls, by closed forms.
#include <gnomon/geometry/ConvexHull.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <limits>
#include <random>

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
