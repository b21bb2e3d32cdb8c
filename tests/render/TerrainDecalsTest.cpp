// SPDX-License-Identifier: MIT
// Decals on hills: uncut ones against cut ones, and from where the ground turns its other side to the eye.
#include <support/Scene.h>

#include <gnomon/ShadowBin.h>
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

/// 361 houses of 5 by 5 m, some 8 m high, over 360 by 360 m, that go down to -30.
/// @param shadow  null: none.
Scene hillyTown(TerrainShadowGeode* shadow) {
    Scene scene = test::scene({1.0, 0.6, 0.9, 0.0});
    osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(posts, posts);
    field->setXInterval(float(pitch));
    field->setYInterval(float(pitch));
    for (unsigned y = 0; y < posts; ++y)
        for (unsigned x = 0; x < posts; ++x) field->setHeight(x, y, float(hills(pitch * x, pitch * y)));
    osg::ref_ptr<osg::Geode> ground = new osg::Geode;
    ground->addDrawable(new osg::ShapeDrawable(field));
    scene.content->addChild(ground);
    for (int i = 0; i < 361; ++i) {
        const double x = 5.0 + 16.3 * (i % 19), y = 5.0 + 16.3 * (i / 19); // shadows go over the border
        scene.content->addChild(test::node(test::box({x, y, -30.0}, {x + 5.0, y + 5.0, hills(x, y) + 8.0})));
    }
    if (!shadow) return scene;
    shadow->setReceiver({ground});
    scene.addShadow(shadow);
    return scene;
}

Scene withHull() { return hillyTown(new TerrainShadowGeode); }

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

} // namespace

/// Uncut ones are off by up to a quarter of a pixel: so pixels differ at edges alone, one in twenty of a shadow at most. No gap, no
/// fight with the ground. Over a crest a quarter of a pixel of what it hides may be seen, where no edge was.
TEST(TerrainDecals, UncutMarkAsCutOnesButForEdges) {
    for (const double away : {260.0, 500.0}) {
        const test::View view =
            test::perspective({180.0, 180.0 - away, 0.5 * away}, {180.0, 180.0, 0.0}, 400, 300, 40.0, 20.0, 1500.0);
        const test::Picture plain = test::render(hillyTown(nullptr).root, view);
        const test::Picture uncut = test::render(withHull().root, view);
        gnomon::ShadowBin::setFilter(false);
        const test::Picture cut = test::render(withHull().root, view);
        gnomon::ShadowBin::setFilter(true);
        const std::vector<bool> dark = darkIn(cut, plain);
        int gaps = 0, beyond = 0;
        for (int y = 1; y + 1 < cut.height; ++y)
            for (int x = 1; x + 1 < cut.width; ++x) {
                if (uncut.at(x, y) == cut.at(x, y)) continue;
                const int about = darkAbout(dark, x, y, cut.width);
                gaps += about == 9;
                beyond += about == 0;
            }
        const int shadow = cut.different(plain), different = uncut.different(cut);
        EXPECT_GT(shadow, 3000);
        EXPECT_GT(different, 0) << "or nothing was drawn uncut";
        EXPECT_LT(different, shadow / 20);
        EXPECT_EQ(gaps, 0);
        EXPECT_LE(beyond, 2);
    }
}

/// Straight down nothing shows how high a decal is: still those over a hole and beside the ground are cut, and none is lifted out
/// of the view.
TEST(TerrainDecals, SeenStraightDownAreAsCutOnes) {
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
