// SPDX-License-Identifier: MIT
#include "../Compare.h"
#include "BoxOnGround.h"

#include <glm/geometric.hpp>
#include <metrics/BoundaryDistance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace gnomon::metrics;
using glm::dvec2;
using gnomon::test::filled;
using gnomon::test::picture;

constexpr double rounding = 1e-12;

/// V that rises linearly from 0 to 1 over 8 px, where a signed distance (px) goes from shadow to light.
double ramp(double signedDistance) { return std::clamp(0.5 + signedDistance / 8.0, 0.0, 1.0); }

/// Shadow to the left of a line through (50, 50) px + `shift` along its normal, `angle` radians from the x axis.
Picture halfPlane(double shift, double angle = 0.0) {
    const dvec2 normal(std::cos(angle), std::sin(angle));
    return picture(100, 100,
                   [=](int x, int y) { return ramp(glm::dot(dvec2(x + 0.5, y + 0.5) - dvec2(50.0), normal) - shift); });
}

Picture disc(double radius) {
    return picture(200, 200,
                   [=](int x, int y) { return ramp(glm::distance(dvec2(x + 0.5, y + 0.5), dvec2(100.0)) - radius); });
}

Mask everywhere(const Picture& picture) { return Mask(picture.width, picture.height, 1); }

BoundaryDistance between(const Picture& drawn, const Picture& truth) {
    return boundaryDistance(drawn, truth, everywhere(truth)).value();
}

TEST(IsoLine, OfALinearPictureIsExact) {
    for (const Segment& segment : isoLine(halfPlane(0.37), 0.5, everywhere(halfPlane(0.0)))) {
        EXPECT_NEAR(segment.from.x, 50.37, rounding);
        EXPECT_NEAR(segment.to.x, 50.37, rounding);
        EXPECT_NEAR(length(segment), 1.0, rounding);
    }
}

TEST(IsoLine, OfADiscIsAsLongAsItsCircle) {
    double sum = 0.0;
    for (const Segment& segment : isoLine(disc(60.0), 0.5, everywhere(disc(0.0)))) sum += length(segment);
    EXPECT_NEAR(sum, 2.0 * 3.14159265358979 * 60.0, 0.02); // chords of a pixel in a circle of 60
}

TEST(IsoLine, OfACheckerCutsEachSaddleOnce) {
    const Picture checker = picture(10, 10, [](int x, int y) { return double((x + y) % 2); });
    EXPECT_EQ(isoLine(checker, 0.5, everywhere(checker)).size(), 2u * 9u * 9u);
    const Picture dark = picture(2, 2, [](int x, int y) { return x == y ? 0.0 : 0.6; }); // its mean is below
    for (const Segment& segment : isoLine(dark, 0.5, everywhere(dark))) // so the lit corners are cut off
        EXPECT_EQ(segment.from.x > segment.from.y, segment.to.x > segment.to.y);
}

TEST(IsoLine, StaysWithinItsSet) {
    Mask half = everywhere(halfPlane(0.0));
    std::fill(half.cells.begin(), half.cells.begin() + 5000, static_cast<unsigned char>(0)); // the lower 50 rows
    EXPECT_EQ(isoLine(halfPlane(0.0), 0.5, half).size(), 49u);
}

TEST(NearestSegment, AgreesWithTryingAll) {
    gnomon::test::Random random(5);
    std::vector<Segment> segments;
    for (int i = 0; i < 300; ++i) {
        const dvec2 from(random.between(0, 60), random.between(0, 60));
        segments.push_back({from, from + dvec2(random.between(-1, 1), random.between(-1, 1))});
    }
    const NearestSegment nearest(segments);
    for (int i = 0; i < 2000; ++i) {
        const dvec2 point(random.between(-20, 80), random.between(-20, 80));
        double best = std::numeric_limits<double>::infinity();
        for (const Segment& segment : segments) best = std::min(best, distance(segment, point));
        EXPECT_EQ(nearest.distance(point), best);
    }
    EXPECT_TRUE(std::isinf(NearestSegment({}).distance({0, 0})));
}

