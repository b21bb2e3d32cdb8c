// SPDX-License-Identifier: MIT
#include "Compare.h"

#include <gnomon/Plane.h>
#include <gnomon/Reflection.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

using glm::dvec3;
using glm::dvec4;
using gnomon::test::infinite;
using gnomon::test::near;
using gnomon::test::notANumber;
using gnomon::test::Random;

namespace {

constexpr double ulps = 1e-15; // a few roundings of numbers near 1

dvec3 onPlane(const dvec4& plane, const dvec3& point) {
    return point - dvec3(plane) * (glm::dot(dvec3(plane), point) + plane.w);
}

} // namespace

TEST(PlaneFromPoints, IsAsWorkedByHand) {
    EXPECT_EQ(gnomon::planeFromPoints({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).value(), dvec4(0, 0, 1, 0)); // counter-clockwise
    EXPECT_EQ(gnomon::planeFromPoints({0, 0, 0}, {0, 1, 0}, {1, 0, 0}).value(), dvec4(0, 0, -1, 0)); // clockwise
    // Intercepts 2, 3 and 6: x/2 + y/3 + z/6 = 1, or 3x + 2y + z = 6; its normal has length √14.
    EXPECT_TRUE(near(gnomon::planeFromPoints({2, 0, 0}, {0, 3, 0}, {0, 0, 6}).value(),
                     dvec4(3, 2, 1, -6) / std::sqrt(14.0), ulps));
}

TEST(PlaneFromPoints, TheThreePointsLieOnIt) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 p1 = random.inCube(1.0), p2 = random.inCube(1.0), p3 = random.inCube(1.0);
        const auto plane = gnomon::planeFromPoints(p1, p2, p3);
        ASSERT_TRUE(plane);
        const double sliver = glm::length(glm::cross(p2 - p1, p3 - p2)); // thin triangles tell their normal less well
        for (const dvec3& point : {p1, p2, p3})
            EXPECT_NEAR(glm::dot(dvec3(*plane), point) + plane->w, 0.0, 8.0 * ulps / std::min(sliver, 1.0));
        EXPECT_NEAR(glm::length(dvec3(*plane)), 1.0, ulps);
    }
}

