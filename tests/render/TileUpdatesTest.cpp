// SPDX-License-Identifier: MIT
// Shadows of a town on terrain: the same picture as by another technique, what is found anew and when, the sun's way.
#include <support/Scene.h>

#include <gnomon/SunClock.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Switch>
#include <support/Picture.h>

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

using gnomon::TerrainShadowGeode;
using test::Scene;

namespace {

constexpr int side = 30; // houses: more than three tiles hold
const osg::Vec4d sun(1.0, 0.7, 0.6, 0.0);

/// Houses up to 75 m about (0, 0), each under a transform of its own, on a level ground.
struct Town : Scene {
    explicit Town(const osg::Vec4d& from = sun, bool asNodes = true) : Scene(test::groundScene({}, 400.0, from)) {
        const std::vector<test::Mesh> meshes = test::town(side);
        for (std::size_t i = 0; asNodes && i < meshes.size(); ++i) {
            houses.push_back(new osg::MatrixTransform);
            houses.back()->addChild(test::node(meshes[i]));
            content->addChild(houses.back());
        }
        if (!asNodes) content->addChild(test::node(test::joined(meshes)));
    }
    TerrainShadowGeode& cast(TerrainShadowGeode::Method method = TerrainShadowGeode::HULL) {
        osg::ref_ptr<TerrainShadowGeode> shadow = new TerrainShadowGeode;
        shadow->setMethod(method);
        shadow->setReceiver({test::find(*root, "ground")});
        addShadow(shadow);
        return *shadow;
    }
    void shine(const osg::Vec4d& from) { light->getLight()->setPosition(osg::Vec4(from)); }

    std::vector<osg::ref_ptr<osg::MatrixTransform>> houses;
};

const test::View all = test::fromAbove(100.0, 200),
                 slanted = test::perspective({0.0, -105.0, 60.0}, {0.0, 0.0, 0.0}, 300, 200, 40.0, 1.0, 400.0);

test::Picture plain(const test::View& view) { return test::render(Town().root, view); }

test::Picture byPlanar(const osg::Vec4d& light, const test::View& view) {
    Town town(light);
    town.addShadow(test::planar(test::find(*town.root, "ground")));
    return test::render(town.root, view);
}

test::Picture fresh(const osg::Vec4d& light, const test::View& view,
                    TerrainShadowGeode::Method method = TerrainShadowGeode::HULL,
                    const gnomon::CompositorOptions& options = {}) {
    Town town(light);
    town.cast(method);
    return test::render(test::withOptions(town.root, options), view);
}

} // namespace

/// A plane's shadow is exact; on level ground hull must be. Of some 4000 edges in sight a few go through the middle
/// of a pixel to within what floats leave of them.
TEST(TileUpdates, DrawThePlanarTechniquesPicture) {
    for (const test::View& view : {all, slanted}) {
        const test::Picture exact = byPlanar(sun, view);
        const int dark = exact.different(plain(view));
        EXPECT_GT(dark, 2000);
        EXPECT_LE(fresh(sun, view).different(exact), dark / 500);
    }
}

TEST(TileUpdates, AreTheSameOfOneDrawableAndOfManyNodes) {
    Town town(sun, false);
    town.cast();
    EXPECT_EQ(test::render(town.root, all).different(fresh(sun, all)), 0);
}

/// A sun at 6 degrees: each shadow lies over several others', and tiles' over one another.
TEST(TileUpdates, DarkenOnceWhateverLiesOverWhatAndHoweverFewBitsAreLeft) {
    const osg::Vec4d low(1.0, 0.7, 0.13, 0.0);
    const test::Picture exact = byPlanar(low, all), counted = fresh(low, all);
    EXPECT_LE(counted.different(exact), 5) << "see above";
    for (const unsigned reserved : {0x80u, 0xc0u, 0x03u, 0xf0u, 0xf8u, 0x1fu}) {
        gnomon::CompositorOptions options;
        options.reservedStencilBits = reserved;
        EXPECT_EQ(fresh(low, all, TerrainShadowGeode::HULL, options).different(counted), 0) << reserved;
    }
    Town town(low);
    const TerrainShadowGeode& shadow = town.cast();
    EXPECT_EQ(test::render(test::reserving(town.root, 0x3f), all).different(test::render(Town(low).root, all)), 0);
    ASSERT_FALSE(shadow.diagnose().empty());
    EXPECT_NE(shadow.diagnose().back().find("need another stencil bit"), std::string::npos);
}

