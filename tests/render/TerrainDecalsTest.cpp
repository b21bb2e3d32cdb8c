// SPDX-License-Identifier: MIT
// Decals on hills: bitmaps against polygons, and from where the ground turns its other side to the eye.
#include "IntoTexture.h"

#include <support/Scene.h>

#include <gnomon/TerrainShadowGeode.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <support/Picture.h>

#include <cmath>

using gnomon::TerrainShadowGeode;
using test::Scene;

namespace {

constexpr unsigned posts = 61;
constexpr double pitch = 6.0;

double hills(double x, double y) { return 6.0 * std::sin(x / 17.0) + 6.0 * std::cos(y / 23.0); }

/// The field, and 361 houses of 5 by 5 m on it, some 8 m high, over 360 by 360 m, that go down 30 m.
/// @param shadow  null: none.
Scene townOn(double (*height)(double, double), TerrainShadowGeode* shadow) {
    Scene scene = test::scene({1.0, 0.6, 0.9, 0.0});
    osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(posts, posts);
    field->setXInterval(float(pitch));
    field->setYInterval(float(pitch));
    for (unsigned y = 0; y < posts; ++y)
        for (unsigned x = 0; x < posts; ++x) field->setHeight(x, y, float(height(pitch * x, pitch * y)));
    osg::ref_ptr<osg::Geode> ground = new osg::Geode;
    ground->addDrawable(new osg::ShapeDrawable(field));
    scene.content->addChild(ground);
    for (int i = 0; i < 361; ++i) {
        const double x = 5.0 + 16.3 * (i % 19), y = 5.0 + 16.3 * (i / 19); // shadows go over the border
        const double top = height(x, y) + 8.0;
        scene.content->addChild(test::node(test::box({x, y, top - 38.0}, {x + 5.0, y + 5.0, top})));
    }
    if (!shadow) return scene;
    shadow->setReceiver({ground});
    scene.addShadow(shadow);
    return scene;
}

Scene hillyTown(TerrainShadowGeode* shadow) { return townOn(hills, shadow); }

Scene withHull() { return hillyTown(new TerrainShadowGeode); }

const test::View far = test::perspective({180.0, -820.0, 500.0}, {180.0, 180.0, 0.0}, 400, 300, 20.0, 20.0, 2500.0);

/// Draws at most so many triangles of decals as they are.
const Scene& withDecals(const Scene& scene, unsigned most) {
    gnomon::CompositorOptions options;
    options.mostDecals = most;
    test::withOptions(scene.root, options);
    return scene;
}

test::Picture byPolygons(const Scene& scene, const test::View& view) {
    return test::render(withDecals(scene, ~0u).root, view);
}

test::Picture byBitmaps(const Scene& scene, const test::View& view) {
    return test::render(withDecals(scene, 0).root, view);
}

/// By prisms, whatever the eye sees of the ground.
Scene withExactDrape() {
    osg::ref_ptr<TerrainShadowGeode> exact = new TerrainShadowGeode;
    exact->setMethod(TerrainShadowGeode::DRAPE);
    exact->setError(0.0);
    return hillyTown(exact);
}

std::vector<bool> darkIn(const test::Picture& picture, const test::Picture& plain) {
    std::vector<bool> dark;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) dark.push_back(picture.pixels[i] != plain.pixels[i]);
    return dark;
}

/// How many pixels of the square of nine about one are.
int darkAbout(const std::vector<bool>& dark, int x, int y, int width) {
    int count = 0;
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) count += dark[static_cast<std::size_t>(v * width + u)];
    return count;
}

/// Texels are 0.4 pixels wide at most where they are nearest, and edges off by less than that: so pixels differ at edges
/// alone, one in ten of a shadow at most (a shadow of 8 by 5 pixels has 26 at its edge, a tenth of a pixel off in the mean).
void expectAlikeButForEdges(const test::Picture& bitmaps, const test::Picture& polygons, const test::Picture& plain) {
    const std::vector<bool> dark = darkIn(polygons, plain);
    int inside = 0, beyond = 0;
    for (int y = 1; y + 1 < plain.height; ++y)
        for (int x = 1; x + 1 < plain.width; ++x) {
            if (bitmaps.at(x, y) == polygons.at(x, y)) continue;
            const int about = darkAbout(dark, x, y, plain.width);
            inside += about == 9;
            beyond += about == 0;
        }
    const int shadow = polygons.different(plain), different = bitmaps.different(polygons);
    EXPECT_GT(shadow, 1500);
    EXPECT_LT(different, shadow / 10);
    EXPECT_EQ(inside, 0);
    EXPECT_LT(beyond, shadow / 100) << "what is so thin that it falls between pixels";
}

} // namespace

TEST(TerrainDecals, BitmapsMarkAsPolygonsButForEdges) {
    for (const double away : {1000.0, 1400.0}) {
        SCOPED_TRACE(away);
        const test::View view =
            test::perspective({180.0, 180.0 - away, 0.5 * away}, {180.0, 180.0, 0.0}, 400, 300, 20.0, 20.0, 2500.0);
        expectAlikeButForEdges(byBitmaps(withHull(), view), byPolygons(withHull(), view),
                               test::render(hillyTown(nullptr).root, view));
        EXPECT_GT(byBitmaps(withHull(), view).different(byPolygons(withHull(), view)), 0) << "are drawn";
    }
}

