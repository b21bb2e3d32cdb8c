// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/SeenEdges.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <random>

using namespace gnomon;

namespace {

/// From above: x and y from -1 to 1 are 0 to 1.
const glm::dmat4 fromAbove = glm::scale(glm::translate(glm::dmat4(1.0), {0.5, 0.5, 0.0}), {0.5, 0.5, 1.0});

/// Volume of a tetrahedron, with a sign.
double volume(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a);
}

} // namespace

// Whether a line passes a triangle is told by the signs of three volumes.
TEST(RayBins, MeetWhatEachRayMeetsAlone) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(-1.0, 1.0), height(0.0, 3.0), small(-0.2, 0.2);
    std::vector<RayBins::Ray> rays;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 from(anywhere(random), anywhere(random), height(random));
        rays.push_back({from, {0.0, 0.0, 2.0}, (glm::dvec2(from) + 1.0) / 2.0});
    }
    std::vector<glm::vec3> corners;
    std::vector<unsigned> indices;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 middle(anywhere(random), anywhere(random), height(random));
        for (int corner = 0; corner < 3; ++corner) {
            indices.push_back(unsigned(corners.size()));
            corners.push_back(middle + glm::vec3(small(random), small(random), small(random)));
        }
    }
    const glm::dmat4 raised = glm::translate(glm::dmat4(1.0), {0.0, 0.0, 0.5});
    std::size_t met = 0, expected = 0;
    RayBins(fromAbove, rays)
        .meet(PlacedTriangles{corners.data(), corners.size(), indices.data(), 300, raised, {0}},
              [&](const RayBins::Met& hit) {
                  const RayBins::Ray& ray = rays[hit.ray];
                  const glm::dvec3 place = ray.from + hit.reach * ray.way;
                  glm::dvec3 corner[3];
                  for (int i = 0; i < 3; ++i)
                      corner[i] = glm::dvec3(raised * glm::dvec4(corners[indices[3 * hit.side + unsigned(i)]], 1.0));
                  EXPECT_NEAR(glm::dot(glm::normalize(hit.normal), place - corner[0]), 0.0, 1e-9);
                  EXPECT_NEAR(glm::dot(hit.normal, corner[2] - corner[1]), 0.0, 1e-9);
                  ++met;
              });
    for (const RayBins::Ray& ray : rays)
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const auto corner = [&](std::size_t which) {
                return glm::dvec3(raised * glm::dvec4(corners[indices[i + which]], 1.0));
            };
            const glm::dvec3 a = corner(0), b = corner(1), c = corner(2), to = ray.from + ray.way;
            const double x = volume(ray.from, to, a, b), y = volume(ray.from, to, b, c), z = volume(ray.from, to, c, a);
            expected += (x > 0.0 && y > 0.0 && z > 0.0) || (x < 0.0 && y < 0.0 && z < 0.0) ? 1 : 0;
        }
    EXPECT_GT(expected, 300u);
    EXPECT_EQ(met, expected);
}

TEST(RayBins, MeetTrianglesThatReachBehindTheEye) {
    const glm::dmat4 picture = glm::scale(glm::translate(glm::dmat4(1.0), {0.5, 0.5, 0.0}), {0.5, 0.5, 1.0}) *
                               glm::perspective(1.0, 1.0, 0.1, 100.0); // looks along -z
    const std::vector<glm::vec3> corners{{-50, -1, 50}, {50, -1, 50}, {0, -1, -50}};
    const std::vector<unsigned> indices{0, 1, 2};
    int met = 0;
    RayBins(picture, {{{0, 0, 0}, {0, -0.3, -1}, {0.5, 0.2}}})
        .meet(PlacedTriangles{corners.data(), 3, indices.data(), 1, glm::dmat4(1.0), {0}},
              [&](const RayBins::Met& hit) {
                  EXPECT_NEAR(hit.reach, 1.0 / 0.3, 1e-9);
                  ++met;
              });
    EXPECT_EQ(met, 1);
}

// A box that is twice as long in the scene: rays from above meet its upper side, and one from inside its lower side.
TEST(RayBins, MeetTheNearSideOfABoxOrTheFarOneFromInside) {
    const PlacedBox box{{-0.2, -0.2, 0.0}, {0.2, 0.2, 1.0}, glm::scale(glm::dmat4(1.0), {2.0, 1.0, 1.0})};
    std::vector<RayBins::Ray> rays;
    for (const glm::dvec3& from : {glm::dvec3(0.3, 0.1, 3.0), {0.5, 0.0, 3.0}, {0.0, 0.3, 3.0}, {0.1, 0.1, 0.5}})
        rays.push_back({from, {0.0, 0.0, -1.0}, (glm::dvec2(from) + 1.0) / 2.0});
    std::vector<RayBins::Met> met;
    RayBins(fromAbove, rays).meet(box, [&](const RayBins::Met& hit) { met.push_back(hit); });
    ASSERT_EQ(met.size(), 2u);
    for (const RayBins::Met& hit : met) {
        EXPECT_EQ(hit.inside, hit.ray == 3);
        EXPECT_NEAR(hit.reach, hit.ray == 3 ? 0.5 : 2.0, 1e-12);
        EXPECT_EQ(hit.side, 5u) << "of the z axis, the end that looks up, or is seen from above";
    }
    EXPECT_EQ(met[0].ray + met[1].ray, 3u) << "the others pass by";
}