TEST(TileUpdates, CulledAndAllOfThemGiveTheSameBits) {
    for (const test::View& view : {test::fromAbove(20.0, 200), test::fromAbove(60.0, 200), slanted}) {
        const test::Picture culled = fresh(sun, view);
        gnomon::CompositorOptions everything;
        everything.skipsUntouched = false;
        EXPECT_EQ(fresh(sun, view, TerrainShadowGeode::HULL, everything).different(culled), 0);
    }
}

TEST(TileUpdates, LeaveOutWhatIsSmallerThanAPixel) {
    const auto shadowAt = [](double half) {
        Scene scene = test::groundScene({test::box({1.5, -1.0, 0.0}, {3.5, 1.0, 3.0})}, 400.0, {1.0, 0.0, 1.0, 0.0});
        const test::View view =
            test::fromAbove(half, 101); // an odd number: (0, 0), in the shadow, is the middle of a pixel
        const test::Picture without = test::render(scene.root, view);
        osg::ref_ptr<TerrainShadowGeode> shadow = new TerrainShadowGeode;
        shadow->setReceiver({test::find(*scene.root, "ground")});
        scene.addShadow(shadow);
        const int marked = test::render(scene.root, view).different(without);
        EXPECT_TRUE(shadow->diagnose().empty());
        return marked;
    };
    // It is 5 by 2 units large, 5.4 across.
    EXPECT_GT(shadowAt(0.5 * 101 * 5.0), 0) << "5 units a pixel";
    EXPECT_EQ(shadowAt(0.5 * 101 * 5.6), 0);
}

TEST(TileUpdates, AreFoundOnceWhileTheSunIsStillWhereverTheCameraLooks) {
    Town town;
    TerrainShadowGeode& shadow = town.cast();
    test::Camera camera(town.root, all);
    camera.frame();
    const unsigned found = shadow.builds();
    EXPECT_GE(found, 4u);
    EXPECT_LE(found, 12u) << "tiles are of 64 to 256 houses";
    for (int i = 0; i < 20; ++i) {
        camera.setView(test::perspective({10.0 * i, -105.0 - 3.0 * i, 60.0}, {0.0, 7.0 * i, 0.0}));
        camera.frame();
    }
    EXPECT_EQ(shadow.builds(), found);
}

TEST(TileUpdates, OfACasterThatMovesAloneAreFoundAnew) {
    Town town;
    TerrainShadowGeode& shadow = town.cast();
    test::Camera camera(town.root, all);
    camera.frame();
    const unsigned tiles = shadow.builds();
    for (int i = 1; i <= 5; ++i) {
        const unsigned before = shadow.builds();
        town.houses[455]->setMatrix(osg::Matrixd::translate(0.1 * i, 0.0, 0.0));
        camera.frame();
        EXPECT_GE(shadow.builds(), before + 1);
        EXPECT_LE(shadow.builds(), before + 2) << "the tile it leaves and the one it comes into";
    }
    EXPECT_GT(tiles, 2u);
    Town moved;
    moved.houses[455]->setMatrix(osg::Matrixd::translate(0.5, 0.0, 0.0));
    moved.addShadow(test::planar(test::find(*moved.root, "ground")));
    EXPECT_EQ(camera.frame().different(test::render(moved.root, all)), 0);
}

TEST(TileUpdates, OfCastersThatComeAndGoAloneAreFoundAnew) {
    Town town;
    TerrainShadowGeode& shadow = town.cast();
    test::Camera camera(town.root, all);
    const test::Picture before = camera.frame();
    const auto expectPlanars = [&](const char* what) {
        Town other;
        other.content->removeChildren(0, other.content->getNumChildren());
        for (unsigned i = 0; i < town.content->getNumChildren(); ++i)
            other.content->addChild(town.content->getChild(i));
        other.addShadow(test::planar(test::find(*other.root, "ground")));
        EXPECT_EQ(camera.frame().different(test::render(other.root, all)), 0) << what;
    };
    unsigned found = shadow.builds();
    town.content->removeChild(town.houses[17]);
    expectPlanars("one is gone");
    EXPECT_EQ(shadow.builds(), found + 1);
    found = shadow.builds();
    town.content->addChild(test::node(test::box({70.0, 70.0, 0.0}, {72.0, 72.0, 9.0})));
    expectPlanars("one is new");
    EXPECT_EQ(shadow.builds(), found + 1);
    for (int i = 100; i < 200; ++i) town.content->removeChild(town.houses[static_cast<std::size_t>(i)]);
    expectPlanars("many are gone");
    town.content->removeChildren(1, town.content->getNumChildren() - 1);
    camera.frame();
    for (const auto& house : town.houses) town.content->addChild(house);
    EXPECT_EQ(camera.frame().different(before), 0) << "all are back";
}