TEST(BoundaryDistance, OfShiftedHalfPlanesIsTheShift) {
    for (const double shift : {0.01, 0.3, 1.7}) {
        const BoundaryDistance d = between(halfPlane(shift), halfPlane(0.0));
        for (const double value : {d.mean, d.p95, d.max, d.signedMean}) EXPECT_NEAR(value, shift, rounding);
        EXPECT_NEAR(between(halfPlane(-shift), halfPlane(0.0)).signedMean, -shift, rounding); // eroded
        EXPECT_NEAR(d.drawnLength, 99.0, 1e-10);                                              // between 100 centres
    }
}

TEST(BoundaryDistance, DoesNotDependOnTheAngle) {
    for (double angle = 0.0; angle < 6.3; angle += 0.1) {
        const BoundaryDistance d = between(halfPlane(0.3, angle), halfPlane(0.0, angle));
        EXPECT_NEAR(d.mean, 0.3, 0.001); // the lines' ends stand apart by more
        EXPECT_NEAR(d.p95, 0.3, rounding);
        EXPECT_NEAR(d.signedMean, 0.3, 0.001);
    }
}

TEST(BoundaryDistance, OfDiscsIsTheDifferenceOfTheirRadii) {
    const BoundaryDistance d = between(disc(61.0), disc(60.0));
    for (const double value : {d.mean, d.p95, d.max, d.signedMean}) EXPECT_NEAR(value, 1.0, 0.005); // the chords' sag
}

TEST(BoundaryDistance, AHardEdgeAtAnAngleIsKnownToAFractionOfAPixel) {
    const Picture soft = halfPlane(0.0, 0.3);
    const Picture hard = picture(100, 100, [&](int x, int y) { return soft.at(x, y) < 0.5 ? 0.0 : 1.0; });
    EXPECT_NEAR(between(hard, soft).signedMean, 0.0, 0.03);
    EXPECT_LT(between(hard, soft).max, 0.51);
}

TEST(BoundaryDistance, TheNinetyFifthPercentileLeavesOutFourPercentAndSeesTen) {
    const auto stepped = [](int rows) { // shifted by 2 px in as many rows of the picture's 400
        return picture(20, 400, [=](int x, int y) { return x < (y < rows ? 12 : 10) ? 0.0 : 1.0; });
    };
    const Picture straight = stepped(0);
    EXPECT_LT(between(stepped(12), straight).p95, 1e-9);
    EXPECT_GT(between(stepped(40), straight).p95, 1.9);
    EXPECT_NEAR(between(stepped(12), straight).max, 2.0, rounding);
    EXPECT_NEAR(between(stepped(40), straight).mean, 0.2, 0.02);
}

TEST(BoundaryDistance, IsMeasuredBothWays) {
    const Picture one = filled(Picture(60, 60, 1.0), 10, 10, 10, 10, 0.0);
    const Picture two = filled(one, 40, 40, 10, 10, 0.0); // a second shadow, of which the other knows nothing
    EXPECT_GT(between(one, two).max, 30.0);
    EXPECT_GT(between(two, one).max, 30.0);
    EXPECT_LT(between(one, two).signedMean, 0.0);
    EXPECT_GT(between(two, one).signedMean, 0.0);
}

TEST(BoundaryDistance, ThereIsNoneWithoutBothBoundaries) {
    const Picture lit(10, 10, 1.0), shadow = filled(lit, 3, 3, 4, 4, 0.0);
    EXPECT_FALSE(boundaryDistance(lit, shadow, everywhere(lit)));
    EXPECT_FALSE(boundaryDistance(shadow, lit, everywhere(lit)));
    EXPECT_FALSE(boundaryDistance(lit, lit, everywhere(lit)));
}

TEST(Discs, TheirIntersectionOverUnionIsTheRatioOfTheirAreas) {
    TruthMaps truth;
    truth.litCentre = Mask(200, 200);
    const Picture inner = disc(60.0);
    for (std::size_t i = 0; i < inner.cells.size(); ++i) truth.litCentre.cells[i] = inner.cells[i] >= 0.5;
    const Confusion c = confusion(disc(61.0), truth, everywhere(inner));
    EXPECT_NEAR(c.intersectionOverUnion(), 60.0 * 60.0 / (61.0 * 61.0), 0.003); // of some 11500 pixels
}

} // namespace
