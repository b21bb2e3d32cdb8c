// SPDX-License-Identifier: MIT
// The shadows that a town's tiles hold, against those of each of its houses alone.
#include "Scene.h"

#include <support/TerrainTrial.h>

#include <gnomon/Convert.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/overlay/ShadowDecals.h>
#include <gnomon/terrain/TileUpdates.h>

#include <osg/ShapeDrawable>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using gnomon::CasterTiles;
using gnomon::TerrainMethod;

namespace {

constexpr int posts = 100, houses = 600; // more than two tiles hold
constexpr double pitch = 10.0, error = 0.1;

gnomon::HeightPyramid hillyGround() {
    std::vector<float> heights;
    for (int j = 0; j < posts; ++j)
        for (int i = 0; i < posts; ++i) heights.push_back(float(test::hills(pitch * i, pitch * j)));
    return gnomon::HeightPyramid({posts, posts, {0.0, 0.0}, {pitch, pitch}, heights});
}

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

using Corners = std::vector<std::array<float, 3>>;

/// Of a shadow's triangles, about the origin, as the tiles keep them.
Corners cornersOf(const gnomon::Drape& triangles, const glm::dvec3& origin) {
    Corners corners;
    for (const glm::dvec3& corner : triangles) {
        const glm::vec3 local(corner - origin);
        corners.push_back({local.x, local.y, local.z});
    }
    return corners;
}

/// By the way that takes one object.
std::vector<Corners> oneByOne(osg::Group& town, const gnomon::Ground& ground, const glm::dvec4& sun,
                              TerrainMethod method, const glm::dvec3& origin) {
    std::vector<Corners> result;
    for (unsigned i = 0; i < town.getNumChildren(); ++i) {
        gnomon::CasterExtraction traverser;
        town.getChild(i)->accept(traverser);
        const osg::ref_ptr<gnomon::CasterMesh> mesh = new gnomon::CasterMesh(traverser);
        for (const gnomon::ConvexPart& part : gnomon::partsOf(*mesh))
            result.push_back(cornersOf(gnomon::terrainShadow(ground, part, sun, method, error).triangles, origin));
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// From straight above, 1 km wide about x (y is 500 m).
gnomon::ViewFrame viewAbove(double x, double pixel) {
    gnomon::ViewFrame view;
    view.eyeFromGroup = osg::Matrixd::translate(-x, -500.0, -2000.0);
    view.projection = osg::Matrixd::ortho(-500.0, 500.0, -500.0, 500.0, 1.0, 4000.0);
    view.pixels.set(1000.0 / pixel, 1000.0 / pixel);
    return view;
}
constexpr double finePixel = 0.04; // metres: a quarter of it is far less than the error

/// Boxes on hills, and what is found of them with no time for what may wait.
struct Hills {
    Hills() { town.take(*gnomon::CasterDrawables::of(*root, {}, nullptr), {}); }
    void update(double azimuth, TerrainMethod method = TerrainMethod::hull) {
        update(azimuth, method, viewAbove(500.0, finePixel), 0.0);
    }
    void update(double azimuth, const gnomon::ViewFrame& view, double seconds = 0.0) {
        update(azimuth, TerrainMethod::hull, view, seconds);
    }
    void update(double azimuth, TerrainMethod method, const gnomon::ViewFrame& view, double seconds) {
        using Options = gnomon::TerrainShadowOptions;
        const Options options{method == TerrainMethod::drape ? Options::DRAPE : Options::HULL, error};
        tiles.update(town, {ground, &ground, 0.05}, sunAt(azimuth, elevation), options,
                     gnomon::TileVisibility(view, town.origin()), seconds);
    }
    /// How many tiles' shadows are those of this sun.
    long ofSun(double azimuth) const {
        const auto& shadows = tiles.shadows();
        return std::count_if(shadows.begin(), shadows.end(),
                             [&](const auto& tile) { return tile->light == sunAt(azimuth, elevation); });
    }
    static glm::dvec4 sunAt(double azimuth, double elevation = 35.0) {
        return glm::dvec4(test::sunAt(azimuth, elevation), 0.0);
    }

    const gnomon::HeightPyramid ground = hillyGround();
    const osg::ref_ptr<osg::Group> root = townOnHills();
    CasterTiles town{false};
    gnomon::TileUpdates tiles;
    double elevation = 35.0; // of the sun, degrees
};

TEST(CasterTiles, HasTheShadowsOfEachHouseAloneBitForBit) {
    for (const auto method : {TerrainMethod::hull, TerrainMethod::drape}) {
        Hills hills;
        hills.update(250.0, method);
        ASSERT_GE(hills.tiles.shadows().size(), 3u);
        std::vector<Corners> found;
        for (const auto& tile : hills.tiles.shadows())
            for (std::size_t i = 0; i < tile->found.size(); ++i)
                found.push_back(cornersOf(tile->found.triangles(i), hills.town.origin()));
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found.size(), std::size_t(houses + houses / 5));
        EXPECT_TRUE(found == oneByOne(*hills.root, hills.ground, Hills::sunAt(250.0), method, hills.town.origin()));
    }
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
    const auto walls = gnomon::CasterDrawables::of(*root, {}, nullptr);
    town.take(*walls, {});
    EXPECT_GT(partsOf(town), 1u) << "plates";
    root->addChild(cubeFaces(true));
    town.take(*gnomon::CasterDrawables::of(*root, {}, walls), {});
    EXPECT_EQ(partsOf(town), 1u) << "a solid";
}

/// Shadows of 12 m that turn by 0.05 degrees are off by a centimetre, on slopes by some more; by a degree, by some 0.3 m.
TEST(TileUpdates, WaitWhileTheyAreOffByLessThanTheErrorAndNoLonger) {
    Hills hills;
    hills.update(250.0);
    const unsigned all = hills.tiles.found();
    hills.update(250.05);
    EXPECT_EQ(hills.tiles.found(), all);
    hills.update(251.05);
    EXPECT_EQ(hills.tiles.found(), 2 * all);
}

namespace {

/// The farthest that a corner of a polygon is from the nearest corner of the other, in plan.
double apart(const gnomon::PackedShadow& a, const gnomon::PackedShadow& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.cornerCount; ++i) {
        double least = 1e9;
        for (std::size_t k = 0; k < b.cornerCount; ++k)
            least =
                std::min(least, glm::length(glm::dvec2(glm::vec2(a.corners[i])) - glm::dvec2(glm::vec2(b.corners[k]))));
        most = std::max(most, least);
    }
    return most;
}

} // namespace

/// A sun at 12 degrees, in places as low as the hills are steep: 20 steps take tips that are up to 85 m away 0.15 m on.
TEST(TileUpdates, OnGroundAsSteepAsTheLightWaitAsLongAsTheyAreOffByLessThanTheError) {
    Hills hills;
    hills.elevation = 12.0;
    hills.update(250.0);
    const unsigned all = hills.tiles.found();
    int unbounded = 0, compared = 0;
    for (int step = 1; step <= 20; ++step) {
        const glm::dvec4 sun = Hills::sunAt(250.0 + 0.005 * step, hills.elevation);
        for (const auto& tile : hills.tiles.shadows()) unbounded += movedAtMost(tile->found, tile->light, sun) > 1e9;
        hills.update(250.0 + 0.005 * step);
        for (std::size_t i = 0; i < hills.town.tiles().size(); ++i) {
            gnomon::PackedShadows now;
            packedShadows(hills.ground, hills.town.tiles()[i].parts, sun, gnomon::TerrainMethod::hull, error,
                          hills.town.origin(), now);
            const gnomon::PackedShadows& shown = hills.tiles.shadows()[i]->found;
            for (std::size_t part = 0; part < now.size(); ++part) {
                if (!now[part].isFan() || !shown[part].isFan()) continue;
                ++compared;
                EXPECT_LE(apart(now[part], shown[part]), error + 1e-3) << "floats about the origin";
            }
        }
    }
    EXPECT_GT(unbounded, 20) << "else there is nothing to see";
    EXPECT_GT(compared, 1000);
    EXPECT_LT(hills.tiles.found(), 10 * all) << "without looking it is each time";
    EXPECT_GT(hills.tiles.found(), 2 * all);
}

/// Shadows of 12 to 25 m move by 0.2 to 0.4 m in a degree and on slopes by some more, in three by 0.6 m at least.
TEST(TileUpdates, WaitWhileTheyAreOffByLessThanAQuarterOfAPixel) {
    Hills hills;
    hills.update(250.0);
    const unsigned all = hills.tiles.found();
    hills.update(251.0, viewAbove(500.0, 16.0));
    EXPECT_EQ(hills.tiles.found(), all);
    hills.update(253.0, viewAbove(500.0, 2.0));
    EXPECT_EQ(hills.tiles.found(), 2 * all);
}

/// The last houses end at 829 m; a low sun in the west takes their shadows 70 m further.
TEST(TileUpdates, AreFoundWhereShadowsFallIntoTheViewOfWhatIsOutside) {
    Hills hills;
    hills.elevation = 10.0;
    hills.update(250.0, viewAbove(1380.0, finePixel)); // from x = 880
    ASSERT_GT(hills.ofSun(250.0), 0);
    double right = 0.0;
    for (const auto& tile : hills.tiles.shadows())
        if (tile->found.size() > 0) right = std::max(right, hills.town.origin().x + tile->high.x);
    EXPECT_GT(right, 880.0);
}

/// Of tiles that cover 100 to 840 m, those beyond the view wait until they are seen.
TEST(TileUpdates, WaitWhileTheyAreOutOfSight) {
    Hills hills;
    const gnomon::ViewFrame beside = viewAbove(2000.0, finePixel), half = viewAbove(-200.0, finePixel); // to x = 300
    hills.update(250.0, beside, 60.0);
    EXPECT_EQ(hills.tiles.found(), 0u);
    for (const double azimuth : {250.0, 251.0, 230.0}) { // the first time, by a little, and by too much to tell
        hills.update(azimuth, half);
        hills.update(azimuth, beside, 60.0);
        long found = 0;
        for (const auto& tile : hills.tiles.shadows()) {
            if (tile->light != Hills::sunAt(azimuth)) continue;
            ++found;
            EXPECT_LT(hills.town.origin().x + tile->low.x, 400.0) << "far from the view";
        }
        EXPECT_GT(found, 0);
        EXPECT_LT(found, long(hills.tiles.shadows().size()));
    }
    hills.update(230.0);
    EXPECT_EQ(hills.ofSun(230.0), long(hills.tiles.shadows().size()));
}

/// What is drawn has the picture's own shadows and no others, whatever was seen before.
TEST(TileUpdates, AreLetGoWhereTheirShadowsWereAndAreNot) {
    Hills hills;
    const gnomon::ViewFrame west = viewAbove(-350.0, finePixel); // to x = 150: the houses from 100 on
    hills.update(250.0, west);
    ASSERT_GT(hills.tiles.found(), 0u);
    hills.update(110.0, viewAbove(2000.0, finePixel));
    for (const auto& tile : hills.tiles.shadows()) EXPECT_EQ(tile->found.size(), 0u);
    Hills low; // so that some have no bound
    low.elevation = 12.0;
    low.update(250.0);
    const gnomon::TileUpdates::List before = low.tiles.shadows();
    low.update(250.005, viewAbove(9000.0, finePixel));
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool isKnown = movedAtMost(before[i]->found, before[i]->light, Hills::sunAt(250.005, 12.0)) < 1e9;
        EXPECT_EQ(low.tiles.shadows()[i] == before[i], isKnown) << i;
    }
}

