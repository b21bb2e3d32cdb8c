// SPDX-License-Identifier: MIT
// Convex hulls and their shadows: closed forms, and rays against the hull's half-spaces, which share nothing with the
// shadow's planes.
#include <gnomon/geometry/ConvexShadow.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using gnomon::ConvexHull;
using gnomon::convexHull;
using gnomon::ConvexShadow;
using gnomon::convexShadow;
using Points = std::vector<glm::dvec3>;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

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

/// Of a level polygon, counter-clockwise from above positive.
double area(const Points& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum / 2.0;
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

/// Whether the way from a point to the light enters the hull, by the slabs of its faces. Nearer than `margin` to either
/// answer counts as both.
struct Answer {
    bool blocked = false, sure = true;
};

Answer blocked(const ConvexHull& hull, const glm::dvec3& from, const glm::dvec4& light, double margin) {
    const glm::dvec3 along = light.w == 0.0 ? glm::dvec3(light) : glm::dvec3(light) / light.w - from;
    double enter = 0.0, leave = light.w == 0.0 ? 1e9 : 1.0;
    for (const ConvexHull::Face& face : hull.faces) {
        const double outside = glm::dot(glm::dvec3(face.plane), from) + face.plane.w;
        const double speed = glm::dot(glm::dvec3(face.plane), along);
        if (speed < 0.0) enter = std::max(enter, -outside / speed);
        if (speed > 0.0) leave = std::min(leave, -outside / speed);
        if (speed == 0.0 && outside > 0.0) return {};
    }
    return {enter <= leave, std::abs(leave - enter) > margin};
}

/// Wrong answers of holds() on random points about a hull, and how many were in shadow.
struct Tally {
    int wrong = 0, shadowed = 0, unsure = 0;
};

Tally tally(const ConvexHull& hull, const glm::dvec4& light, int seed) {
    const auto shadow = convexShadow(hull, light);
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> place(-4.0, 4.0);
    Tally result;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 point(place(random), place(random), place(random));
        const Answer expected = blocked(hull, point, light, 1e-9);
        result.unsure += !expected.sure;
        if (!expected.sure) continue;
        result.shadowed += expected.blocked;
        result.wrong += (shadow && shadow->holds(point)) != expected.blocked;
    }
    return result;
}

TEST(ConvexHull, OfANeedleIsThereOrNotAndNeverAnError) {
    for (int seed = 0; seed < 40; ++seed)
        for (double thin = 1e-14; thin < 1.0; thin *= 3.0) {
            Points points = cloud(seed, 20);
            for (glm::dvec3& p : points) p = {p.x + thin * p.y, 0.3 * p.x - thin * p.z, 0.7 * p.x + thin * p.y};
            EXPECT_NO_THROW(convexHull(points)) << seed << ", " << thin;
        }
}

TEST(ConvexShadow, HoldsExactlyThePointsWhoseWayToTheLightIsBlocked) {
    for (int seed = 0; seed < 20; ++seed)
        for (const double w : {0.0, 1.0}) {
            const auto hull = convexHull(cloud(seed, 4 + 3 * seed, seed % 3 ? 1.0 : 0.2));
            ASSERT_TRUE(hull);
            const glm::dvec3 way = glm::normalize(cloud(100 + seed, 1).front());
            const Tally result = tally(*hull, glm::dvec4(9.0 * way, w), seed);
            EXPECT_EQ(result.wrong, 0) << seed << (w == 1.0 ? " lamp" : " sun");
            EXPECT_GT(result.shadowed, 50) << seed;
            EXPECT_LT(result.unsure, 5) << seed;
        }
}

TEST(ConvexShadow, OfABoxIsRightWhereTheLightStandsStraightOverIt) {
    const auto hull = convexHull(boxPoints({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}));
    for (const double off : {0.0, 1e-12, 1e-6, 1e-3})
        for (int azimuth = 0; azimuth < 360; azimuth += 15) {
            const glm::dvec4 sun(off * std::sin(azimuth * degree), off * std::cos(azimuth * degree), 1.0, 0.0);
            EXPECT_EQ(tally(*hull, sun, azimuth).wrong, 0) << off << ", " << azimuth;
        }
}