/// On which a texel is eight times as long as in plan. There would be too many of them: polygons are drawn.
TEST(TerrainDecals, BitmapsAreAsFineOnASteepSlope) {
    const auto slope = [](double x, double) { return -8.0 * x; };
    const double away = 900.0 / std::sqrt(65.0);
    const test::View view = test::perspective({180.0 + 8.0 * away, 180.0, -1440.0 + away}, {180.0, 180.0, -1440.0}, 400,
                                              300, 20.0, 20.0, 2500.0);
    const auto town = [&] { return townOn(slope, new TerrainShadowGeode); };
    expectAlikeButForEdges(byBitmaps(town(), view), byPolygons(town(), view),
                           test::render(townOn(slope, nullptr).root, view));
}

/// In one view: what is seen later is as a view shows it that has seen nothing else.
TEST(TerrainDecals, BitmapsFollowTheSunTheirCastersAndTheEye) {
    const auto from = [](double away) {
        return test::perspective({180.0, 180.0 - away, 0.5 * away}, {180.0, 180.0, 0.0}, 400, 300, 20.0, 20.0, 4000.0);
    };
    const auto sunMoves = [](Scene& scene) { scene.light->getLight()->setPosition({-0.3f, 1.0f, 0.8f, 0.0f}); };
    const auto houseGoes = [](Scene& scene) { scene.content->removeChildren(100, 30); };
    Scene scene = withHull();
    withDecals(scene, 0);
    test::Camera camera(scene.root, from(3200.0)); // coarse
    camera.frame();
    for (int step = 0; step < 5; ++step) {
        SCOPED_TRACE(step);
        const test::View view = from(step == 3 ? 750.0 : 1000.0);
        Scene fresh = withHull(), plain = hillyTown(nullptr);
        for (Scene* each : {&fresh, &plain, &scene}) {
            if (step > 0 && (each != &scene || step == 1)) sunMoves(*each);
            if (step > 1 && (each != &scene || step == 2)) houseGoes(*each);
        }
        camera.setView(view);
        expectAlikeButForEdges(camera.frame(), byPolygons(fresh, view), test::render(plain.root, view));
    }
}

/// As fine as those of a view that was there from the start: bit for bit.
TEST(TerrainDecals, BitmapsGetFinerWhereTheEyeComesNear) {
    const test::View farther =
        test::perspective({180.0, -4000.0, 2000.0}, {180.0, 180.0, 0.0}, 400, 300, 20.0, 20.0, 6000.0);
    const Scene scene = withHull();
    withDecals(scene, 0);
    test::Camera camera(scene.root, farther);
    camera.frame();
    camera.setView(far);
    EXPECT_EQ(camera.frame().different(byBitmaps(withHull(), far)), 0);
}

/// A bitmap says one thing of all samples of a pixel: its edges had no shades between.
TEST(TerrainDecals, AreNoBitmapsWherePixelsHaveSamples) {
    const auto picture = [](unsigned most) {
        test::Target target;
        target.samples = 4;
        return test::IntoTexture(withDecals(withHull(), most).root, far, target).camera->frame();
    };
    EXPECT_EQ(picture(~0u).different(picture(0)), 0);
}

/// Frame by frame, and after all of OpenGL was released.
TEST(TerrainDecals, BitmapsStayTheSameWhileNothingMoves) {
    const Scene scene = withHull();
    withDecals(scene, 0);
    test::Camera camera(scene.root, far);
    const test::Picture first = camera.frame();
    EXPECT_EQ(camera.frame().different(first), 0);
    scene.root->releaseGLObjects();
    EXPECT_EQ(camera.frame().different(first), 0);
}

/// Those beside the ground, too.
TEST(TerrainDecals, SeenStraightDownAreAsPrisms) {
    const test::View view{400, 400, osg::Matrixd::translate(-180.0, -180.0, -100.0),
                          osg::Matrixd::ortho(-200.0, 200.0, -200.0, 200.0, 1.0, 200.0)};
    const auto picture = [&](const Scene& scene) { return test::render(scene.root, view); };
    const test::Picture exact = picture(withExactDrape());
    const int shadow = exact.different(picture(hillyTown(nullptr)));
    EXPECT_GT(shadow, 5000);
    EXPECT_LT(picture(withHull()).different(exact), shadow / 50);
}

/// From below, steeply and flat, and in a mirror, the ground's upper side is turned away.
TEST(TerrainDecals, AreSeenOnBothSidesOfTheGround) {
    const test::View below = test::perspective({180.0, 180.0, -90.0}, {180.0, 230.0, 0.0}, 300, 200, 60.0, 1.0, 800.0),
                     flat =
                         test::perspective({180.0, -300.0, -80.0}, {180.0, 180.0, -8.0}, 300, 200, 25.0, 1.0, 1500.0),
                     mirrored =
                         test::perspective({-180.0, 20.0, 120.0}, {-180.0, 180.0, 0.0}, 300, 200, 60.0, 1.0, 800.0);
    for (const test::View* view : {&below, &flat, &mirrored}) {
        const auto picture = [&](const Scene& scene) {
            osg::ref_ptr<osg::MatrixTransform> root = new osg::MatrixTransform;
            if (view == &mirrored) root->setMatrix(osg::Matrixd::scale(-1.0, 1.0, 1.0));
            root->addChild(scene.root);
            return test::render(root, *view);
        };
        const test::Picture exact = picture(withExactDrape());
        const int shadow = exact.different(picture(hillyTown(nullptr)));
        EXPECT_GT(shadow, 1500);
        EXPECT_LT(picture(withHull()).different(exact), shadow / 20);
    }
}
