// SPDX-License-Identifier: MIT
// The shadows that a town's tiles hold, and when they are found.
#include "Scene.h"

#include <support/TerrainTrial.h>

#include <gnomon/Convert.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/terrain/HullTiles.h>

#include <osg/ShapeDrawable>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using gnomon::CasterTiles;

namespace {

constexpr int houses = 600; // more than two tiles hold

/// Boxes of all sizes and headings that reach 6 m into the ground, apart from one another. Every fifth drawable is two.
osg::ref_ptr<osg::Group> townOnHills() {
    std::mt19937 dice(7);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    osg::ref_ptr<osg::Group> town = new osg::Group;
    for (int i = 0; i < houses; ++i) {
        const double x = 100.0 + 30.0 * (i % 25), y = 100.0 + 30.0 * (i / 25), height = 10.0 + 8.0 * any(dice);
        const float wide = float(4.0 + 8.0 * any(dice)), deep = float(4.0 + 8.0 * any(dice));
        osg::ref_ptr<osg::MatrixTransform> place =
            new osg::MatrixTransform(osg::Matrixd::rotate(6.28 * any(dice), osg::Z_AXIS) *
                                     osg::Matrixd::translate(x, y, test::hills(x, y) + height / 2.0 - 6.0));
        osg::ref_ptr<osg::CompositeShape> shape = new osg::CompositeShape;
        shape->addChild(new osg::Box(osg::Vec3(), wide, deep, float(height)));
        if (i % 5 == 0) shape->addChild(new osg::Box(osg::Vec3(wide, 0.0f, 0.0f), 2.0f, 2.0f, float(height)));
        place->addChild(new osg::ShapeDrawable(shape));
        town->addChild(place);
    }
    return town;
}

/// From straight above, 1 km wide about x (y is 500 m).
gnomon::ViewFrame viewAbove(double x, double pixel) {
    gnomon::ViewFrame view;
    view.eyeFromGroup = osg::Matrixd::translate(-x, -500.0, -2000.0);
    view.projection = osg::Matrixd::ortho(-500.0, 500.0, -500.0, 500.0, 1.0, 4000.0);
    view.pixels.set(1000.0 / pixel, 1000.0 / pixel);
    return view;
}
constexpr double finePixel = 0.04; // metres

/// Boxes on hills, and what is found of them.
struct Hills {
    Hills() { town.take(*gnomon::Casters::of(*root, {}, nullptr), {}); }
    void update(double azimuth, const gnomon::ViewFrame& view = viewAbove(500.0, finePixel)) {
        tiles.update(town, on, sunAt(azimuth, elevation), gnomon::TileView(view, town.origin()));
    }
    /// How many tiles' shadows are those of this sun.
    long ofSun(double azimuth) const {
        const auto& shadows = tiles.shadows();
        return std::count_if(shadows.begin(), shadows.end(),
                             [&](const auto& tile) { return tile && tile->found == sunAt(azimuth, elevation); });
    }
    static glm::dvec4 sunAt(double azimuth, double elevation = 35.0) {
        return glm::dvec4(test::sunAt(azimuth, elevation), 0.0);
    }
    double rightOf(const gnomon::TileShadows& tile) const { return town.origin().x + tile.solids.high.x; }
    double leftOf(const gnomon::TileShadows& tile) const { return town.origin().x + tile.solids.low.x; }

    const gnomon::HeightPyramid ground = test::groundOf(test::hills, 100);
    const gnomon::HullGround on{ground};
    const osg::ref_ptr<osg::Group> root = townOnHills();
    CasterTiles town{false};
    gnomon::HullTiles tiles;
    double elevation = 35.0; // of the sun, degrees
};

TEST(CasterTiles, HaveTheSolidsOfEachHouse) {
    Hills hills;
    hills.update(250.0);
    ASSERT_GE(hills.tiles.shadows().size(), 3u);
    std::size_t cast = 0;
    for (const auto& tile : hills.tiles.shadows())
        cast += tile->solids.outcomes[std::size_t(gnomon::HullOutcome::cast)];
    EXPECT_EQ(cast, std::size_t(houses + houses / 5));
}

/// Faces of a cube from 0 to 10, the upper one or the others.
osg::ref_ptr<osg::Geometry> cubeFaces(bool upper) {
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (int i = 0; i < 8; ++i) corners->push_back({i & 1 ? 10.0f : 0.0f, i & 2 ? 10.0f : 0.0f, i & 4 ? 10.0f : 0.0f});
    osg::ref_ptr<osg::DrawElementsUInt> faces = new osg::DrawElementsUInt(GL_QUADS);
    for (const unsigned corner : {0u, 2u, 3u, 1u, 0u, 1u, 5u, 4u, 1u, 3u, 7u, 5u, 3u, 2u, 6u, 7u, 2u, 0u, 4u, 6u})
        if (!upper) faces->push_back(corner);
    for (const unsigned corner : {4u, 5u, 7u, 6u})
        if (upper) faces->push_back(corner);
    return scene::geometryOf(corners, faces);
}

std::size_t partsOf(const CasterTiles& town) {
    std::size_t count = 0;
    for (const CasterTiles::Tile& tile : town.tiles()) count += tile.size();
    return count;
}

TEST(CasterTiles, WeldsARoofToTheWallsThatWereThereBefore) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(cubeFaces(false));
    CasterTiles town(false);
    const auto walls = gnomon::Casters::of(*root, {}, nullptr);
    town.take(*walls, {});
    EXPECT_GT(partsOf(town), 1u) << "plates";
    root->addChild(cubeFaces(true));
    town.take(*gnomon::Casters::of(*root, {}, walls), {});
    EXPECT_EQ(partsOf(town), 1u) << "a solid";
}