std::vector<glm::dvec3> clipped(const std::array<glm::dvec3, 3>& triangle, const ConvexShadow& shadow) {
    gnomon::Clipper clipper;
    const gnomon::Clipper::Polygon polygon = clipper.clip(triangle, shadow.planes, 0);
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < polygon.size; ++i) places.push_back(polygon.corners[i].place);
    return places;
}

/// A level square so large that every shadow here ends on it, as two triangles.
double shadowArea(const ConvexShadow& shadow) {
    const glm::dvec3 a(-90, -90, 0), b(90, -90, 0), c(90, 90, 0), d(-90, 90, 0);
    return area(clipped({a, b, c}, shadow)) + area(clipped({a, c, d}, shadow));
}

TEST(ConvexShadow, OfAHouseOnLevelGroundHasTheAreaWorkedByHandAtEveryAzimuth) {
    const auto hull = convexHull(boxPoints({-2.0, -1.0, 0.0}, {2.0, 1.0, 3.0}));
    double last = 0.0, jump = 0.0;
    for (int azimuth = 0; azimuth <= 360; ++azimuth) {
        const double reach = 3.0 / std::tan(30.0 * degree);
        const double x = std::abs(std::sin(azimuth * degree)), y = std::abs(std::cos(azimuth * degree));
        const double expected = 4.0 * 2.0 + reach * (x * 2.0 + y * 4.0); // footprint, and what it sweeps
        const auto shadow = convexShadow(*hull, {std::sin(azimuth * degree) * std::cos(30.0 * degree),
                                                 std::cos(azimuth * degree) * std::cos(30.0 * degree), 0.5, 0.0});
        ASSERT_TRUE(shadow);
        EXPECT_NEAR(shadowArea(*shadow), expected, 1e-9) << azimuth;
        if (azimuth > 0) jump = std::max(jump, std::abs(shadowArea(*shadow) - last) / expected);
        last = shadowArea(*shadow);
    }
    EXPECT_LT(jump, 0.02) << "from one degree to the next";
}

TEST(ConvexShadow, SilhouetteOfACubeSeenFromACornerIsAHexagonInOrder) {
    const auto shadow = convexShadow(*convexHull(boxPoints(glm::dvec3(0.0), glm::dvec3(1.0))), {1.0, 1.0, 1.0, 0.0});
    ASSERT_TRUE(shadow);
    ASSERT_EQ(shadow->silhouette.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::dvec3 edge = shadow->silhouette[(i + 1) % 6] - shadow->silhouette[i];
        EXPECT_NEAR(glm::length(edge), 1.0, 1e-12) << "along the cube's edges";
        const glm::dvec3 next = shadow->silhouette[(i + 2) % 6] - shadow->silhouette[(i + 1) % 6];
        EXPECT_GT(glm::dot(glm::cross(edge, next), glm::dvec3(1.0)), 0.0) << "counter-clockwise from the light";
    }
    EXPECT_EQ(shadow->planes.size(), 3u + 6u) << "each flat face once";
}

TEST(ConvexShadow, OfAPlateFallsBehindItOnEitherSide) {
    const auto plate = convexHull({{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}});
    for (const double side : {1.0, -1.0}) {
        const auto shadow = convexShadow(*plate, {0.0, 0.0, side, 0.0});
        ASSERT_TRUE(shadow);
        EXPECT_TRUE(shadow->holds({0.0, 0.0, 2.0 - side}));
        EXPECT_FALSE(shadow->holds({0.0, 0.0, 2.0 + side}));
    }
    EXPECT_FALSE(convexShadow(*plate, {1.0, 0.0, 0.0, 0.0})) << "edge on";
}

TEST(ConvexShadow, ThereIsNoneOfALampInsideOrNowhere) {
    const auto hull = convexHull(boxPoints(glm::dvec3(-1.0), glm::dvec3(1.0)));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(convexShadow(*hull, {0.2, 0.1, 0.0, 1.0}));
    EXPECT_FALSE(convexShadow(*hull, {0.0, 0.0, 0.0, 0.0}));
    EXPECT_FALSE(convexShadow(*hull, {nan, 0.0, 1.0, 0.0}));
    EXPECT_FALSE(convexShadow(*hull, {0.0, 0.0, 1.0, nan}));
    EXPECT_FALSE(convexShadow(*hull, {0.0, 0.0, 5.0, -1.0}));
}

} // namespace
