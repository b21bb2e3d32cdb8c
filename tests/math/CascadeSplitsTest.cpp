// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/CascadeSplits.h>
#include <gnomon/mapfit/MapFit.h>
#include <gnomon/mapfit/SpotCone.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace gnomon;

namespace {

const glm::dmat4 here(1.0);

/// The eye 2 above the ground z = 0, looking along +x, half a right angle to all sides.
glm::dmat4 standing() {
    return glm::perspective(std::acos(0.0), 1.0, 0.25, 4000.0) *
           glm::lookAt(glm::dvec3(0.0, 0.0, 2.0), glm::dvec3(1.0, 0.0, 2.0), glm::dvec3(0.0, 0.0, 1.0));
}

SeenRange rangeOf(double nearest, double farthest) {
    SeenRange range(here);
    range.nearest = nearest;
    range.farthest = farthest;
    return range;
}

bool isIn(const std::vector<glm::dvec4>& part, const glm::dvec4& point) {
    return std::all_of(part.begin(), part.end(), [&](const auto& half) { return glm::dot(half, point) >= 0.0; });
}

bool isWithin(const glm::dmat4& coneFromScene, const glm::dvec3& point, double w = 1.0) {
    const glm::dvec4 at = coneFromScene * glm::dvec4(point * w, w);
    return at.z >= 0.0 && at.x * at.x + at.y * at.y <= at.z * at.z;
}

} // namespace

TEST(CascadeSplits, AreEachAsManyTimesAsFarAsTheOneBeforeAndNoMoreThanAreOfUse) {
    const std::vector<double> splits = cascadeSplits(rangeOf(1.0, 1000.0), 3);
    ASSERT_EQ(splits.size(), 2u);
    EXPECT_NEAR(splits[0], 10.0, 1e-9);
    EXPECT_NEAR(splits[1], 100.0, 1e-9);
    EXPECT_EQ(cascadeSplits(rangeOf(10.0, 1000.0), 1).size(), 0u);
    EXPECT_EQ(cascadeSplits(rangeOf(10.0, 39.0), 4).size(), 0u); // two parts would be less than twice as far each
    EXPECT_EQ(cascadeSplits(rangeOf(10.0, 41.0), 4).size(), 1u);
    EXPECT_EQ(cascadeSplits(rangeOf(1.0, 1.0), 4).size(), 0u); // as orthographic views are
    EXPECT_EQ(cascadeSplits(SeenRange(here), 4).size(), 0u);
    EXPECT_EQ(cascadeSplits(rangeOf(0.0, 1000.0), 4).size(), 3u) << "at the eye itself";
    for (const double split : cascadeSplits(rangeOf(0.0, 1000.0), 4)) EXPECT_GT(split, 0.0);
}

// From 1 to 1000: one part if it may be 1000 times as far at its end, two if 31.6 times, three if 10 times.
TEST(Cascades, AreAsManyAsKeepTexelsToThreePixels) {
    const SeenRange seen = rangeOf(1.0, 1000.0);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 1001.0, 0), 1);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 999.0, 0), 2);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 31.0, 0), 3); // 31² is less than 1000
    EXPECT_EQ(cascadesFor(seen, 3.0 / 32.0, 0), 2);
    EXPECT_EQ(cascadesFor(seen, 100.0, 0), 4);
    EXPECT_EQ(cascadesFor(rangeOf(1.0, 1.0), 1.0, 0), 1);
}

TEST(Cascades, StayAsManyAsTheyWereWhereAnotherCountHardlyMatters) {
    const SeenRange seen = rangeOf(1.0, 1000.0);
    for (const double pixels : {3.0 / 31.0, 3.0 / 32.0})
        for (const int before : {2, 3}) EXPECT_EQ(cascadesFor(seen, pixels, before), before);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 31.0, 1), 3);
    EXPECT_EQ(cascadesFor(seen, 3.0 / 32.0, 4), 2);
}

// A ray to the lower edge of such a picture falls as far as it goes: it meets the ground 2 ahead.
TEST(SeenRange, OfAGroundIsFromWhereThePictureBeginsToWhereTheGroundEnds) {
    SeenRange range(standing());
    range.addBox({-50.0, -50.0, 0.0}, {300.0, 50.0, 0.0}, here, viewPart(standing(), {}, 0));
    EXPECT_NEAR(range.nearest, 2.0, 1e-9);
    EXPECT_NEAR(range.farthest, 300.0, 1e-9);
    SeenRange behind(standing());
    behind.addBox({-50.0, -50.0, 0.0}, {-1.0, 50.0, 9.0}, here, viewPart(standing(), {}, 0));
    EXPECT_TRUE(behind.empty());
}

TEST(ViewPart, EachPointOfAViewIsInThePartThatItsDistanceSays) {
    const glm::dmat4 clipFromScene = standing();
    const std::vector<double> splits{10.0, 100.0};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.2, 1.2), distance(-2.0, 9.0);
    for (int i = 0; i < 2000; ++i) {
        const double w = std::exp(distance(random)), x = unit(random), y = unit(random);
        const glm::dvec4 point(w, x * w, 2.0 + y * w, 1.0);
        const bool inView = std::max(std::abs(x), std::abs(y)) <= 1.0 && w >= 0.25 && w <= 4000.0;
        const std::size_t right = w < 10.0 ? 0 : w < 100.0 ? 1 : 2;
        for (std::size_t part = 0; part < 3; ++part)
            EXPECT_EQ(isIn(viewPart(clipFromScene, splits, part), point), inView && part == right) << w << " " << part;
    }
}

TEST(CornersWithin, AreABoxsOwnOrNoneOrEndAtTheBoundary) {
    EXPECT_EQ(cornersWithin({1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, here, {{1.0, 0.0, 0.0, 0.0}}).size(), 8u);
    EXPECT_TRUE(cornersWithin({1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, here, {{-1.0, 0.0, 0.0, 0.5}}).empty());
    double most = 0.0;
    for (const glm::dvec4& corner :
         cornersWithin({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, glm::scale(here, glm::dvec3(3.0)), {{-1.0, 0.0, 0.0, 4.5}}))
        most = std::max(most, corner.x);
    EXPECT_NEAR(most, 4.5, 1e-12);
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