/// Walls, and a roof apart from them, which moves: a solid as long as they meet.
TEST(TileUpdates, TakeDrawablesThatShareCornersForOneSolid) {
    test::Mesh walls, roof;
    for (std::size_t i = 0; i < test::box({0, 0, 0}, {1, 1, 1}).size(); i += 3) {
        const test::Mesh box = test::box({60.0, 60.0, 0.0}, {64.0, 64.0, 5.0});
        const bool isRoof = std::all_of(&box[i], &box[i] + 3, [](const glm::dvec3& p) { return p.z == 5.0; });
        (isRoof ? roof : walls).insert((isRoof ? roof : walls).end(), &box[i], &box[i] + 3);
    }
    ASSERT_EQ(roof.size(), 6u);
    const auto picture = [&](gnomon::ShadowTechnique* technique, double lift, bool afterwards) {
        Town town;
        osg::ref_ptr<osg::MatrixTransform> lifted = new osg::MatrixTransform;
        lifted->addChild(test::node(roof));
        town.content->addChild(test::node(walls));
        town.content->addChild(lifted);
        technique->setReceiver({test::find(*town.root, "ground")});
        town.addShadow(technique);
        test::Camera camera(town.root, all);
        lifted->setMatrix(osg::Matrixd::translate(0.0, 0.0, 6.0 - lift));
        if (afterwards) camera.frame();
        lifted->setMatrix(osg::Matrixd::translate(0.0, 0.0, lift));
        return camera.frame();
    };
    for (const double lift : {0.0, 6.0}) {
        const test::Picture exact = picture(test::planar(), lift, false);
        EXPECT_EQ(picture(new TerrainShadowGeode, lift, false).different(exact), 0) << lift;
        EXPECT_EQ(picture(new TerrainShadowGeode, lift, true).different(exact), 0) << lift;
    }
}

TEST(TileUpdates, JumpWithTheSunInTheFrameInWhichItJumps) {
    Town town;
    town.cast();
    test::Camera camera(town.root, all);
    camera.frame();
    for (const osg::Vec4d& light : {osg::Vec4d(-1.0, 0.3, 0.5, 0.0), osg::Vec4d(-1.0, 0.3, -0.1, 0.0), sun,
                                    osg::Vec4d(0.3, 0.4, 40.0, 1.0), osg::Vec4d(0.3, -2.6, 40.0, 1.0), sun}) {
        town.shine(light);
        const test::Picture exact = light.z() > 0.0 ? byPlanar(light, all) : [&] {
            Town dark(light);
            return test::render(dark.root, all);
        }();
        EXPECT_LE(camera.frame().different(exact), 10) // edges through the middle of a pixel, see above
            << light.x() << " " << light.y() << " " << light.z();
    }
}

namespace {

/// The sun over the eastern sky, `minutes` on, a quarter of a degree each.
osg::Vec4d sunAfter(double minutes) {
    const double angle = osg::DegreesToRadians(35.0 + 0.25 * minutes);
    return {std::cos(angle), 0.3, std::sin(angle), 0.0};
}

/// Pixels beside which, within `reach`, the other picture is nowhere the same.
int fartherThan(int reach, const test::Picture& picture, const test::Picture& other) {
    int count = 0;
    for (int y = reach; y < picture.height - reach; ++y)
        for (int x = reach; x < picture.width - reach; ++x) {
            bool found = false;
            for (int dy = -reach; dy <= reach && !found; ++dy)
                for (int dx = -reach; dx <= reach && !found; ++dx)
                    found = dx * dx + dy * dy <= reach * reach && picture.at(x, y) == other.at(x + dx, y + dy);
            count += !found;
        }
    return count;
}

} // namespace

