// SPDX-License-Identifier: MIT
// halomagic: shadow, reflection and halo, each where it belongs and nowhere else; each switch.
#include "ExampleProgram.h"

#include <algorithm>
#include <cmath>

namespace {

using namespace gnomon::testing;

class Halomagic : public ExampleProgram {
protected:
    Halomagic() : ExampleProgram(HALOMAGIC) {}

    osg::ref_ptr<osg::Image> keys(const std::string& letters, int frames = 1) {
        Arguments arguments = {"--frames", std::to_string(frames)};
        if (!letters.empty()) arguments.insert(arguments.end(), {"--keys", letters});
        return picture(arguments);
    }
};

constexpr int size = 600;

/// Pixels whose line of sight meets the floor, seen from above: y = 0, 20 to either side.
Mask floorPixels() {
    const osg::Matrixd clip =
        osg::Matrixd::lookAt(osg::Vec3d(23.98, 36.93, -41.54), osg::Vec3d(-2.0, 6.93, 3.46), osg::Vec3d(0, 1, 0)) *
        osg::Matrixd::perspective(40.0, 1.0, 20.0, 100.0);
    return Sights{size, size, clip}.where([](const osg::Vec3d& from, const osg::Vec3d& way) {
        const osg::Vec3d floor = from - way * (from.y() / way.y());
        return way.y() < 0.0 && std::abs(floor.x()) < 20.1 && std::abs(floor.z()) < 20.1;
    });
}

using Color = osg::Vec3d;

/// Changed pixels must be what the function says of the colour before, to one step a channel. @return how many there are.
int expectEach(const osg::Image& before, const osg::Image& after, const std::function<Color(const Color&)>& expected) {
    const Mask changed = differing(before, after),
               right =
                   maskOf(before, after, [&](const Color&a, const Color&b) { return apart(b, expected(a)) <= 1.6; });
    EXPECT_EQ(beyond(changed, right), 0) << "of " << count(changed);
    return count(changed);
}

Color half(const Color& c) { return c * 0.5; }
osg::Vec3d haloOver(const osg::Vec3d& under) { return osg::Vec3d(204.0, 204.0, 0.0) * 0.3 + under * 0.7; }

bool isBlue(const osg::Vec3d& c) {
    return c.z() > c.x() + 5.0 && c.z() > c.y() + 5.0;
} // the sphere; the floor's rings too

} // namespace

