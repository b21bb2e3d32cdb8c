// SPDX-License-Identifier: MIT
// shad: the sum of its passes and the compositor's picture against rays, its switches, its maps, its window.
#include "ExampleProgram.h"
#include "TracedLamps.h"

#include <cmath>

namespace {

using namespace gnomon::testing;

class Shad : public ExampleProgram {
protected:
    Shad() : ExampleProgram(SHAD) {}

    osg::ref_ptr<osg::Image> keys(const std::string& letters, int frames = 1, const Arguments& more = {}) {
        Arguments arguments = {SHAD_SCENE, "--frames", std::to_string(frames)};
        if (!letters.empty()) arguments.insert(arguments.end(), {"--keys", letters});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return picture(arguments);
    }
    /// What --count says.
    std::string counted(const std::string& letters, int frames) {
        const Ending ending =
            run({SHAD_SCENE, "--keys", letters, "--frames", std::to_string(frames), "--count", "--out", "o.png"});
        EXPECT_EQ(ending.status, 0) << ending.err;
        return ending.out;
    }
};

const std::vector<osg::Vec3d> white = {{1.0, 1.0, 0.6}, {1.0, 0.6, 1.0}, {0.6, 1.0, 1.0}, {1.0, 1.0, 1.0}};
const std::vector<osg::Vec3d> coloured = {{1.0, 0.0, 0.0}, {0.0, 0.6, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.5, 0.0}};

/// The source's lights: elevation, azimuth, degrees; 1.5 from the middle.
std::vector<TracedLamp> lamps(std::size_t count, const std::vector<osg::Vec3d>& colors, double share) {
    const double places[][2] = {{30.0, 0.0}, {40.0, 120.0}, {50.0, 240.0}, {60.0, 270.0}};
    std::vector<TracedLamp> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back({onOrbit(places[i][0], places[i][1], 1.5), colors[i] * share, 0.1});
    return result;
}

/// How a picture differs from what rays say of its pixels.
struct Judgement {
    int pixels = 0, shadowed = 0, wrong = 0;
    double worst = 0.0;
};

/// Every second row: 26 rays a lamp and pixel.
Judgement judge(const osg::Image& image, const TracedScene& scene, const std::vector<TracedLamp>& lamps, Sum sum) {
    Judgement result;
    for (int y = 0; y < image.t(); y += 2)
        for (int x = 0; x < image.s(); ++x) {
            const auto expected = scene.color(x, y, lamps, sum);
            if (!expected) continue;
            const double off = apart(colorAt(image, x, y), expected->color);
            ++result.pixels;
            result.shadowed += expected->shadows > 0;
            result.wrong += off > 1.001;
            result.worst = std::max(result.worst, off);
        }
    return result;
}

void expectRight(const osg::Image& image, const std::vector<TracedLamp>& lamps, Sum sum, double azimuth = 30.0) {
    const TracedScene scene(SHAD_SCENE, 0.85, onOrbit(25.0, azimuth, 2.3), {640, 512});
    const Judgement found = judge(image, scene, lamps, sum);
    EXPECT_EQ(found.wrong, 0) << "worst " << found.worst;
    EXPECT_GT(found.pixels, 20000);
    EXPECT_GT(found.shadowed, 10000);
}

/// Where nothing is seen, as in the upper left corner; it stays where it is while the eye does.
Mask background(const Screenshot& picture) {
    Mask mask;
    for (const std::uint32_t pixel : picture.pixels) mask.push_back(pixel == picture.at(2, 2));
    return mask;
}

} // namespace

// A pass a light, each rounded to 8 bits as it is added; nothing where the light does not come, ambient light neither.
TEST_F(Shad, AddsALitPassALightWhereRaysReachIt) {
    expectRight(*keys(""), lamps(3, white, 0.25), Sum::Passes);
    expectRight(*keys("k"), lamps(3, coloured, 0.75), Sum::Passes);
    expectRight(*keys("kx"), lamps(3, coloured, 0.75), Sum::Passes);
    expectRight(*keys("", 1, {"--lights", "4"}), lamps(4, white, 0.25), Sum::Passes);
}

// The same scene: all lights in one draw, shadows take away all but the ambient light, and a lamp shines to all sides.
TEST_F(Shad, TheCompositorTakesLightAwayWhereRaysDoNotReachIt) {
    expectRight(*keys("n"), lamps(3, white, 0.25), Sum::Compositor);
    expectRight(*keys("nk"), lamps(3, coloured, 0.75), Sum::Compositor);
}

TEST_F(Shad, AMovedLightMovesItsShadowAlone) {
    std::vector<TracedLamp> moved = lamps(3, white, 0.25);
    moved[1].place = onOrbit(45.0, 130.0, 1.5);
    expectRight(*keys("vvzavv"), moved, Sum::Passes);
    expectRight(*keys("vvzavvn"), moved, Sum::Compositor);
}

