// SPDX-License-Identifier: MIT
// gnomonviewer as a user has it before him: a window on an X server, keys, and what is then to be seen.
#include "ExampleProgram.h"
#include "Rays.h"

#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>

namespace {

using namespace gnomon::testing;

const osg::Vec3d eye(-1.0, -3.6, 2.2), center(-0.15, 0.1, 0.1), lamp(2.0, -1.5, 2.5);
constexpr int width = 480, height = 360;

Mask differing(const Screenshot& a, const Screenshot& b) {
    Mask result(a.pixels.size(), true);
    for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) result[i] = a.pixels[i] != b.pixels[i];
    return result;
}

constexpr std::uint32_t background = 0x333366u;

bool isGrey(std::uint32_t pixel) { return (pixel & 0xffu) == ((pixel >> 8) & 0xffu) && (pixel & 0xffu) == pixel >> 16; }

/// The text stands on a dark ground, which reaches almost into the lower right corner, where there is else lit ground.
bool hasText(const Screenshot& p) {
    const std::uint32_t corner = p.at(p.width - 7, p.height - 7);
    return isGrey(corner) && corner < 0x606060u;
}

// The scene of data/lab8.osgt, by rays: a white ground of side 4, a sphere and a cube upon it.

/// How far along the sphere or the cube is met.
double meetThings(const osg::Vec3d& from, const osg::Vec3d& way) {
    const double cube = meetBox(from, way, {0.25, -0.25, 0.0}, {0.75, 0.25, 0.5});
    return std::min(meetSphere(from, way, {-0.5, 0.0, 0.25}, 0.5), cube);
}

bool isShadowed(double x, double y, const osg::Vec3d& light) {
    const osg::Matrixd clip = osg::Matrixd::lookAt(eye, center, osg::Vec3d(0, 0, 1)) *
                              osg::Matrixd::perspective(40.0, double(width) / height, 1.0, 100.0);
    const osg::Vec3d way =
        osg::Vec3d(x / width * 2.0 - 1.0, 1.0 - y / height * 2.0, 1.0) * osg::Matrixd::inverse(clip) - eye;
    const double t = -eye.z() / way.z();
    const osg::Vec3d ground = eye + way * t;
    if (!(t > 0.0) || std::abs(ground.x()) > 2.0 || std::abs(ground.y()) > 2.0) return false;
    return meetThings(eye, way) >= t && meetThings(ground, light - ground) < 1.0;
}

/// Where the sphere's edge meets the ground a sliver of shadow is thinner than the tolerance at edges.
constexpr int atFeet = 5;

/// Pixels that differ from the rays' answer and have no neighbour of another answer.
int misplaced(const Mask& shadow, const osg::Vec3d& light) {
    const auto answer = [&](int x, int y) { return isShadowed(x + 0.5, y + 0.5, light); };
    int result = 0;
    for (int y = 2; y < height - 2; ++y)
        for (int x = 2; x < width - 2; ++x) {
            if (shadow[std::size_t(y * width + x)] == answer(x, y)) continue;
            bool edge = false; // OSG's sphere is of flat pieces, up to two pixels inside the true one
            for (const int d : {-2, 2})
                edge = edge || answer(x + d, y) != answer(x, y) || answer(x, y + d) != answer(x, y);
            result += !edge;
        }
    return result;
}

