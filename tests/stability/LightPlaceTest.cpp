// SPDX-License-Identifier: MIT
// Suns and lamps where planar shadows are known to fail: in the plane, under it, as high as the caster, within it.
// Lamps that lie exactly in a surface that casts: the ceiling, a wall, an edge or a corner of a room.
#include "Trial.h"

#include <gnomon/ShadowQuery.h>
#include <gnomon/TracedShadowTechnique.h>

#include <cmath>

using namespace test;

namespace {

const Mesh tower = box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0});

osg::Vec4d sunAt(double degrees) {
    const double elevation = osg::DegreesToRadians(degrees);
    return osg::Vec4d(osg::Vec4(static_cast<float>(std::cos(elevation)), 0.0f, // as osg::Light holds it
                                static_cast<float>(std::sin(elevation)), 0.0f));
}

Trial lit(const osg::Vec4d& light, const Mesh& caster = tower) {
    Trial trial;
    trial.casters = {caster};
    trial.light = light;
    return trial;
}

/// From the side, the eye 3 above the ground: sees both the shadow and what an inverted one would reach.
View fromTheSide() { return perspective({-6.0, -7.0, 3.0}, {0.0, 0.0, 0.5}, 160, 120); }

GNOMON_BY_TECHNIQUE(Sun);
GNOMON_BY_TECHNIQUE(Lamp);
GNOMON_BY_TECHNIQUE(HomogeneousLight);

const Mesh shell = insideOut(box({-5.0, -5.0, -0.5}, {5.0, 5.0, 4.0}));
const std::vector<Mesh> furniture = {box({1.0, 0.5, 0.0}, {2.0, 1.5, 1.0}), box({-2.0, -1.0, 0.0}, {-1.5, 1.0, 2.0})};

/// Below the ceiling; in it; in it, on the diagonal of its triangles; in a wall; on its diagonal; in an edge; in a corner.
const osg::Vec4d lamps[] = {{0.3, 0.4, 3.5, 1.0},  {0.3, 0.4, 4.0, 1.0}, {0.0, 0.0, 4.0, 1.0}, {5.0, 0.4, 2.5, 1.0},
                            {5.0, 0.0, 1.75, 1.0}, {5.0, 0.4, 4.0, 1.0}, {5.0, 5.0, 4.0, 1.0}};

/// About the z axis: walls are in planes that no float is exactly in.
Mesh turned(const Mesh& mesh, double angle) {
    Mesh result;
    for (const glm::dvec3& p : mesh) {
        const osg::Vec3d at = osg::Vec3d(p.x, p.y, p.z) * osg::Matrixd::rotate(angle, osg::Z_AXIS);
        result.emplace_back(at.x(), at.y(), at.z());
    }
    return result;
}

/// Straight down on the floor, from below the ceiling.
View fromUnderTheCeiling() {
    View view = fromAbove(3.5, 100);
    view.projection.makeOrtho(-3.5, 3.5, -3.5, 3.5, 47.0, 51.0);
    return view;
}

struct Room {
    Room(const osg::Vec4d& lamp, double angle) {
        for (const Mesh& mesh : furniture) inside.push_back(turned(mesh, angle));
        trial.casters = inside;
        trial.casters.push_back(turned(shell, angle));
        trial.light = lamp * osg::Matrixd::rotate(angle, osg::Z_AXIS);
        trial.view = fromUnderTheCeiling();
    }
    /// A convex room casts nothing on its own inside, so that the rays are asked of the furniture alone.
    Truth truth() const {
        Truth truth = truthOf(trial);
        truth.mask = castRays(square(trial.half), inside, trial.light, trial.view);
        return truth;
    }
    Trial trial;
    std::vector<Mesh> inside;
};

GNOMON_BY(SurfaceLamp, By::Planar, By::Traced, By::Map, By::Volume);

