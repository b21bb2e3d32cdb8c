// SPDX-License-Identifier: MIT
#include "Compare.h"

#include <gnomon/Plane.h>
#include <gnomon/Reflection.h>

#include <glm/matrix.hpp>

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using gnomon::reflectionMatrix;
using gnomon::test::flattened;
using gnomon::test::near;
using gnomon::test::Random;

// x + y = 2, worked by hand: (3, 1, 5) is √2 before it, and comes to (1, -1, 5).
TEST(Reflection, TakesAPointToTheOtherSideOfASlantedPlane) {
    const double half = std::sqrt(0.5);
    EXPECT_TRUE(near(flattened(reflectionMatrix({half, half, 0.0, -2.0 * half}), {3.0, 1.0, 5.0}),
                     dvec3(1.0, -1.0, 5.0), 4e-15));
}

TEST(Reflection, OfTheFloorIsHalomagicsScaleByMinusOne) {
    const dmat4 scale(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
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