class Viewer : public ExampleProgram {
protected:
    Viewer() : ExampleProgram(GNOMONVIEWER) {}
    /// One sample a pixel, dark shadows and a blue background: each pixel tells what it shows.
    static Arguments onLab8(const Arguments& more) {
        Arguments all = {GNOMON_DATA "/lab8.osgt",
                         "--eye",
                         "-1,-3.6,2.2",
                         "--center",
                         "-0.15,0.1,0.1",
                         "--size",
                         "480x360",
                         "--samples",
                         "1",
                         "--background",
                         "0.2,0.2,0.4",
                         "--ambient",
                         "0.15",
                         "--diffuse",
                         "0.8",
                         "--fill",
                         "0"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void openUnderLamp() { open(onLab8({"--light", "2,-1.5,2.5,1", "--shadow", "planar"})); }

    /// Presses a key after which the picture must be that, to the bit.
    void expectAfter(const std::string& key, const Screenshot& expected) {
        desktop->press(key);
        EXPECT_NO_THROW(
            desktop->pictureWhere(key + " has brought it back", [&](const Screenshot& p) { return p == expected; }));
    }

    /// The picture after keys that may change nothing: where text was shown and hidden after them, they have been seen to.
    Screenshot after(const std::string& key, int times) {
        for (int i = 0; i < times; ++i) desktop->press(key);
        desktop->press("g");
        desktop->pictureWhere(key + " and g show the text", hasText);
        desktop->press("g");
        return desktop->pictureWhere("g hides the text", [](const Screenshot& p) { return !hasText(p); });
    }

    /// From planar shadows on through box, hull, map, volume, traced and auto to none; from there n leads back.
    Screenshot withoutShadow() { return after("n", 7); }
    /// The first picture without its shadow, which n then brings back.
    Screenshot glimpseWithoutShadow() {
        const Screenshot none = withoutShadow();
        expectAfter("n", first);
        return none;
    }
};

} // namespace

TEST_F(Viewer, ShowsTheShadowWhereRaysFindItAndNTakesItAway) {
    openUnderLamp();
    const Screenshot none = withoutShadow();
    const Mask shadow = differing(first, none);
    EXPECT_GT(count(shadow), 5000);
    EXPECT_LE(misplaced(shadow, lamp), atFeet);
    expectAfter("n", first);
}

TEST_F(Viewer, StartsWithTheShadowsOfAutoUnlessAskedForOthers) {
    open(onLab8({"--light", "2,-1.5,2.5,1"}));
    const Screenshot none = after("n", 1); // which follows auto
    Mask shadow = differing(first, none);
    for (std::size_t i = 0; i < shadow.size(); ++i) shadow[i] = shadow[i] && isGrey(none.pixels[i]); // on the ground
    EXPECT_GT(count(shadow), 5000);
    EXPECT_LE(misplaced(shadow, lamp), atFeet);
    after("n", 6); // planar, box, hull, map, volume, traced
    expectAfter("n", first);
}

TEST_F(Viewer, RelightAndBlendDifferInShadowOnly) {
    openUnderLamp();
    const Mask shadow = differing(first, glimpseWithoutShadow());
    const Mask differ = differing(first, pressed("r"));
    EXPECT_GT(count(differ), count(shadow) / 2);
    EXPECT_EQ(beyond(differ, shadow), 0);
    withoutShadow(); // the composite stays when the technique changes
    EXPECT_EQ(differing(first, pressed("n")), differ);
    expectAfter("r", first);
}

TEST_F(Viewer, JKUDMoveTheLightAndItsShadow) {
    openUnderLamp();
    const double a = osg::DegreesToRadians(-15.0);
    const osg::Vec3d turned(lamp.x() * std::cos(a) - lamp.y() * std::sin(a),
                            lamp.x() * std::sin(a) + lamp.y() * std::cos(a), lamp.z());
    const auto shadow = [this] {
        const Screenshot with = desktop->picture(), without = withoutShadow();
        pressed("n");
        return differing(with, without);
    };
    for (int i = 0; i < 3; ++i) pressed("k");
    EXPECT_LE(misplaced(shadow(), turned), atFeet);
    const osg::Vec3d pivot(0.0, 0.0, 0.25), way = turned - pivot; // the scene's centre
    const double level = std::hypot(way.x(), way.y()),
                 elevation = std::atan2(way.z(), level) + osg::DegreesToRadians(10.0);
    const osg::Vec3d raised = pivot + osg::Vec3d(way.x() / level * std::cos(elevation),
                                                 way.y() / level * std::cos(elevation), std::sin(elevation)) *
                                          way.length();
    for (int i = 0; i < 2; ++i) pressed("u");
    EXPECT_LE(misplaced(shadow(), raised), atFeet);
    for (const char* key : {"d", "d", "j", "j"}) pressed(key);
    expectAfter("j", first);
}

/// Over the equator, seen from the south, shadows go from left to right each day: their middle is left of the sphere's at
/// 8 h, right of the cube's left side at 16 h. In them there is the scene's ambient light alone, a fifth of the ground's
/// three quarters.
TEST_F(Viewer, ASunThatRunsCastsToTheWestThenToTheEastAndOnTheNextMorningToTheWest) {
    start(onLab8({"--sun", "2026-03-20T08:00:00Z,0,0", "--shadow", "planar", "--sun-speed", "8000"}));
    desktop->press("g");
    const auto middle = [](const Screenshot& p) {
        double sum = 0.0, count = 0.0;
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x)
                if (p.at(x, y) == 0x262626u) sum += x, ++count;
        return count > 0.0 ? sum / count : width / 2.0;
    };
    const auto isWest = [&](const Screenshot& p) { return middle(p) < 203.0; };
    EXPECT_NO_THROW(
        desktop->pictureWhere("a first morning", isWest, false)); // a busy machine may have missed the first
    EXPECT_NO_THROW(desktop->pictureWhere(
        "evening", [&](const Screenshot& p) { return middle(p) > 280.0; }, false));
    EXPECT_NO_THROW(desktop->pictureWhere("morning", isWest, false));
}