TEST_F(Shad, DrawsAMapOnceAndAMovingLightsMapAFrame) {
    EXPECT_EQ(counted("v", 5), "maps drawn: 1 1 1\n");
    // Disco: the first light moves for 34 frames, 0.03 each, then the second.
    EXPECT_EQ(counted("j", 40), "maps drawn: 34 7 1\n");
}

// A frame is 0.03, a light moves for a unit, and t goes from 0 to about 1 meanwhile: frame / 0.97 of the unit.
TEST_F(Shad, DiscoMovesTheLightsInTurnAndTheEye) {
    constexpr int frames = 75;
    std::vector<TracedLamp> moved = lamps(3, white, 0.25);
    moved[0].turned = 25.0 * std::sin(2.0 * osg::PI * 0.99 / 0.97);             // frame 33, its last
    moved[1].place = onOrbit(40.0, 120.0 + 120.0 * 0.98 / 0.97, 1.5);           // frame 66
    moved[2].place = onOrbit(50.0 + (180.0 - 100.0) * 0.22 / 0.97, 240.0, 1.5); // frame 74, the picture's
    expectRight(*keys("j", frames), moved, Sum::Passes, 30.0 + 0.5 * frames);
    EXPECT_EQ(count(differing(*keys(""), *keys("jj", frames))), 0);
}

TEST_F(Shad, FastAndSlowCopiesAreTheSameDepths) {
    EXPECT_EQ(count(differing(*keys(""), *keys("u"))), 0);
    EXPECT_EQ(count(differing(*keys("k"), *keys("kuu"))), 0);
}

// Without displacement and bias every surface is at its own depth: it darkens itself here and there.
TEST_F(Shad, BiasAndDisplacementCureSurfacesThatDarkenThemselves) {
    const auto cured = keys("");
    const Mask without = differing(*cured, *keys("d" + std::string(15, 'e')));
    EXPECT_GT(count(without), 10000);
    EXPECT_LT(count(differing(*cured, *keys("d"))), count(without) / 20);
    EXPECT_EQ(count(differing(*cured, *keys("eeqq"))), 0);
}

TEST_F(Shad, TheWiderFilterIsSmoother) {
    const auto narrow = keys("k"), wide = keys("kx");
    const Mask differ = differing(*narrow, *wide);
    EXPECT_GT(count(differ), 1000);
    EXPECT_LT(count(differ), 30000) << "edges alone";
}

TEST_F(Shad, LooksFromEachLight) {
    const auto one = keys("v"), two = keys("vv"), three = keys("vvv");
    EXPECT_EQ(count(differing(*keys(""), *keys("vvvv"))), 0);
    EXPECT_GT(count(differing(*one, *two)), 50000);
    EXPECT_GT(count(differing(*two, *three)), 50000);
    // What a light does not see has its shadow: from there none is to be seen, all is lit.
    EXPECT_EQ(count(maskOf(*one, [](const osg::Vec3d& c) { return c.length() < 1.0; })), 0);
    EXPECT_EQ(count(differing(*one, *keys("vn"))), 0);
}

TEST_F(Shad, TakesAnyNumberOfFiles) {
    folder.write("plate.obj", "v -3 0 -3\nv 3 0 -3\nv 3 0 3\nv -3 0 3\nf 4 3 2 1\n");
    const auto one = keys(""), two = keys("", 1, {"plate.obj"});
    EXPECT_GT(count(differing(*one, *two)), 50000);
    std::filesystem::remove(folder.path() / "plate.obj");
}

TEST_F(Shad, KeysAndMouseAreSeenInItsWindow) {
    open({SHAD_SCENE});
    expectSwitches({"n", "k", "x", "d"});
    for (int i = 0; i < 3; ++i) pressed("v");
    EXPECT_EQ(pressed("v"), first) << "three lights and the eye";
    pressed("a");
    pressed("z");
    const Mask outline = background(first);
    EXPECT_EQ(background(changed("shift, left", [&] { desktop->drag(1, 60, 0, "Shift_L"); })), outline);
    EXPECT_EQ(background(changed("shift, right", [&] { desktop->drag(3, 0, 60, "Shift_L"); })), outline);
    changed("the middle button", [&] { desktop->drag(2, 40, -20); });
    pressed("v");
    changed("the left button, from the light", [&] { desktop->drag(1, 30, 0); });
    for (int i = 0; i < 3; ++i) pressed("v");
    changed("the right button", [&] { desktop->drag(3, 0, -150); });
    const Screenshot boxes = changed("the left button", [&] { desktop->drag(1, 30, 20); });
    EXPECT_NE(background(boxes), outline) << "the eye moves without shift";
    expectSwitches({"o"}); // from farther away the lights are seen
    expectMotionAfter("j");
    desktop->press("j");
    pressed("g");
    expectEscapeEndsIt();
}