TEST(PlaneFromPoints, PointsOnALineEvenIfOnlyButForRoundingGiveNone) {
    for (const dvec3& middle : {dvec3(2, 4, 6), dvec3(1, 2, 3), dvec3(0)})
        EXPECT_FALSE(gnomon::planeFromPoints({1, 2, 3}, middle, {4, 8, 12}));
    EXPECT_FALSE(gnomon::planeFromPoints({1, 2, 3}, {1, 2, 3}, {1, 2, 3}));
    EXPECT_FALSE(gnomon::planeFromPoints({0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const dvec3 start = random.inCube(6.4e6), along = random.direction(); // anywhere on Earth
        const double far = random.between(1.0, 100.0);
        EXPECT_FALSE(gnomon::planeFromPoints(start, start + along, start + far * along));
    }
}

TEST(PlaneFromPoints, AMillimetreTriangleOnTheEarthsSurfaceIsAPlane) {
    const dvec3 place(4.2e6, 1.7e5, 4.78e6);
    const auto plane = gnomon::planeFromPoints(place, place + dvec3(1e-3, 0, 0), place + dvec3(0, 1e-3, 0));
    ASSERT_TRUE(plane);
    // An ulp of 4.78e6 is 9.3e-10, a millionth of the triangle's sides.
    EXPECT_TRUE(near(dvec3(*plane), dvec3(0, 0, 1), 2e-6));
}

TEST(PlaneFromPoints, TheUnitOfLengthDoesNotMatter) {
    const dvec3 p1(1, 2, 3), p2(4, -1, 2), p3(-2, 5, 1);
    const dvec4 metres = gnomon::planeFromPoints(p1, p2, p3).value();
    for (const double unit : {1e-150, 1e-3, 1e3, 1e150}) {
        const auto plane = gnomon::planeFromPoints(p1 * unit, p2 * unit, p3 * unit);
        ASSERT_TRUE(plane) << unit;
        EXPECT_TRUE(near(dvec4(dvec3(*plane), plane->w / unit), metres, 4.0 * ulps))
            << unit; // a unit rounds the points
    }
}

TEST(PlaneFromPoints, WhatIsNotFiniteGivesNone) {
    for (const double bad : {notANumber, infinite, -infinite})
        for (int i = 0; i < 3; ++i) {
            dvec3 point(0, 1, 0);
            point[i] = bad;
            EXPECT_FALSE(gnomon::planeFromPoints(point, {0, 0, 0}, {1, 0, 0}));
            EXPECT_FALSE(gnomon::planeFromPoints({0, 0, 0}, point, {1, 0, 0}));
            EXPECT_FALSE(gnomon::planeFromPoints({0, 0, 0}, {1, 0, 0}, point));
        }
}

TEST(PlaneFromPoints, AnOffsetTooLargeForADoubleGivesNone) {
    const double huge = 1.79e308; // x + y + z = 2 huge, 2/√3 huge away
    EXPECT_FALSE(gnomon::planeFromPoints({huge, huge, 0}, {0, huge, huge}, {huge, 0, huge}));
}

TEST(NormalizedPlane, DividesTheOffsetTooWhateverTheLength) {
    for (const double length : {1.0, 1e-300, 1e-150, 1e150, 1e300}) {
        const auto plane = gnomon::normalizedPlane(dvec4(0, 3, 4, 10) * length); // 5 times as long
        ASSERT_TRUE(plane) << length;
        EXPECT_TRUE(near(*plane, dvec4(0, 0.6, 0.8, 2), ulps)) << length;
    }
}

TEST(NormalizedPlane, WithoutANormalThereIsNone) {
    EXPECT_FALSE(gnomon::normalizedPlane({0, 0, 0, 1}));
    EXPECT_FALSE(gnomon::normalizedPlane({0, 0, 0, 0}));
    for (int i = 0; i < 4; ++i)
        for (const double bad : {notANumber, infinite, -infinite}) {
            dvec4 plane(0, 0, 1, 2);
            plane[i] = bad;
            EXPECT_FALSE(gnomon::normalizedPlane(plane)) << i << ' ' << bad;
        }
}

TEST(Distance, IsPositiveOnTheLitSide) {
    const dvec4 plane(0, 0.6, 0.8, 2);
    EXPECT_NEAR(gnomon::distance(plane, {7, 5, 5}), 9.0, 8.0 * ulps); // 3 + 4 + 2
    EXPECT_NEAR(gnomon::distance(plane, {7, -5, -5}), -5.0, 8.0 * ulps);
}

TEST(TransformedPlane, IsAsWorkedByHand) {
    const glm::dmat4 unit(1.0),
        quarterAboutX(dvec4(1, 0, 0, 0), dvec4(0, 0, 1, 0), dvec4(0, -1, 0, 0), dvec4(0, 0, 0, 1));
    const struct {
        glm::dmat4 frame;
        dvec4 plane, expected;
    } cases[] = {
        {glm::translate(unit, dvec3(7, 8, 5)), {0, 0, 1, 0}, {0, 0, 1, -5}}, // z = 0 becomes z = 5
        {quarterAboutX, {0, 0, 1, -3}, {0, -1, 0, -3}},                      // z becomes -y: -y = 3
        // A stretch tilts the normal the other way: x + y = 1 becomes x/2 + y = 1.
        {glm::scale(unit, dvec3(2, 1, 1)), dvec4(1, 1, 0, -1) / std::sqrt(2.0), dvec4(1, 2, 0, -2) / std::sqrt(5.0)},
        {glm::scale(unit, dvec3(1, 1, -1)), {0, 0, 1, -1}, {0, 0, -1, -1}}, // a mirror takes the lit side with it
    };
    for (const auto& [frame, plane, expected] : cases)
        EXPECT_TRUE(near(gnomon::transformedPlane(frame, plane).value(), expected, ulps));
}

TEST(TransformedPlane, PointsKeepTheirSideAndTheRatioOfTheirDistances) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const dvec4 plane(random.direction(), random.between(-2.0, 2.0));
        glm::dmat4 matrix(glm::dmat3(random.inCube(1.0), random.inCube(1.0), random.inCube(1.0)));
        matrix[3] = dvec4(random.inCube(10.0), 1.0);
        const double volume = std::abs(glm::determinant(glm::dmat3(matrix)));
        if (volume < 0.01) continue; // a nearly flat frame loses digits by itself
        const dvec4 moved = gnomon::transformedPlane(matrix, plane).value();
        const dvec3 lit = onPlane(plane, random.inCube(1.0)) + dvec3(plane), twice = lit + dvec3(plane);
        const dvec3 on = onPlane(plane, random.inCube(1.0));
        const double once = gnomon::distance(moved, dvec3(matrix * dvec4(lit, 1.0)));
        const double tolerance = 100.0 * ulps / volume; // terms up to ~30, magnified by a frame that is nearly flat
        EXPECT_GT(once, 0.0);
        EXPECT_NEAR(gnomon::distance(moved, dvec3(matrix * dvec4(twice, 1.0))), 2.0 * once, tolerance);
        EXPECT_NEAR(gnomon::distance(moved, dvec3(matrix * dvec4(on, 1.0))), 0.0, tolerance);
    }
}