TEST_F(Viewer, GHidesTheTextAndNothingElse) {
    openUnderLamp();
    const Mask text = differing(withText, first);
    EXPECT_GT(count(text), 1000);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (y < height * 3 / 4 || x < height / 3) // a map's picture is a third of the window's height wide
                EXPECT_FALSE(text[std::size_t(y * width + x)]) << x << " " << y;
    expectAfter("g", withText);
}

TEST_F(Viewer, TheTextGivesWayToTheHelp) {
    openUnderLamp();
    const Screenshot help = pressed("h");
    desktop->press("h");
    expectAfter("g", withText);
    expectAfter("h", help);
    expectAfter("h", withText);
}

TEST_F(Viewer, TheTextSaysWhatIsSwitched) {
    openUnderLamp();
    expectAfter("g", withText);
    const auto textOf = [](const Screenshot& p) {
        return std::vector<std::uint32_t>(p.pixels.end() - width * 120, p.pixels.end());
    };
    for (const char* key : {"r", "k", "u", "v", "n"}) { // v does nothing, and says so
        const auto before = textOf(desktop->picture());
        desktop->press(key);
        EXPECT_NO_THROW(desktop->pictureWhere(std::string(key) + " shows in the text",
                                              [&](const Screenshot& p) { return textOf(p) != before; }));
    }
}

TEST_F(Viewer, SShowsStatisticsAndHHelp) {
    openUnderLamp();
    desktop->press("s");
    desktop->pictureWhere(
        "the frame rate is shown", [this](const Screenshot& p) { return p != first; }, false);
    for (int i = 0; i < 3; ++i) desktop->press("s");
    expectAfter("s", first); // five kinds, the last is none
    EXPECT_GT(count(differing(first, pressed("h"))), 5000);
    expectAfter("h", first);
}

TEST_F(Viewer, WShowsTheWireFrameThroughWhichTheBackgroundIsSeen) {
    openUnderLamp();
    const auto seen = [](const Screenshot& p) { return std::count(p.pixels.begin(), p.pixels.end(), background); };
    const Screenshot wire = pressed("w");
    EXPECT_GT(seen(wire), 2 * seen(first));
    pressed("w");
    expectAfter("w", first);
}