TEST_P(SurfaceLamp, InCeilingWallEdgeOrCornerLightsTheRoom) {
    for (const double angle : {0.0, 0.6})
        for (const osg::Vec4d& lamp : lamps) {
            SCOPED_TRACE(testing::Message() << lamp.x() << " " << lamp.y() << " " << lamp.z() << ", by " << angle);
            const Room room(lamp, angle);
            const Truth truth = room.truth();
            EXPECT_GT(truth.shadowPixels(), 250);
            EXPECT_GT(truth.mask.count(Seen::LitReceiver), 6000);
            Scene scene = room.trial.buildWithShadow();
            EXPECT_TRUE(isRight(scene, room.trial.view, truth));
        }
}

TEST(SurfaceLampQuery, FindsTheFloorLitBesideTheFurniture) {
    for (const osg::Vec4d& lamp : lamps) {
        Scene scene = Room(lamp, 0.0).trial.build();
        const osg::ref_ptr<gnomon::TracedShadowTechnique> traced = new gnomon::TracedShadowTechnique;
        scene.addShadow(traced);
        const gnomon::ShadowQuery query(*traced, {0, lamp});
        int lit = 0;
        for (int i = 0; i < 81; ++i) lit += query.isLit({-4.4 + 0.1 * i, 4.4, 0.0}); // beyond the furniture's shadows
        EXPECT_EQ(lit, 81) << lamp.x() << " " << lamp.y() << " " << lamp.z();
    }
}

} // namespace

TEST_P(Sun, InThePlaneOrUnderItCastsNothing) {
    for (const double degrees : {0.0, -1e-6, -1e-3, -0.01, -5.0, -90.0}) {
        SCOPED_TRACE(degrees);
        EXPECT_TRUE(isUnshadowed(lit(sunAt(degrees))));
    }
}

TEST(PlanarSun, LowerThanSixThousandthsOfADegreeCountsAsInThePlane) { // see planarShadowMatrix()
    for (const double degrees : {1e-6, 1e-3}) {
        SCOPED_TRACE(degrees);
        EXPECT_TRUE(isUnshadowed(lit(sunAt(degrees))));
    }
}