/// In one degree a shadow moves by some 0.3 m: one of a tile that ends 5 cm beyond the view may be in it now.
TEST(TileUpdates, AreFoundWhereTheyMayHaveMovedIntoTheView) {
    Hills hills;
    hills.update(250.0);
    double left = 1e9;
    for (const auto& tile : hills.tiles.shadows()) left = std::min(left, hills.town.origin().x + tile->low.x);
    hills.update(251.0, viewAbove(left - 500.05, finePixel));
    EXPECT_GT(hills.ofSun(251.0), 0);
    Hills others;
    others.update(250.0);
    others.update(251.0, viewAbove(left - 505.0, finePixel));
    EXPECT_EQ(others.ofSun(251.0), 0);
}

/// Longest way on the screen, in pixels, that a point of a box goes which moves by `off` in plan and as much up or down.
double mostPixels(const gnomon::ViewFrame& view, const osg::BoundingBoxd& box, double off) {
    const osg::Matrixd clip = view.eyeFromGroup * view.projection;
    double most = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner)
        for (int way = 0; way < 16; ++way)
            for (const double rise : {-1.0, 1.0}) {
                const double angle = way * std::acos(-1.0) / 8.0;
                const osg::Vec3d at = box.corner(corner);
                const osg::Vec3d moved = at + osg::Vec3d(std::cos(angle), std::sin(angle), rise) * off;
                const osg::Vec3d by = moved * clip - at * clip;
                most = std::max(most, std::hypot(by.x() * view.pixels.x(), by.y() * view.pixels.y()) / 2.0);
            }
    return most;
}

