// SPDX-License-Identifier: MIT
// RayScene against an intersector that tests every triangle in double; shared edges, offsets, bulk, UTM, bad input.
#include <support/Soup.h>

#include <gnomon/RayScene.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

using gnomon::Ray;
using gnomon::RayHit;
using gnomon::RayScene;
using test::Soup;

namespace {

constexpr int many = 10000;
const glm::dvec3 utm(432100.25, 6400000.5, 812.0);

Soup townOnGround() {
    Soup soup;
    soup.ground(60.0);
    soup.town(20);
    return soup;
}

Soup spheres() {
    Soup soup;
    for (int i = 0; i < 27; ++i) soup.sphere({i % 3 * 4.0, i / 3 % 3 * 4.0, i / 9 * 4.0}, 1.0 + i % 4 * 0.3, 16);
    return soup;
}

/// Long thin triangles in all directions, through each other.
Soup needles() {
    Soup soup;
    std::mt19937 random(5);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 a = 10.0 * test::randomDirection(random), b = 10.0 * test::randomDirection(random);
        soup.triangle(a, b, a + 0.02 * test::randomDirection(random));
    }
    return soup;
}

/// From around the scene, through it; every second one ends inside it.
std::vector<Ray> randomRays(const Soup& soup, int count, double size) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-size, size);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 start = 2.0 * size * test::randomDirection(random);
        const glm::dvec3 end(place(random), place(random), place(random) / 4.0);
        rays.push_back({soup.origin + start, end - start, i % 2 ? 1.0 : std::numeric_limits<double>::infinity()});
    }
    return rays;
}

/// True if both meet nothing, or something at the same place; at an edge either of the two triangles.
bool agree(const RayHit& a, const RayHit& b) {
    return bool(a) == bool(b) && (!a || std::abs(a.distance - b.distance) < 1e-6);
}

int disagreements(const Soup& soup, const Soup& reference, double size) {
    const RayScene scene(soup.view());
    const std::vector<Ray> rays = randomRays(soup, many, size), referenceRays = randomRays(reference, many, size);
    int wrong = 0, hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayHit expected = bruteForce(reference, referenceRays[i]);
        wrong += !agree(scene.closest(rays[i]), expected) || scene.blocked(rays[i]) != bool(expected);
        hits += bool(expected);
    }
    EXPECT_GT(hits, many / 20);
    EXPECT_LT(hits, many);
    return wrong;
}

TEST(RayScene, AgreesWithEveryTriangleTestedInDouble) {
    EXPECT_LE(disagreements(townOnGround(), townOnGround(), 50.0), many / 10000);
    EXPECT_LE(disagreements(spheres(), spheres(), 10.0), many / 10000);
    EXPECT_LE(disagreements(needles(), needles(), 10.0), many / 10000);
}

TEST(RayScene, IsTheSameFarFromTheOrigin) {
    Soup far = townOnGround();
    far.origin = utm;
    EXPECT_LE(disagreements(far, townOnGround(), 50.0), many / 10000);
}

TEST(RayScene, TellsWhereInDoubleAndWhichSideIsTheFront) {
    Soup soup;
    soup.ground(3.0);
    soup.origin = utm;
    const RayScene scene(soup.view());
    const RayHit down = scene.closest({utm + glm::dvec3(0.7, 0.1, 1.0 / 3.0), {0.0, 0.0, -0.5}});
    EXPECT_NEAR(down.distance, 2.0 / 3.0, 1e-9);
    EXPECT_EQ(down.normal, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(down.triangle, 0u); // of the two: x > y
    const RayHit up = scene.closest({utm - glm::dvec3(0.7, -0.1, 2.0), {0.0, 0.0, 0.25}});
    EXPECT_NEAR(up.distance, 8.0, 1e-9);
    EXPECT_EQ(up.normal, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(up.triangle, 1u);
}

TEST(RayScene, LetsNothingThroughSharedEdgesAndCorners) {
    Soup soup;
    soup.sphere({0.0, 0.0, 0.0}, 10.0, 24);
    const RayScene scene(soup.view());
    std::mt19937 random(3);
    int rays = 0, through = 0;
    for (std::size_t i = 0; i < soup.size(); ++i)
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 a = soup.corner(i, corner), b = soup.corner(i, (corner + 1) % 3);
            for (double share : {0.0, 0.1, 0.25, 0.5, 0.8, 1.0}) {
                const glm::dvec3 start = 6.0 * test::randomDirection(random);
                const Ray ray{start, glm::mix(a, b, share) - start, std::numeric_limits<double>::infinity()};
                through += !scene.blocked(ray) || !scene.closest(ray);
                ++rays;
            }
        }
    EXPECT_GT(rays, 9000);
    EXPECT_EQ(through, 0);
}

TEST(RayScene, AnswersManyRaysWithTheBitsOfSingleOnes) {
    const Soup soup = townOnGround();
    const RayScene scene(soup.view());
    const std::vector<Ray> rays = randomRays(soup, 20000, 50.0);
    std::vector<RayHit> hits(rays.size());
    std::vector<std::uint8_t> answers(rays.size());
    scene.closest(rays.data(), rays.size(), hits.data());
    scene.blocked(rays.data(), rays.size(), answers.data());
    int different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        different += !(hits[i] == scene.closest(rays[i])) || answers[i] != scene.blocked(rays[i]);
    EXPECT_EQ(different, 0);
}

/// Rays from points on a surface to all of the half-space before it: how many meet the surface itself.
int selfHits(const Soup& soup, const glm::dvec3& normal, double half, bool lift) {
    const RayScene scene(soup.view());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-half, half);
    const glm::dvec3 x = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 1.0, 0.2))), y = glm::cross(normal, x);
    int hits = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 point = soup.origin + place(random) * x + place(random) * y;
        const glm::dvec3 along = test::randomDirection(random);
        if (glm::dot(along, normal) < 1e-3) continue;
        hits += scene.blocked({lift ? scene.lifted(point, normal) : point, along});
    }
    return hits;
}

