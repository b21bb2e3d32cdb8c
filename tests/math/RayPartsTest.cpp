// SPDX-License-Identifier: MIT
// A RayScene of placed parts against every triangle tested in double where it stands.
#include <support/Soup.h>

#include <gnomon/RayScene.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

using gnomon::PlacedRayScene;
using gnomon::Ray;
using gnomon::RayHit;
using gnomon::RayScene;
using test::Soup;

namespace {

glm::dmat4 turned(double angle, const glm::dvec3& to, const glm::dvec3& scale = glm::dvec3(1.0)) {
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), to);
    return glm::scale(glm::rotate(there, angle, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))), scale);
}

/// Rigid, mirrored, of another unit, and stretched along one axis.
std::vector<glm::dmat4> places() {
    return {turned(0.0, {-9.0, 0.0, 0.0}), turned(0.7, {-3.0, 1.0, 0.0}),
            turned(1.9, {3.0, 0.0, 1.0}, {-1.0, 1.0, 1.0}), turned(2.4, {9.0, 0.0, 0.0}, {0.3, 0.3, 0.3}),
            turned(0.4, {0.0, 8.0, 0.0}, {2.0, 0.5, 1.0})};
}

/// A sphere and a box beside it, about an origin of their own.
Soup body() {
    Soup soup;
    soup.sphere({0.0, 0.0, 0.0}, 1.0, 12);
    soup.box({1.5, -0.5, -0.5}, {2.0, 0.5, 0.5});
    soup.origin = {0.25, -0.5, 0.125};
    return soup;
}

/// The same triangles as one soup. A mirrored one keeps its front, so that its corners change places.
Soup joined(const Soup& one, const std::vector<glm::dmat4>& where) {
    Soup all;
    for (const glm::dmat4& matrix : where)
        for (std::size_t i = 0; i < one.size(); ++i) {
            const auto at = [&](int k) { return glm::dvec3(matrix * glm::dvec4(one.corner(i, k) + one.origin, 1.0)); };
            const bool mirrored = glm::determinant(matrix) < 0.0;
            all.triangle(at(0), at(mirrored ? 2 : 1), at(mirrored ? 1 : 2));
        }
    return all;
}

RayScene placed(const Soup& one, const std::vector<glm::dmat4>& where) {
    const auto scene = std::make_shared<const RayScene>(one.view());
    std::vector<PlacedRayScene> parts;
    for (const glm::dmat4& matrix : where) parts.push_back({scene, matrix});
    return RayScene(parts);
}

/// Every second one ends inside the scene.
std::vector<Ray> someRays(int count) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> place(-10.0, 10.0);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 start = 25.0 * test::randomDirection(random), end(place(random), place(random) / 2.0, 0.0);
        rays.push_back({start, end - start, i % 2 ? 1.0 : std::numeric_limits<double>::infinity()});
    }
    return rays;
}

// A silhouette is right to floats of 25 units: one ray in 10,000 may pass on its other side.
TEST(RayParts, AgreeWithEveryTriangleTestedInDouble) {
    const RayScene scene = placed(body(), places());
    const Soup all = joined(body(), places());
    int wrong = 0, hits = 0;
    for (const Ray& ray : someRays(10000)) {
        const RayHit expected = test::bruteForce(all, ray), found = scene.closest(ray);
        hits += bool(expected);
        if (bool(found) != bool(expected) || scene.blocked(ray) != bool(expected)) {
            ++wrong;
        } else if (expected && std::abs(found.distance - expected.distance) <= 1e-7) {
            EXPECT_LE(glm::distance(found.normal, expected.normal), 1e-5) << "floats of corners 12 from the origin";
            EXPECT_EQ(found.part * body().size() + found.triangle, expected.triangle);
        } else if (expected) {
            ++wrong;
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(wrong, 1);
}

TEST(RayParts, AreMeasuredWhereTheyAre) {
    const RayScene scene = placed(body(), {turned(0.3, {5.0, 0.0, 0.0}, {3.0, 3.0, 3.0})});
    EXPECT_NEAR(scene.longestSide(), 3.0 * RayScene(body().view()).longestSide(), 1e-6);
    EXPECT_GE(scene.reach(), 1.4 * 3.0) << "half of what is 3 wide";
    EXPECT_LE(scene.reach(), 3.0 * 3.0 * std::sqrt(3.0) / 2.0 * 1.01) << "but for the box of a turned box";
}

// In the plane is what is within 2^-20 of the coordinates: here 2 mm of 2 km.
TEST(RayParts, OfALargerUnitAreMetByRaysThatEndCloseBehindThem) {
    Soup soup;
    soup.triangle({-1.0, -1.0, 0.0}, {3.0, -1.0, 0.0}, {-1.0, 3.0, 0.0});
    const RayScene scene = placed(soup, {glm::scale(glm::dmat4(1.0), glm::dvec3(4096.0))});
    const auto isMet = [&](double behind) {
        return scene.blocked({{2048.0, 2048.0, 5.0}, {0.0, 0.0, -5.0 - behind}, 1.0});
    };
    EXPECT_TRUE(isMet(0.1));
    EXPECT_FALSE(isMet(0.001)) << "it ends on the surface";
}

TEST(RayParts, OfBadMatricesAreLeftOut) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    glm::dmat4 flat = turned(0.0, {}, {1.0, 1.0, 0.0}), projective(1.0), missing(1.0);
    projective[0][3] = 0.1;
    missing[3][0] = nan;
    const RayScene scene = placed(body(), {flat, projective, missing, glm::dmat4(1.0)});
    EXPECT_EQ(scene.leftOut(), 3u * body().size());
    const RayHit hit = scene.closest({{0.25, -0.5, 5.0}, {0.0, 0.0, -1.0}});
    EXPECT_EQ(hit.part, 3u);
}

TEST(RayParts, MayBeNoneButNotOfPartsOrOfNothing) {
    const RayScene none(std::vector<PlacedRayScene>{});
    EXPECT_FALSE(none.closest({{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}}));
    EXPECT_EQ(none.longestSide(), 0.0);
    const Soup one = body();
    const auto nested = std::make_shared<const RayScene>(one.view());
    const auto parts = std::make_shared<const RayScene>(std::vector<PlacedRayScene>{{nested, glm::dmat4(1.0)}});
    EXPECT_THROW(RayScene(std::vector<PlacedRayScene>{{parts, glm::dmat4(1.0)}}), std::invalid_argument);
    EXPECT_THROW(RayScene(std::vector<PlacedRayScene>{{nullptr, glm::dmat4(1.0)}}), std::invalid_argument);
}

} // namespace