// Who asks a technique is not warned by osg::notify() besides.
TEST_F(Halomagic, TellsEachCauseOnce) {
    const std::string said = run({"--out", "magic.png"}).err;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

TEST_F(Halomagic, MirrorsInTheFloorAndNowhereElse) {
    const auto with = keys(""), without = keys("d");
    EXPECT_EQ(beyond(differing(*with, *without), floorPixels()), 0);
    // The source's floor is 30 % over what is behind it: 70 % of the image come on top, of a black background none.
    const Mask same = maskOf(*without, *with, [](const Color& a, const Color& b) { return apart(a, b) < 1.6; });
    const Mask darker = maskOf(*without, *with, [](const Color& a, const Color& b) {
        return std::min({b.x() - a.x(), b.y() - a.y(), b.z() - a.z()}) < -1.6;
    });
    const int image = beyond(floorPixels(), same), lit = beyond(floorPixels(), darker), all = count(floorPixels());
    EXPECT_GT(all - image, image);
    EXPECT_GT(image, 3000) << "dinosaur and pillar";
    EXPECT_EQ(lit, all);
}

// Light grey of the rings' ground, 204, at 30 % over black; with a reflection and without.
TEST_F(Halomagic, ItsFloorIsThirtyPercentOverBlack) {
    for (const std::string letters : {"a", "ad"}) {
        const auto image = keys(letters);
        const Mask grey =
            maskOf(*image, [](const osg::Vec3d& c) { return apart(c, osg::Vec3d(1, 1, 1) * 61.2) < 1.1; });
        EXPECT_EQ(beyond(grey, floorPixels()), 0);
        EXPECT_GT(count(grey), 20000) << letters;
    }
}

// Blending as the source does: half of floor and reflection alike.
TEST_F(Halomagic, ItsShadowHalvesFloorAndReflectionOnce) {
    const auto without = keys("a"), with = keys("");
    EXPECT_GT(expectEach(*without, *with, half), 1500);
    EXPECT_EQ(beyond(differing(*without, *with), floorPixels()), 0);
}

TEST_F(Halomagic, EachHaloPixelIsBlendedOnceAndTheModelNeverCovered) {
    for (const std::string look : {"", "v", "vv", "n", "nnv", "nnnvv"}) // each model, each shape of a halo
        EXPECT_GT(expectEach(*keys(look), *keys(look + "k"), haloOver), 500) << look;
    const auto bare = keys("adn"), sphere = keys("adnk");
    const Mask onSphere =
        maskOf(*bare, [](const Color& c) { return isBlue(c) && c.x() == 0.0; }); // it alone has no red
    EXPECT_GT(count(onSphere), 5000);
    EXPECT_EQ(beyond(onSphere, differing(*bare, *sphere)), count(onSphere));
}

TEST_F(Halomagic, AnOpaqueHaloHidesWhatIsBehindIt) {
    EXPECT_GT(expectEach(*keys("n"), *keys("nke"), [](const Color&) { return Color(128.0, 128.0, 0.0); }), 5000);
}

TEST_F(Halomagic, RelightTakesTheLightFromALitFloor) {
    const auto none = keys("ar"), on = keys("r");
    const Mask shadow = differing(*none, *on);
    EXPECT_GT(count(shadow), 1500);
    EXPECT_EQ(beyond(shadow, floorPixels()), 0);
    EXPECT_EQ(count(differing(*keys("rr"), *keys(""))), 0);
}

TEST_F(Halomagic, EverySwitchIsSeenAndSwitchedBack) {
    const auto base = keys("");
    for (const std::string key : {"k", "u", "9", "x", "a", "r", "d", "o"}) {
        EXPECT_GT(count(differing(*keys(key), *base)), 100) << key;
        const std::string back = key == "x" ? "xxxx" : key + key;
        EXPECT_EQ(count(differing(*keys(back), *base)), 0) << key;
    }
    const auto second = keys("n"), third = keys("nn"), fourth = keys("nnn");
    for (const auto& other : {second, third, fourth}) EXPECT_GT(count(differing(*base, *other)), 5000);
    EXPECT_GT(count(differing(*second, *third)), 2000);
    EXPECT_EQ(count(differing(*keys("nnnn"), *base)), 0);
    EXPECT_GT(count(differing(*keys("x"), *keys("xx"))), 100) << "linear and mipmap";
}

TEST_F(Halomagic, ThePulseGrowsAndEndsAndMotionJumps) {
    const auto base = keys("");
    EXPECT_GT(expectEach(*base, *keys("p", 16), haloOver), 1000);
    EXPECT_EQ(count(differing(*keys("p", 40), *base)), 0);
    EXPECT_GT(count(differing(*keys("j", 10), *base)), 2000);
}

TEST_F(Halomagic, KeysAndMouseAreSeenInItsWindow) {
    open();
    expectSwitches({"k", "a", "d", "o", "r", "u", "9"});
    for (int i = 0; i < 3; ++i) pressed("n");
    EXPECT_EQ(pressed("n"), first);
    desktop->press("p");
    desktop->pictureWhere(
        "the halo pulses", [&](const Screenshot& p) { return p != first; }, false);
    EXPECT_NO_THROW(desktop->pictureWhere("the pulse is over", [&](const Screenshot& p) { return p == first; }));
    EXPECT_NE(changed("the middle button", [&] { desktop->drag(2, 40, -20); }), first);
    EXPECT_NE(changed("the left button", [&] { desktop->drag(1, 0, -170); }), first);
    expectMotionAfter("j");
    desktop->press("j");
    pressed("g");
    pressed("m"); // the time of a frame is in the text
    expectEscapeEndsIt();
}