TEST(TransformedPlane, AnyScaleOfTheFrameIsAFrame) {
    for (const double scale : {1e-100, 1e-9, 1e9, 1e100}) {
        const auto plane = gnomon::transformedPlane(glm::scale(glm::dmat4(1.0), dvec3(scale)), {0, 0.6, 0.8, 2});
        ASSERT_TRUE(plane) << scale;
        EXPECT_TRUE(near(dvec4(dvec3(*plane), plane->w / scale), dvec4(0, 0.6, 0.8, 2), ulps)) << scale;
    }
    const auto sheet = gnomon::transformedPlane(glm::scale(glm::dmat4(1.0), dvec3(1e9, 1, 1e-9)), {0, 0, 1, -1});
    ASSERT_TRUE(sheet);
    EXPECT_TRUE(near(*sheet, dvec4(0, 0, 1, -1e-9), ulps * 1e-9));
}

TEST(TransformedPlane, ASingularFrameGivesNone) {
    const dvec4 floor(0, 0, 1, 0);
    EXPECT_FALSE(gnomon::transformedPlane(glm::scale(glm::dmat4(1.0), dvec3(1, 1, 0)), floor));
    EXPECT_FALSE(gnomon::transformedPlane(glm::dmat4(0.0), floor));
    const dvec4 x(1, 2, 3, 0), y(0.1, 0.7, 0.2, 0);
    EXPECT_FALSE(gnomon::transformedPlane(glm::dmat4(x, y, 0.3 * x + 0.9 * y, dvec4(0, 0, 0, 1)), floor));
}

TEST(TransformedPlane, WhatIsNotFiniteGivesNone) {
    for (const double bad : {notANumber, infinite})
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row) {
                glm::dmat4 matrix(1.0);
                matrix[column][row] = bad;
                EXPECT_FALSE(gnomon::transformedPlane(matrix, dvec4(0.6, 0.48, 0.64, 2))) << column << ' ' << row;
            }
    EXPECT_FALSE(gnomon::transformedPlane(glm::dmat4(1.0), {0, 0, notANumber, 0}));
    EXPECT_FALSE(gnomon::transformedPlane(glm::dmat4(1.0), {0, 0, 0, 1}));
}

using glm::dmat4;
using gnomon::reflectionMatrix;
using gnomon::test::flattened;

TEST(Reflection, IsAsWorkedByHand) {
    // x + y = 2: (3, 1, 5) is √2 before it, and comes to (1, -1, 5).
    const double half = std::sqrt(0.5);
    EXPECT_TRUE(near(flattened(reflectionMatrix({half, half, 0.0, -2.0 * half}), {3.0, 1.0, 5.0}),
                     dvec3(1.0, -1.0, 5.0), 4e-15));
    const dmat4 scale(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1); // halomagic's, of the floor
    EXPECT_TRUE(near(reflectionMatrix({0.0, 1.0, 0.0, 0.0}), scale, 0.0));
}

TEST(Reflection, KeepsThePlaneAndDistancesAndIsItsOwnInverse) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const dvec3 normal = random.direction(), foot = random.inCube(100.0), point = random.inCube(100.0);
        const dvec4 plane(normal, -glm::dot(normal, foot));
        const dmat4 matrix = reflectionMatrix(plane);
        EXPECT_TRUE(near(flattened(matrix, foot), foot, 1e-12));
        EXPECT_NEAR(gnomon::distance(plane, flattened(matrix, point)), -gnomon::distance(plane, point), 1e-12);
        EXPECT_TRUE(near(matrix * matrix, dmat4(1.0), 1e-12));
        EXPECT_NEAR(glm::determinant(matrix), -1.0, 1e-12);
    }
}

// Ten thousand kilometres from the origin a double holds 2 nanometres.
TEST(Reflection, IsRightFarFromTheOrigin) {
    const dvec4 plane(0.0, 0.6, 0.8, -0.8e7);
    EXPECT_TRUE(near(flattened(reflectionMatrix(plane), {5e6, 6.0, 1e7 + 8.0}), dvec3(5e6, -6.0, 1e7 - 8.0), 1e-8));
}