/// On slopes of 45 degrees: to the corners of a wide view, where a metre is the most pixels, and along the ground.
TEST(TileVisibility, ShowsWhatMayBeOffAsAQuarterOfAPixelAtMost) {
    const osg::BoundingBoxd box(-30.0, -20.0, -5.0, 30.0, 20.0, 10.0);
    gnomon::ShadowDecals corners;
    corners.low = gnomon::toGlm(box._min);
    corners.high = gnomon::toGlm(box._max);
    corners.vertices = {corners.low, corners.high, {30.0f, -20.0f, 0.0f}};
    corners.triangles = {0, 1, 2};
    const osg::ref_ptr<gnomon::TileShadows> tile = new gnomon::TileShadows;
    tile->decals = new gnomon::TileMesh;
    tile->prisms = new gnomon::TileMesh;
    tile->decals->set(corners);
    tile->found.steepest = 1.0;
    tile->widest = 10.0;
    for (const auto& [eye, fovy] : {std::pair(osg::Vec3d(0.0, -60.0, 50.0), 90.0), {{0.0, -400.0, 10.0}, 20.0}}) {
        gnomon::ViewFrame view;
        view.eyeFromGroup = osg::Matrixd::lookAt(eye, osg::Vec3d(), osg::Vec3d(osg::Z_AXIS));
        view.projection = osg::Matrixd::perspective(fovy, 1.0, 1.0, 1000.0);
        view.pixels.set(500.0, 500.0);
        const double off = gnomon::TileVisibility(view, glm::dvec3(0.0)).mayBeOff(*tile, 0.0);
        EXPECT_LE(mostPixels(view, box, off), 0.25 * 1.01) << "1 % for what is not linear";
        EXPECT_GT(mostPixels(view, box, off), 0.1);
    }
}

TEST(TileUpdates, ThatAFrameHoldsStayAsTheyAre) {
    Hills hills;
    hills.update(250.0);
    const gnomon::TileUpdates::List held = hills.tiles.shadows();
    std::vector<std::vector<glm::vec3>> corners;
    for (const auto& tile : held) corners.push_back(tile->found.corners);
    for (const double azimuth : {200.0, 150.0, 100.0}) hills.update(azimuth);
    for (std::size_t i = 0; i < held.size(); ++i) EXPECT_TRUE(held[i]->found.corners == corners[i]) << i;
}

} // namespace