TEST_P(Sun, GrazingThePlaneCastsWhatRaysSay) {
    for (const double degrees : {0.01, 0.5, 2.0}) {
        SCOPED_TRACE(degrees);
        Trial trial = lit(sunAt(degrees));
        if (degrees < 0.1) trial.mapEdge = 5; // 4 steps of depth, 99/2²⁴ each, are 2.2 pixels along the ground
        EXPECT_EQ(truthOf(trial).shadowPixels(), 56 * 16); // 3.5 long and 1 wide, at 16 pixels a unit
        EXPECT_TRUE(isRight(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Sun, OverheadCastsTheFootprintWhateverTheRestOfItsDirection) {
    for (const double sideways : {0.0, 1e-12, 1e-6}) {
        SCOPED_TRACE(sideways);
        Trial trial = lit({sideways, 0.0, 1.0, 0.0}, box({-0.5, -0.5, 1.0}, {0.5, 0.5, 2.0}));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Lamp, OverAtAndUnderACastersTopCastsWhatRaysSay) {
    for (const double height : {2.0, 1.001, 1.0, 0.999, 0.5}) {
        SCOPED_TRACE(height);
        Trial trial = lit({2.0, 0.25, height, 1.0});
        EXPECT_GT(truthOf(trial).shadowPixels(), 1000); // at least the cone behind the tower, to the ground's edge
        EXPECT_TRUE(isRight(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Lamp, StraightOverOrInTheTopOfACasterCastsWhatRaysSay) {
    for (const double height : {2.0, 1.001, 1.0}) {
        SCOPED_TRACE(height);
        Trial trial = lit({0.0, 0.0, height, 1.0});
        EXPECT_TRUE(isRight(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(Lamp, UnderAFloatingCasterCastsNoInvertedShadow) {
    const Mesh floating = box({-0.5, -0.5, 2.0}, {0.5, 0.5, 3.0});
    for (const double height : {2.0, 1.999, 1.0, 1e-3}) {
        SCOPED_TRACE(height);
        Trial trial = lit({1.5, 0.0, height, 1.0}, floating);
        EXPECT_TRUE(isUnshadowed(trial));
        trial.view = fromTheSide();
        EXPECT_TRUE(isUnshadowed(trial));
    }
}

TEST_P(Lamp, InThePlaneOrUnderItCastsNothing) {
    for (const double height : {0.0, -1e-9, -0.5, -10.0}) {
        SCOPED_TRACE(height);
        EXPECT_TRUE(isUnshadowed(lit({2.0, 0.0, height, 1.0})));
    }
}

TEST_P(Lamp, InsideASolidBoxDarkensAllTheGroundAround) {
    const Trial trial = lit({0.125, 0.0, 0.5, 1.0});
    const Truth truth = truthOf(trial);
    EXPECT_EQ(truth.mask.count(Seen::LitReceiver), 0);
    EXPECT_EQ(truth.shadowPixels(), 128 * 128 - 16 * 16); // all but the tower
    EXPECT_TRUE(isRight(trial));
}

TEST_P(Lamp, InsideAnOpenRoomShinesThroughItsDoor) {
    Trial room;
    room.casters = {box({-2.0, -2.0, 0.0}, {-1.75, 2.0, 1.5}), box({1.75, -2.0, 0.0}, {2.0, 2.0, 1.5}),
                    box({-1.75, 1.75, 0.0}, {1.75, 2.0, 1.5}), box({-1.75, -2.0, 0.0}, {-0.5, -1.75, 1.5}),
                    box({0.5, -2.0, 0.0}, {1.75, -1.75, 1.5})};
    for (const double height : {0.75, 1.5, 3.0}) {
        SCOPED_TRACE(height);
        room.light = {0.25, 0.0, height, 1.0};
        const Truth truth = truthOf(room);
        EXPECT_GT(truth.mask.count(Seen::LitReceiver), 3500); // the floor inside alone: 3.5 of 8, squared
        EXPECT_GT(truth.shadowPixels(), 1000);
        EXPECT_TRUE(isRight(room));
    }
}

TEST_P(HomogeneousLight, RecedingToASunCastsAsTheSunDoes) {
    for (const double w : {0.0, 1e-12, 1e-9, 1e-6}) { // at 10⁻⁶ a shadow is off by 10⁻⁶ of its length
        SCOPED_TRACE(w);
        const Trial trial = lit(osg::Vec4d(osg::Vec4(1.0f, 0.5f, 1.0f, static_cast<float>(w))));
        Scene scene = trial.buildWithShadow();
        EXPECT_TRUE(isRight(scene, trial.view, truthOf(trial, {1.0, 0.5, 1.0, 0.0})));
    }
}

TEST_P(HomogeneousLight, IsThePointDividedByItsWeight) {
    for (const double w : {1e-3, 1.0, 2.0}) {
        SCOPED_TRACE(w);
        const Trial trial = lit(osg::Vec4d(osg::Vec4(3.0f, 1.0f, 4.0f, static_cast<float>(w))));
        EXPECT_GT(truthOf(trial).shadowPixels(), 200);
        EXPECT_TRUE(isRight(trial));
    }
}

TEST_P(HomogeneousLight, OfNegativeWeightIsTheSamePoint) {
    const Trial plain = lit({3.0, 1.0, 4.0, 1.0});
    for (const double factor : {-1.0, -1e-3, -2.0}) {
        SCOPED_TRACE(factor);
        Scene scene = plain.buildWithShadow();
        scene.group->addLight({0, plain.light * factor});
        EXPECT_TRUE(isRight(scene, plain.view, truthOf(plain)));
    }
}

TEST(PlanarLight, OfNegativeWeightMayBeUnderThePlane) {
    const Trial plain = lit({3.0, 1.0, 4.0, 1.0});
    Scene under = plain.buildWithShadow(); // (3, 1, 4) / -1
    under.group->addLight({0, osg::Vec4d(3.0, 1.0, 4.0, -1.0)});
    EXPECT_TRUE(isUnshadowed(under, plain.view, render(plain.build().root, plain.view)));
}