/// A house of 15 m and a sun at 35 degrees: a turn of 0.05 degrees takes 2 cm off a silhouette at most, of a degree 0.5 m.
TEST(HullTiles, WaitWhileTheyAreOffByLessThanAQuarterOfAPixel) {
    Hills hills;
    hills.update(250.0);
    const unsigned all = hills.tiles.found();
    hills.update(250.01, viewAbove(500.0, 1.0));
    EXPECT_EQ(hills.tiles.found(), all);
    hills.update(250.6, viewAbove(500.0, 0.2));
    EXPECT_EQ(hills.tiles.found(), 2 * all);
}

/// 20 tiles or fewer: four a frame.
TEST(HullTiles, AreAllBroughtUpToDateSoonAfterTheSunStands) {
    Hills hills;
    hills.update(250.0);
    const std::size_t all = hills.tiles.shadows().size();
    for (std::size_t i = 0; i <= all / 4 + 1; ++i) hills.update(250.01, viewAbove(500.0, 1.0));
    EXPECT_EQ(hills.ofSun(250.01), long(all));
    const unsigned found = hills.tiles.found();
    hills.update(250.01, viewAbove(500.0, 1.0));
    EXPECT_EQ(hills.tiles.found(), found);
}

/// The last houses end at 829 m; a low sun in the west takes their shadows 70 m further.
TEST(HullTiles, AreFoundWhereShadowsFallIntoTheViewOfWhatIsOutside) {
    Hills hills;
    hills.elevation = 10.0;
    hills.update(250.0, viewAbove(1380.0, finePixel)); // from x = 880
    ASSERT_GT(hills.ofSun(250.0), 0);
    double right = 0.0;
    for (const auto& tile : hills.tiles.shadows())
        if (tile) right = std::max(right, hills.rightOf(*tile));
    EXPECT_GT(right, 880.0);
}

/// Of tiles that cover 100 to 840 m, those beyond the view wait until they are seen.
TEST(HullTiles, WaitWhileTheyAreOutOfSight) {
    Hills hills;
    const gnomon::ViewFrame beside = viewAbove(2000.0, finePixel), half = viewAbove(-200.0, finePixel); // to x = 300
    hills.update(250.0, beside);
    EXPECT_EQ(hills.tiles.found(), 0u);
    for (const double azimuth : {250.0, 254.0, 230.0}) {
        hills.update(azimuth, half);
        hills.update(azimuth, beside);
        long found = 0;
        for (const auto& tile : hills.tiles.shadows()) {
            if (!tile || tile->found != Hills::sunAt(azimuth)) continue;
            ++found;
            EXPECT_LT(hills.leftOf(*tile), 400.0) << "far from the view";
        }
        EXPECT_GT(found, 0);
        EXPECT_LT(found, long(hills.tiles.shadows().size()));
    }
    hills.update(230.0);
    EXPECT_EQ(hills.ofSun(230.0), long(hills.tiles.shadows().size()));
}

TEST(HullTiles, AreLetGoWhereTheirShadowsWereAndAreNot) {
    Hills hills;
    hills.update(250.0, viewAbove(-350.0, finePixel)); // to x = 150: the houses from 100 on
    ASSERT_GT(hills.tiles.found(), 0u);
    hills.update(110.0, viewAbove(2000.0, finePixel));
    for (const auto& tile : hills.tiles.shadows()) EXPECT_FALSE(tile);
}

/// Longest way on the screen, in pixels, that a point of a box goes which moves by `off` any way.
double mostPixels(const gnomon::ViewFrame& view, const osg::BoundingBoxd& box, double off) {
    const osg::Matrixd clip = view.eyeFromGroup * view.projection;
    double most = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner)
        for (int way = 0; way < 16; ++way)
            for (const double rise : {-1.0, 0.0, 1.0}) {
                const double angle = way * std::acos(-1.0) / 8.0;
                const osg::Vec3d at = box.corner(corner);
                osg::Vec3d step(std::cos(angle), std::sin(angle), rise);
                step.normalize();
                const osg::Vec3d by = (at + step * off) * clip - at * clip;
                most = std::max(most, std::hypot(by.x() * view.pixels.x(), by.y() * view.pixels.y()) / 2.0);
            }
    return most;
}

/// To the corners of a wide view, where a metre is the most pixels.
TEST(TileView, KnowsHowManyPixelsALengthIsAtMost) {
    const osg::BoundingBoxd box(-30.0, -20.0, -5.0, 30.0, 20.0, 10.0);
    gnomon::HullSolids solids;
    solids.low = gnomon::toGlm(box._min);
    solids.high = gnomon::toGlm(box._max);
    solids.corners = {0, 1, 2};
    solids.widest = 10.0;
    for (const auto& [eye, fovy] : {std::pair(osg::Vec3d(0.0, -60.0, 50.0), 90.0), {{0.0, -400.0, 10.0}, 20.0}}) {
        gnomon::ViewFrame view;
        view.eyeFromGroup = osg::Matrixd::lookAt(eye, osg::Vec3d(), osg::Vec3d(osg::Z_AXIS));
        view.projection = osg::Matrixd::perspective(fovy, 1.0, 1.0, 1000.0);
        view.pixels.set(500.0, 500.0);
        const gnomon::TileView::Shown shown = gnomon::TileView(view, glm::dvec3(0.0)).shown(solids);
        const double length = 0.25 / shown.pixels;
        EXPECT_TRUE(shown.bounds && shown.isBeforeEye);
        EXPECT_LE(mostPixels(view, box, length), 0.25 * 1.01) << "1 % for what is not linear";
        EXPECT_GT(mostPixels(view, box, length), 0.1);
    }
}

} // namespace