TEST_F(Viewer, CWritesTheWindowsPicture) {
    folder.write("gnomonviewer_0_0.png", "precious");
    openUnderLamp();
    desktop->press("c");
    osg::ref_ptr<osg::Image> file;
    const std::string path = folder.path() / "gnomonviewer_0_1.png";
    desktop->pictureWhere("the file is whole", [&](const Screenshot&) {
        return std::filesystem::exists(path) && (file = osgDB::readRefImageFile(path)) && file->data();
    });
    ASSERT_EQ(file->s(), width);
    ASSERT_EQ(file->t(), height);
    int different = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const unsigned char* p = file->data(x, height - 1 - y);
            different += first.at(x, y) != (unsigned(p[0]) << 16 | unsigned(p[1]) << 8 | p[2]);
        }
    EXPECT_EQ(different, 0);
    EXPECT_EQ(readFile(folder.path() / "gnomonviewer_0_0.png"), "precious") << "what is there stays";
}

/// A model without colours and materials takes OpenGL's current ones, which the viewer's own text must not leave behind.
TEST_F(Viewer, ShowsAModelWithoutColoursInTheLightOfGnomonshot) {
    folder.write("pyramid.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0.3 2 0.1\n"
                                "f 1 5 2\nf 2 5 3\nf 3 5 4\nf 4 5 1\nf 1 2 3 4\n");
    Arguments arguments = {"pyramid.obj", "--size", "480x360", "--samples", "1",
                           "--shadow",    "none",   "--light", "2,1,1.5,0"};
    open(arguments);
    arguments.insert(arguments.end(), {"--out", "shot.png"});
    ASSERT_EQ(runGnomonshot(arguments, folder.path()).status, 0);
    const osg::ref_ptr<osg::Image> shot = osgDB::readRefImageFile((folder.path() / "shot.png").string());
    ASSERT_TRUE(shot);
    int different = 0;
    for (int y = 0; y < height / 2; ++y) // above the text
        for (int x = 0; x < width; ++x) {
            const int red = int(withText.at(x, y) >> 16);
            different += std::abs(red - *shot->data(unsigned(x), unsigned(height - 1 - y))) > 2; // by rounding
        }
    EXPECT_LE(different, height) << "two drivers may put an edge into the one or the other pixel";
}

TEST_F(Viewer, FFillsTheScreenAndGivesItBack) {
    openUnderLamp();
    desktop->press("f");
    desktop->pictureWhere("it fills the screen", [](const Screenshot& p) {
        return p.width == 1024 && p.height == 768 && isGrey(p.at(512, 600)) && p.at(512, 600) > 0x808080u;
    });
    desktop->press("f"); // back to a window, of 640 × 480 as osgviewer chooses it on this screen
    const Screenshot small = desktop->pictureWhere("it is a window again", [](const Screenshot& p) {
        return p.width == 640 && p.at(0, 0) == background && isGrey(p.at(320, 440)) && p.at(320, 440) > 0x808080u;
    });
    EXPECT_EQ(small.height, 480);
}

TEST_F(Viewer, NumberKeysChangeTheWayToMoveAndSpaceBringsTheCameraBack) {
    openUnderLamp();
    for (const std::string key : {"2", "3", "4", "5", "6", "7", "1"}) {
        desktop->press(key);
        desktop->press("g"); // when the text is there the key before has been seen to
        const Screenshot now = desktop->pictureWhere("the text is shown after " + key, hasText, false);
        EXPECT_GT(std::count_if(now.pixels.begin(), now.pixels.end(), isGrey), width * height / 10) << key;
        desktop->press("space");
        desktop->press("g");
        desktop->pictureWhere(
            "space has brought the camera back after " + key,
            [&](const Screenshot&
                    p) { // not to the bit: each way rounds in its own way, and flight drifts with the pointer
                return !hasText(p) && count(differing(p, first)) < width * height / 100;
            },
            false);
    }
}

TEST_F(Viewer, EscapeEndsItWithStatus0) {
    openUnderLamp();
    expectEscapeEndsIt();
}