Soup tilted(const glm::dvec3& normal, double half) {
    const glm::dvec3 x = half * glm::normalize(glm::cross(normal, glm::dvec3(0.3, 1.0, 0.2)));
    const glm::dvec3 y = glm::cross(normal, x);
    Soup soup;
    soup.quad(-x - y, 2.0 * x, 2.0 * y);
    return soup;
}

TEST(RayScene, LiftsRaysOffTheSurfaceTheyLeaveInAnyUnit) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
    EXPECT_GT(selfHits(tilted(normal, 100.0), normal, 99.0, false), 1000); // or this shows nothing
    for (double half : {0.1, 100.0, 1e5}) {
        EXPECT_EQ(selfHits(tilted(normal, half), normal, 0.99 * half, true), 0) << half;
        Soup far = tilted(normal, half);
        far.origin = utm;
        EXPECT_EQ(selfHits(far, normal, 0.99 * half, true), 0) << half << " at UTM";
        EXPECT_EQ(selfHits(tilted({0.0, 0.0, 1.0}, half), {0.0, 0.0, 1.0}, 0.99 * half, true), 0) << half << " level";
    }
}

TEST(RayScene, ALineThatEndsInATrianglesPlaneIsNotBlockedByIt) {
    Soup soup;
    soup.ground(5.0);
    const RayScene scene(soup.view());
    const glm::dvec3 lamp(0.3, 0.2, 0.0);
    EXPECT_TRUE(scene.blocked({{0.5, 1.0, 1.0}, {0.0, 0.0, -1.001}, 1.0}));
    EXPECT_FALSE(scene.blocked({{0.5, 1.0, 1.0}, {0.0, 0.0, -0.999}, 1.0}));
    for (const glm::dvec3& start : {glm::dvec3(1.0, 2.0, 3.0), glm::dvec3(-4.0, 1.0, 1e-3), glm::dvec3(0.3, 0.2, -2.0)})
        EXPECT_FALSE(scene.blocked({start, lamp - start, 1.0})) << start.z;
    EXPECT_TRUE(scene.blocked({{1.0, 2.0, 3.0}, glm::dvec3(0.3, 0.2, -0.001) - glm::dvec3(1.0, 2.0, 3.0), 1.0}));
}

TEST(RayScene, ARayThatStartsAboveAPlaneDoesNotMeetItHoweverLargeItIs) {
    Soup soup;
    soup.ground(5e3);
    soup.box({-0.01, -0.01, 0.0}, {0.01, 0.01, 0.02});
    const RayScene scene(soup.view());
    std::mt19937 random(9);
    int hits = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 along = test::randomDirection(random);
        if (along.z > 0.01) hits += scene.blocked({{0.03 + 1e-7 * i, 0.02, 1e-9}, along}) && along.x > 0.0;
    }
    EXPECT_EQ(hits, 0);
    EXPECT_TRUE(scene.blocked({{0.03, 0.0, 1e-9}, {-1.0, 0.0, 0.1}}));
}

