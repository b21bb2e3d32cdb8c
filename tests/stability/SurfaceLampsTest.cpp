// SPDX-License-Identifier: MIT
// Lamps that lie exactly in a surface that casts: the ceiling, a wall, an edge or a corner of a room.
#include "Trial.h"

#include <gnomon/ShadowQuery.h>
#include <gnomon/TracedShadowTechnique.h>

using namespace test;

namespace {

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
