// SPDX-License-Identifier: MIT
// The planar formula of each source document, written out anew as the document prints it and held against the one
// matrix; and the mistakes each prints. docs/evidence/sources.md has the list.
#include "Compare.h"
#include <array>
#include <gnomon/PlanarShadow.h>
#include <gnomon/Plane.h>
#include <vector>

using glm::dmat4;
using glm::dvec3;
using glm::dvec4;
using gnomon::test::flattened;
using gnomon::test::near;
using gnomon::test::Random;

namespace {

constexpr double ulps = 1e-15; // a few roundings of numbers near 1

/// Sixteen numbers in the order glMultMatrix reads them: column after column.
dmat4 fromMemory(const std::array<double, 16>& data) {
    dmat4 matrix;
    for (std::size_t i = 0; i < 16; ++i) matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = data[i];
    return matrix;
}

/// Equal up to a positive factor: each divided by its largest entry.
::testing::AssertionResult sameUpToScale(const dmat4& got, const dmat4& expected) {
    const auto largest = [](const dmat4& m) {
        double most = 0.0;
        for (int i = 0; i < 16; ++i) most = std::max(most, std::abs(m[i / 4][i % 4]));
        return most;
    };
    return near(got / largest(got), expected / largest(expected), 8.0 * ulps);
}

std::vector<dvec3> cubeCorners(const dvec3& centre, double side) {
    std::vector<dvec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(centre + side * (dvec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - dvec3(0.5)));
    return corners;
}

// CS-4470, "Fake Shadows": row vectors, P' = P M, the ground y = 0, the light at infinity.
dmat4 cs4470RowMatrix(const dvec3& light) {
    const double x = -light.x / light.y, z = -light.z / light.y;
    const std::array<std::array<double, 4>, 4> rows{{{1, 0, 0, 0}, {x, 0, z, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    dmat4 matrix;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            matrix[column][row] = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    return matrix;
}

// Its scene: the floor at y = -200, a cube of side 100 at (0, 0, -511).
const dvec4 cs4470Floor(0, 1, 0, 200);

// GusOnGames: the plane through three points (the normal is not checked for length zero) and the sixteen entries, with
// the `b` that the text forgets to declare.
dvec4 gusPlane(const dvec3& p1, const dvec3& p2, const dvec3& p3) {
    const dvec3 product = glm::cross(p2 - p1, p3 - p2);
    const dvec3 n = product / std::sqrt(glm::dot(product, product));
    return {n, -(n.x * p3.x + n.y * p3.y + n.z * p3.z)};
}

dmat4 gusMatrix(const dvec4& plane, const dvec3& light, double b) {
    const double a = plane.x, c = plane.z, d = plane.w, dx = light.x, dy = light.y, dz = light.z;
    return fromMemory({b * dy + c * dz, -a * dy, -a * dz, 0.0, //
                       -b * dx, a * dx + c * dz, -b * dz, 0.0, //
                       -c * dx, -c * dy, a * dx + b * dy, 0.0, //
                       -d * dx, -d * dy, -d * dz, a * dx + b * dy + c * dz});
}

// halomagic.c: any 4-D light, the plane's normal as long as the cross product makes it.
dvec4 halomagicPlane(const dvec3& v0, const dvec3& v1, const dvec3& v2) {
    const dvec3 first = v1 - v0, second = v2 - v0;
    const double a = first.y * second.z - first.z * second.y;
    const double b = -(first.x * second.z - first.z * second.x);
    const double c = first.x * second.y - first.y * second.x;
    return {a, b, c, -(a * v0.x + b * v0.y + c * v0.z)};
}

dmat4 halomagicMatrix(const dvec4& ground, const dvec4& light) {
    const double product = ground.x * light.x + ground.y * light.y + ground.z * light.z + ground.w * light.w;
    std::array<double, 16> memory{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            memory[i * 4 + j] = (i == j ? product : 0.0) - light[static_cast<int>(j)] * ground[static_cast<int>(i)];
    return fromMemory(memory);
}

const std::array<dvec3, 4> halomagicFloor{{{-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}}};
dvec4 halomagicLight(double angle, double height, double w) {
    return {15.0 * std::cos(angle), height, 15.0 * std::sin(angle), w};
}

// Lab 8: the quotient of its vertex shader, on y = 0.
dvec3 lab8(const dvec3& light, const dvec3& p) {
    return {light.x - light.y * (light.x - p.x) / (light.y - p.y), 0.0,
            light.z - light.y * (light.z - p.z) / (light.y - p.y)};
}

const dvec4 lab8Ground(0, 1, 0, 0);
const dvec4 lab8Light(0, 5, 0, 1);

dmat4 matrixFor(const dvec4& plane, const dvec4& light) { return gnomon::planarShadowMatrix(plane, light).value(); }

} // namespace

TEST(Cs4470FakeShadows, ItsMatrixAndItsFormulaAreTheOneMatrix) {
    const dvec3 light(3, 4, -12);
    const dmat4 transposed = glm::transpose(matrixFor({0, 1, 0, 0}, dvec4(light, 0.0)));
    EXPECT_TRUE(near(transposed / transposed[3][3], cs4470RowMatrix(light), 4.0 * ulps));
    const dmat4 m = matrixFor(cs4470Floor, dvec4(light, 0.0));
    for (const dvec3& p : cubeCorners({0, 0, -511}, 100.0)) {
        const dvec3 printed = p - (p.y + 200.0) / light.y * light; // its y counts from the floor
        EXPECT_TRUE(near(flattened(m, p), printed, 4e-12));        // coordinates up to 1400
    }
}

// Its code sketch scales y by zero whatever the light: right for a sun overhead, and for no other.
TEST(Cs4470FakeShadows, ScalingYByZeroIsTheOverheadSunAndNoOther) {
    for (const dvec3& p : cubeCorners({0, 0, -511}, 100.0)) {
        const dvec3 sketch(p.x, -200.0, p.z);
        EXPECT_TRUE(near(flattened(matrixFor(cs4470Floor, {0, 1, 0, 0}), p), sketch, 1e-12)); // coordinates up to 700
        const double shift = glm::length(flattened(matrixFor(cs4470Floor, {1, 1, 0, 0}), p) - sketch);
        EXPECT_NEAR(shift, p.y + 200.0, 1e-12); // at 45° the sketch is off by the height
    }
}

TEST(GusOnGames, ItsPlaneAndItsSixteenEntriesWithTheMissingBAreOurs) {
    Random random(21);
    for (int i = 0; i < 500; ++i) {
        const dvec3 p1 = random.inCube(5.0), p2 = random.inCube(5.0), p3 = random.inCube(5.0);
        const double thin = glm::length(glm::cross(p2 - p1, p3 - p2));
        EXPECT_TRUE(near(gnomon::planeFromPoints(p1, p2, p3).value(), gusPlane(p1, p2, p3),
                         1e-13 / std::min(1.0, thin))); // a thin triangle magnifies rounding by 1 / thin
        const dvec3 normal = random.direction();
        const dvec3 light = random.between(0.5, 9.0) * glm::normalize(normal + 0.8 * random.direction());
        const dvec4 plane(normal, random.between(-3.0, 3.0));
        EXPECT_TRUE(sameUpToScale(matrixFor(plane, dvec4(light, 0.0)), gusMatrix(plane, light, plane.y)));
    }
}

// `b` is used and never declared. Whatever stands in its place, 0 for one, a floor that faces y needs the real one.
TEST(GusOnGames, ItsUndeclaredBIsTheSecondCoordinateOfTheNormal) {
    const dvec4 floor = gnomon::planeFromPoints({0, 0, 0}, {0, 0, 1}, {1, 0, 0}).value();
    EXPECT_TRUE(near(floor, dvec4(0, 1, 0, 0), ulps));
    const dvec3 light(1, 2, 3);
    EXPECT_EQ(gusMatrix(floor, light, 0.0)[3][3], 0.0); // every point goes to infinity
    EXPECT_GT(matrixFor(floor, dvec4(light, 0.0))[3][3], 0.0);
    EXPECT_TRUE(sameUpToScale(matrixFor(floor, dvec4(light, 0.0)), gusMatrix(floor, light, 1.0)));
}

// The text speaks of the light's position; its last row, (0, 0, 0, n·l), is that of a direction.
TEST(GusOnGames, ItsLightPositionIsUsedAsADirection) {
    const dvec4 floor(0, 1, 0, 0);
    const dvec3 lamp(0, 4, 0), caster(1, 2, 0);
    EXPECT_TRUE(near(flattened(gusMatrix(floor, lamp, floor.y), caster), dvec3(1, 0, 0), ulps)); // straight down
    EXPECT_TRUE(near(flattened(matrixFor(floor, dvec4(lamp, 1.0)), caster), dvec3(2, 0, 0), 4.0 * ulps));
}

TEST(GusOnGames, PointsOnALineGiveNoPlaneAndNotItsNaN) {
    const dvec3 p1(0, 0, 0), p2(1, 2, 3), p3(2, 4, 6);
    EXPECT_TRUE(std::isnan(gusPlane(p1, p2, p3).x));
    EXPECT_FALSE(gnomon::planeFromPoints(p1, p2, p3));
}

TEST(HalomagicC, ItsPlaneTimesSixteenHundredAndItsMatrixAreOurs) {
    const dvec4 printed = halomagicPlane(halomagicFloor[1], halomagicFloor[2], halomagicFloor[3]);
    EXPECT_EQ(printed, dvec4(0, 1600, 0, 0)); // 40 × 40
    EXPECT_EQ(gnomon::planeFromPoints(halomagicFloor[1], halomagicFloor[2], halomagicFloor[3]).value(),
              gnomon::normalizedPlane(printed).value());
    Random random(23);
    for (int i = 0; i < 500; ++i) {
        const dvec4 plane(random.direction(), random.between(-3.0, 3.0));
        const dvec3 foot = -dvec3(plane) * plane.w, up = glm::normalize(dvec3(plane) + 0.8 * random.direction());
        const dvec4 light = i % 2 == 0 ? dvec4(foot + random.between(1.0, 9.0) * up, 1.0) : dvec4(up, 0.0);
        EXPECT_TRUE(sameUpToScale(matrixFor(plane, light), halomagicMatrix(plane * 1600.0, light)));
    }
}

// The drag that lowers its light does not stop at the floor: from there on its matrix throws shadows upwards.
TEST(HalomagicC, ALightDraggedUnderTheFloorThrowsNoShadow) {
    const dvec4 floor(0, 1, 0, 0);
    for (const double w : {0.0, 1.0}) {
        EXPECT_FALSE(gnomon::planarShadowMatrix(floor, halomagicLight(0.5, 0.0, w)));
        EXPECT_FALSE(gnomon::planarShadowMatrix(floor, halomagicLight(0.5, -2.0, w)));
        EXPECT_LT((halomagicMatrix(floor, halomagicLight(0.5, -2.0, w)) * dvec4(0, 8, 0, 1)).w, 0.0);
    }
}

TEST(Lab8, ItsQuotientPutsTheShadowsWhereTheOneMatrixDoes) {
    Random random(24);
    for (const dvec3& light : {dvec3(lab8Light), dvec3(2, 5, -3), dvec3(-0.4, 1.1, 0.2)}) {
        const dmat4 m = matrixFor(lab8Ground, dvec4(light, 1.0));
        for (const dvec3& p : cubeCorners({0.5, 0.25, 0}, 0.5))
            EXPECT_TRUE(near(flattened(m, p), lab8(light, p), 16.0 * ulps)); // coordinates up to 6
        for (int i = 0; i < 200; ++i) {
            const dvec3 p = dvec3(-0.5, 0.25, 0) + 0.5 * random.direction();
            EXPECT_TRUE(
                near(flattened(m, p), lab8(light, p), 64.0 * ulps)); // and the lowest light 0.35 over the sphere
        }
    }
}

TEST(Lab8, AtTheLightsHeightItDividesByZeroAndWeCut) {
    const dvec3 p(1, 5, 0);
    EXPECT_FALSE(std::isfinite(lab8(dvec3(lab8Light), p).x));
    const dvec4 ours = matrixFor(lab8Ground, lab8Light) * dvec4(p, 1.0);
    EXPECT_TRUE(std::isfinite(ours.x) && ours.w == 0.0); // a point at infinity, not a NaN
    EXPECT_LT(glm::dot(gnomon::planarClipPlanes(lab8Ground, lab8Light).belowLight, dvec4(p, 1.0)), 0.0);
}

TEST(Lab8, AboveTheLightItTurnsTheShadowInsideOutAndWeCut) {
    const dvec3 p(1, 7, 0);
    EXPECT_LT(lab8(dvec3(lab8Light), p).x, 0.0); // a caster to the right, a shadow to the left
    EXPECT_LT(glm::dot(gnomon::planarClipPlanes(lab8Ground, lab8Light).belowLight, dvec4(p, 1.0)), 0.0);
}

TEST(Lab8, ThePartOfItsSphereThatSinksBelowTheGroundIsCut) {
    const dvec4 lowest(-0.5, -0.25, 0, 1), highest(-0.5, 0.75, 0, 1); // printed as "sitting on" y = 0
    const auto clip = gnomon::planarClipPlanes(lab8Ground, lab8Light);
    EXPECT_LT(glm::dot(clip.abovePlane, lowest), 0.0);
    EXPECT_GE(glm::dot(clip.abovePlane, highest), 0.0);
    EXPECT_GE(glm::dot(clip.belowLight, highest), 0.0);
}