TEST(RayScene, ItsMarginIsTheLargestStepOfALiftAndLessThanTwoMillimetresInAHundredMetres) {
    Soup soup;
    soup.ground(100.0);
    soup.origin = utm;
    const RayScene scene(soup.view());
    const auto lift = [&](const glm::dvec3& point, const glm::dvec3& normal) {
        return glm::dot(scene.lifted(utm + point, normal) - utm - point, normal);
    };
    EXPECT_LT(lift({99.0, 99.0, 0.0}, {0.0, 0.0, 1.0}), 0.0002);
    EXPECT_GT(lift({99.0, 99.0, 0.0}, {0.0, 0.0, 1.0}), 0.000001);
    EXPECT_LT(lift({99.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}), 0.002);
    const double most = lift({3.0, 70.0, 0.5}, {0.0, 1.0, 0.0});
    EXPECT_NEAR(scene.margin(utm + glm::dvec3(3.0, 70.0, 0.5)), most, 1e-8);
    EXPECT_GT(most, 3e-5);
}

TEST(RayScene, LeavesOutTrianglesThatAreNone) {
    Soup soup;
    soup.triangle({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {3.0, 3.0, 3.0});
    soup.triangle({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
    soup.triangle({std::nan(""), 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    soup.triangle({1e30, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    soup.triangle({-1.0, -1.0, 5.0}, {1.0, -1.0, 5.0}, {0.0, 1.0, 5.0});
    soup.indices.insert(soup.indices.end(), {0u, 1u, 9999u});
    const RayScene scene(soup.view());
    EXPECT_EQ(scene.leftOut(), 5u);
    EXPECT_EQ(scene.closest({{0.0, 0.0, 9.0}, {0.0, 0.0, -1.0}}).triangle, 4u);
    EXPECT_NEAR(scene.closest({{0.0, 0.0, 9.0}, {0.0, 0.0, -1.0}}).distance, 4.0, 1e-12);
    EXPECT_FALSE(scene.blocked({{2.0, 2.0, 9.0}, {0.0, 0.0, -1.0}}));
}

TEST(RayScene, OfNothingMeetsNothing) {
    const RayScene scene(Soup().view());
    EXPECT_FALSE(scene.closest({{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}));
    EXPECT_EQ(scene.reach(), 0.0);
}

TEST(RayScene, RaysThatAreNoneMeetNothing) {
    const RayScene scene(townOnGround().view());
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    const glm::dvec3 start(0.3, 0.2, 50.0), down(0.0, 0.0, -1.0);
    EXPECT_TRUE(scene.blocked({start, down}));
    for (const Ray& ray : {Ray{start, {0.0, 0.0, 0.0}}, Ray{start, {0.0, nan, -1.0}}, Ray{{nan, 0.0, 50.0}, down},
                           Ray{{infinity, 0.0, 50.0}, down}, Ray{start, {0.0, 0.0, -infinity}}, Ray{start, down, nan},
                           Ray{start, down, 0.0}, Ray{start, down, -1.0}}) {
        EXPECT_FALSE(scene.blocked(ray));
        EXPECT_FALSE(scene.closest(ray));
    }
}

TEST(RayScene, AsksForTheTrianglesThatWereGivenWhetherTheyAreSolid) {
    Soup soup;
    soup.triangle({0.0, 0.0, 9.0}, {1.0, 0.0, 9.0}, {2.0, 0.0, 9.0}); // no area: it is left out
    soup.triangle({0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
    soup.triangle({0.0, 0.0, -1.0}, {4.0, 0.0, -1.0}, {0.0, 4.0, -1.0});
    gnomon::TriangleSoup given = soup.view();
    given.solidAt = [](unsigned triangle, double u, double) { return triangle == 2 || (triangle == 1 && u > 0.5); };
    const RayScene scene(given);
    EXPECT_EQ(scene.closest({{3.0, 0.5, 5.0}, {0.0, 0.0, -1.0}}).triangle, 1u) << "u is x / 4";
    EXPECT_EQ(scene.closest({{1.0, 0.5, 5.0}, {0.0, 0.0, -1.0}}).triangle, 2u);
}

TEST(RayScene, TellsHowFarItsBuildingIs) {
    Soup soup;
    soup.town(100);
    std::atomic<double> last = 0.0; // several threads build
    const RayScene scene(soup.view(), [&last](double share) {
        for (double seen = last; share > seen && !last.compare_exchange_weak(seen, share);) continue;
    });
    EXPECT_GT(last, 0.5);
    EXPECT_LE(last, 1.0);
}

} // namespace
