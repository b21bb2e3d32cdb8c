// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/SpotCone.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

bool isWithin(const glm::dmat4& coneFromScene, const glm::dvec3& point, double w = 1.0) {
    const glm::dvec4 at = coneFromScene * glm::dvec4(point * w, w);
    return at.z >= 0.0 && at.x * at.x + at.y * at.y <= at.z * at.z;
}

} // namespace

TEST(SpotCone, OfThirtyDegreesDownHoldsADiscOfTheTangentOnTheFloor) {
    const glm::dmat4 cone = gnomon::coneFromScene({1.0, 2.0, 5.0}, {{0.0, 0.0, -1.0}, std::asin(0.5)});
    const double radius = 5.0 / std::sqrt(3.0);
    EXPECT_TRUE(isWithin(cone, {1.0, 2.0, 0.0}));
    EXPECT_TRUE(isWithin(cone, {1.0 + 0.999 * radius, 2.0, 0.0}));
    EXPECT_FALSE(isWithin(cone, {1.0, 2.0 - 1.001 * radius, 0.0}));
    EXPECT_FALSE(isWithin(cone, {1.0, 2.0, 6.0})) << "behind it";
}

/// By the angle between the axis and the way to a point, as OpenGL has it.
TEST(SpotCone, HoldsWhatIsAtNoLargerAngleFromItsAxisWhereverItStands) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-10.0, 10.0);
    const auto place = [&] { return glm::dvec3(side(random), side(random), side(random)); };
    int within = 0;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 apex = place(), axis = glm::normalize(place()), point = place();
        const double cutoff = std::abs(side(random)) / 10.0 * std::acos(0.0);
        const double angle = std::acos(glm::dot(axis, glm::normalize(point - apex)));
        if (std::abs(angle - cutoff) < 1e-9) continue;
        within += angle < cutoff;
        EXPECT_EQ(isWithin(gnomon::coneFromScene(apex, {axis, cutoff}), point, 0.25), angle < cutoff);
    }
    EXPECT_GT(within, 1000);
}