/// By three seconds a frame. The light is white on white: what the sun's height does to colours is left out by a
/// blend of factor 0, which leaves black shadows on whatever stands.
TEST(TileUpdates, FollowASlowSunToWithinAPixelAndAreExactOnceItStands) {
    const test::View near = test::fromAbove(10.0, 200);
    const auto isDark = [](test::Picture picture) {
        for (std::uint32_t& pixel : picture.pixels) pixel = pixel == test::grey(0) ? 1u : 0u;
        return picture;
    };
    const auto setBlack = [](Town& town) {
        town.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        town.group->setDark(0.0f);
    };
    Town town(sunAfter(0.0)), exact(sunAfter(0.0));
    TerrainShadowGeode& shadow = town.cast();
    exact.addShadow(test::planar(test::find(*exact.root, "ground")));
    setBlack(town);
    setBlack(exact);
    test::Camera camera(town.root, near), truth(exact.root, near);
    camera.frame();
    const unsigned tiles = shadow.builds();
    int still = 0;
    for (int frame = 1; frame <= 60; ++frame) {
        const unsigned before = shadow.builds();
        town.shine(sunAfter(0.05 * frame));
        exact.shine(sunAfter(0.05 * frame));
        EXPECT_EQ(fartherThan(1, isDark(camera.frame()), isDark(truth.frame())), 0) << frame;
        still += shadow.builds() == before;
    }
    EXPECT_GT(still, 10) << "what is right is not found again";
    EXPECT_LT(shadow.builds(), 40 * tiles);
    for (int i = 0; i < 40; ++i) camera.frame();
    EXPECT_LE(camera.frame().different(truth.frame()), 2) << "edges through the middle of a pixel, see above";
    const unsigned settled = shadow.builds();
    camera.frame();
    EXPECT_EQ(shadow.builds(), settled);
}

namespace {

/// Of all that the program holds.
std::size_t bytesInUse() { return mallinfo2().uordblks; }

/// A minute of the first day of summer.
struct Moment {
    double latitude;
    int minute; ///< of 1,440 a day.
    osg::Vec4d sun() const {
        const gnomon::SunClock clock(latitude, 0.0);
        const glm::dvec3 towards = clock.towards(*gnomon::julianDay("2026-06-21T00:00:00Z") + minute / 1440.0);
        return {towards.x, towards.y, towards.z, 0.0};
    }
};

/// Four houses on level ground, themselves not drawn, so that all of the shadows is seen.
class Yard {
public:
    explicit Yard(gnomon::ShadowTechnique* technique)
        : _scene(test::groundScene({test::house({-9, -9}, {4, 3, 5}, 20.0), test::house({8, -7}, {3, 3, 4}, 0.0),
                                    test::house({-8, 9}, {4, 4, 2}, 65.0), test::house({9, 8}, {2, 6, 3}, 40.0)},
                                   400.0)) {
        technique->setReceiver({test::find(*_scene.root, "ground")});
        _scene.addShadow(technique);
        for (unsigned i = 1; i < _scene.content->getNumChildren(); ++i) _scene.content->getChild(i)->setNodeMask(2u);
        _scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        _scene.group->setDark(0.0f);
        _camera = std::make_unique<test::Camera>(_scene.root, test::fromAbove(20.0, 80));
        _camera->viewer().getCamera()->setCullMask(1u);
    }

    /// 1 where it is dark then.
    test::Picture darkAt(const Moment& moment) {
        _scene.light->getLight()->setPosition(osg::Vec4f(moment.sun()));
        test::Picture picture = _camera->frame();
        for (std::uint32_t& pixel : picture.pixels) pixel = pixel == test::grey(0) ? 1u : 0u;
        return picture;
    }

private:
    Scene _scene;
    std::unique_ptr<test::Camera> _camera;
};

class SunOver : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(TileUpdates, SunOver, testing::Values(0, 40, 70),
                         [](const auto& one) { return "Latitude" + std::to_string(one.param); });

} // namespace

/// To within the error, 1 pixel, and one of the picture's. The sun moves on by a minute a frame while it is up; of the
/// night there is a frame now and then.
TEST_P(SunOver, HasTheRightShadowsAllDay) {
    Yard yard(new TerrainShadowGeode), exact(test::planar());
    int dark = 0;
    for (int minute = 0; minute < 1440; ++minute) {
        const Moment moment{double(GetParam()), minute};
        if (moment.sun().z() < -0.02 && minute % 30 > 0) continue;
        const test::Picture picture = yard.darkAt(moment);
        if (minute % 3 > 0) continue;
        const test::Picture right = exact.darkAt(moment);
        dark += std::count(right.pixels.begin(), right.pixels.end(), 1u) > 0;
        ASSERT_EQ(fartherThan(2, picture, right), 0) << minute;
    }
    EXPECT_GT(dark, 200);
}

/// The same four hours three times over. Drivers hold a megabyte more now and then: the least of each time counts.
TEST(TileUpdates, HoldNoMoreMemoryWhenTheSunHasComeByAgain) {
    Yard yard(new TerrainShadowGeode);
    std::size_t least[3];
    for (std::size_t& bytes : least) {
        bytes = bytesInUse();
        for (int minute = 600; minute < 840; ++minute) {
            yard.darkAt({40.0, minute});
            bytes = std::min(bytes, bytesInUse());
        }
    }
    EXPECT_LT(least[2], least[1] + 240 * 16) << "16 bytes a frame: less than any allocation has";
}
