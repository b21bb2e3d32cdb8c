// SPDX-License-Identifier: MIT
#include "Program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <osg/Geometry>
#include <osg/Image>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cmath>
#include <regex>

namespace {

using namespace gnomon::testing;
using Arguments = std::vector<std::string>;

const std::string scene = GNOMON_DATA "/lab8.osgt";

class Gnomonshot : public ::testing::Test {
protected:
    Ending run(Arguments arguments) {
        const Ending ending = runGnomonshot(arguments, folder.path());
        EXPECT_EQ(ending.status, 0) << ending.err;
        return ending;
    }

    osg::ref_ptr<osg::Image> load(const std::string& name) {
        osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile((folder.path() / name).string());
        EXPECT_TRUE(image) << name;
        return image ? image : osg::ref_ptr<osg::Image>(new osg::Image);
    }

    /// Picture of `files` with these options; without others 160x120, one sample a pixel, lit by its lights alone before OSG's
    /// blue: what is lit, in shadow and background has colours of its own then.
    osg::ref_ptr<osg::Image> shoot(Arguments arguments) {
        const Arguments plain = {"--size",      "160x120", "--samples", "1",     "--background",
                                 "0.2,0.2,0.4", "--fill",  "0",         "--out", "o.png"};
        for (std::size_t i = 0; i < plain.size(); i += 2)
            if (std::find(arguments.begin(), arguments.end(), plain[i]) == arguments.end())
                arguments.insert(arguments.end(), {plain[i], plain[i + 1]});
        run(arguments);
        return load("o.png");
    }

    TemporaryFolder folder;
};

/// Pixels in which a channel differs by more than `steps` of 255.
long countDifferent(const osg::Image& a, const osg::Image& b, float steps = 0.0f) {
    EXPECT_TRUE(a.s() == b.s() && a.t() == b.t());
    long count = 0;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x) {
            const osg::Vec4 off = a.getColor(x, y) - b.getColor(x, y);
            const float most = std::max({std::abs(off.r()), std::abs(off.g()), std::abs(off.b())});
            count += 255.0f * most > steps + 0.5f;
        }
    return count;
}

int red(const osg::Image& image, int x, int y) { return int(std::lround(image.getColor(x, y)[0] * 255.0f)); }

/// A box of side 1 on nothing.
const std::string greenBox = R"(#Ascii Scene
#Version 161
#Generator by hand
osg::Geode { UniqueID 1 Drawables 1 { osg::ShapeDrawable { UniqueID 2
  Shape TRUE { osg::Box { UniqueID 3 Center 0 0 0.5 HalfLengths 0.5 0.5 0.5 } } Color 0 1 0 1 } } }
)";

/// A box of side 1 that moves 3 a second along x.
const std::string movingBox = R"(#Ascii Scene
#Version 161
#Generator by hand
osg::MatrixTransform { UniqueID 1
  UpdateCallback TRUE { osg::AnimationPathCallback { UniqueID 2 AnimationPath TRUE { osg::AnimationPath { UniqueID 3
    TimeControlPointMap 2 { Time 0 { Position 0 0 0 Rotation 0 0 0 1 Scale 1 1 1 } Time 100 { Position 300 0 0 Rotation 0 0 0 1 Scale 1 1 1 } }
  } } } }
  Children 1 { osg::Geode { UniqueID 4 Drawables 1 { osg::ShapeDrawable { UniqueID 5
    Shape TRUE { osg::Box { UniqueID 6 Center 0 0 0 HalfLengths 0.5 0.5 0.5 } } } } } } }
)";

/// A square plate of side 1 at height 1 over the origin, in z up or, with y up, turned.
std::string plate(bool yUp) {
    const char* z = "v -.5 -.5 1\nv .5 -.5 1\nv .5 .5 1\nv -.5 .5 1\n";
    const char* y = "v -.5 1 .5\nv .5 1 .5\nv .5 1 -.5\nv -.5 1 -.5\n";
    return std::string(yUp ? y : z) + "f 1 2 3\nf 1 3 4\n";
}

const Arguments fromAbove = {"--eye", "0,0,10", "--center", "0,0,0",  "--viewup",
                             "0,1,0", "--fovy", "45",       "--size", "100x100"};

Arguments operator+(Arguments a, const Arguments& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST_F(Gnomonshot, WritesAPictureOfTheSizeAskedFor) {
    const osg::ref_ptr<osg::Image> image = shoot({scene, "--size", "123x45"});
    EXPECT_EQ(image->s(), 123);
    EXPECT_EQ(image->t(), 45);
    EXPECT_EQ(folder.list(), std::vector<std::string>{"o.png"}) << "nothing else is left";
}

TEST_F(Gnomonshot, WritesEveryFormatThatOsgWrites) {
    for (const char* name : {"a.png", "a.jpg", "a.bmp", "a.tif", "a.rgb"}) {
        run({scene, "--size", "40x30", "--out", name});
        EXPECT_EQ(load(name)->s(), 40) << name;
    }
}

TEST_F(Gnomonshot, DrawsTheShadowsOfAutoUnlessAskedForOthers) {
    const osg::ref_ptr<osg::Image> usual = shoot({scene}), without = shoot({scene, "--shadow", "none"});
    EXPECT_EQ(countDifferent(*usual, *shoot({scene, "--shadow", "auto:error=0.25"})), 0);
    EXPECT_GT(countDifferent(*usual, *without), 40);
    EXPECT_GT(countDifferent(*without, *shoot({scene, "--shadow", "planar"})), 40);
}

TEST_F(Gnomonshot, LeavesScenesThatHoldTechniquesToThem) {
    folder.write("own.osgt", R"(#Ascii Scene
#Version 161
#Generator by hand
gnomon::ShadowCasterGroup { UniqueID 1 Children 2 {
  osg::Geode { UniqueID 2 Drawables 1 { osg::ShapeDrawable { UniqueID 3
    Shape TRUE { osg::Box { UniqueID 4 Center 0 0 0.5 HalfLengths 0.5 0.5 0.5 } } } } }
  gnomon::PlanarShadowNode { UniqueID 5 Planes 1 { 0 0 1 0 } } } }
)");
    setenv("OSG_LIBRARY_PATH", GNOMON_LIBRARIES, 1); // for the plugin
    run({"own.osgt", "--size", "40x30", "--frames", "1", "--stats", "s.json"});
    EXPECT_TRUE(nlohmann::json::parse(readFile(folder.path() / "s.json")).at("decisions").empty());
    EXPECT_EQ(run({"own.osgt", "--size", "40x30", "--recommend"}).out.rfind("light 0: ", 0), 0u);
}

TEST_F(Gnomonshot, DrawsTheSamePictureEveryTime) {
    const osg::ref_ptr<osg::Image> once = shoot({scene, "--shadow", "planar"});
    EXPECT_EQ(countDifferent(*once, *shoot({scene, "--shadow", "planar", "--frames", "5"})), 0);
    EXPECT_EQ(countDifferent(*once, *shoot({scene, "--shadow", "planar", "--frames", "2", "--stats", "s.json"})), 0)
        << "the light is back where it was given";
}

/// Animated files go by the scene's time, 30 frames a second: a box that moves 3 a second is 0.9 on in the tenth frame.
TEST_F(Gnomonshot, DrawsWhatMovesWhereTheSceneTimeOfItsFramesPutsIt) {
    folder.write("moving.osgt", movingBox);
    const auto at = [&](const char* frames) {
        const auto image =
            shoot(Arguments{"moving.osgt", "--shadow", "none", "--ground", "none", "--frames", frames} + fromAbove);
        double sum = 0.0, count = 0.0;
        for (int x = 0; x < 100; ++x)
            if (red(*image, x, 50) != 51) sum += x + 0.5, ++count;
        return sum / count;
    };
    const double unit = 50.0 / (9.5 * std::tan(osg::DegreesToRadians(22.5))); // pixels, at the box's top
    EXPECT_NEAR(at("1"), 50.0, 0.51);
    EXPECT_NEAR(at("10"), 50.0 + 0.9 * unit, 0.51);
}

/// Of four samples a pixel on an edge is a mean of colours on either side; all others stay as they are.
TEST_F(Gnomonshot, SamplesSmoothEdgesAndNothingElse) {
    const osg::ref_ptr<osg::Image> one = shoot({scene, "--shadow", "planar"}),
                                   four = shoot({scene, "--shadow", "planar", "--samples", "4"});
    long mixed = 0, elsewhere = 0;
    for (int y = 2; y < one->t() - 2; ++y)
        for (int x = 2; x < one->s() - 2; ++x) {
            int least = 255, most = 0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    least = std::min(least, red(*one, x + i, y + j));
                    most = std::max(most, red(*one, x + i, y + j));
                }
            const int now = red(*four, x, y);
            mixed += most - least > 60 && now > least + 10 && now < most - 10;
            elsewhere += now < least - 1 || now > most + 1;
        }
    EXPECT_GT(mixed, 60);
    EXPECT_EQ(elsewhere, 0) << "beyond what is near in the picture of one sample";
}

/// Without an eye the picture is as near as what casts and its shadow allow: 1 / 1.05 of its width or height, by whichever is
/// narrower, and what else there is may be cut off.
TEST_F(Gnomonshot, ShowsWhatCastsAndItsShadowAsLargeAsTheyCanBe) {
    folder.write("box.osgt", greenBox);
    for (const std::string size : {"160x120", "60x160", "300x70"})
        for (const std::string light : {"1,-1,1,0", "-1.5,0.7,1.3,0", "3,-3,4,1", "0,0,-1,0"}) {
            const Arguments all = {"box.osgt", "--size", size, "--light", light};
            const auto lit = shoot(all + Arguments{"--shadow", "none"}),
                       shadowed = shoot(all + Arguments{"--shadow", "planar"});
            osg::BoundingBox seen;
            for (int y = 0; y < lit->t(); ++y)
                for (int x = 0; x < lit->s(); ++x)
                    if (red(*lit, x, y) == 0 || red(*lit, x, y) != red(*shadowed, x, y))
                        seen.expandBy(float(x), float(y), 0.0f), seen.expandBy(float(x + 1), float(y + 1), 0.0f);
            const float across = (seen.xMax() - seen.xMin()) / float(lit->s()),
                        up = (seen.yMax() - seen.yMin()) / float(lit->t());
            EXPECT_NEAR(std::max(across, up), 1.0 / 1.05, 0.04) << size << " " << light;
            EXPECT_GT(std::min(seen.xMin(), seen.yMin()), 0.0f) << size << " " << light;
            EXPECT_LT(seen.xMax(), float(lit->s())) << size << " " << light;
            EXPECT_LT(seen.yMax(), float(lit->t())) << size << " " << light;
        }
}

/// One node named ground at two places, as tiles of a floor are.
TEST_F(Gnomonshot, ShowsAGroundThatStandsAtTwoPlaces) {
    folder.write("tiles.osgt", R"(#Ascii Scene
#Version 161
#Generator by hand
osg::Group { UniqueID 1 Children 2 {
  osg::MatrixTransform { UniqueID 2 Children 1 {
    osg::Geode { UniqueID 3 Name "ground" Drawables 1 { osg::ShapeDrawable { UniqueID 4
      Shape TRUE { osg::Box { UniqueID 5 HalfLengths 0.5 0.5 0.01 } } Color 0 1 0 1 } } } }
    Matrix { 1 0 0 0  0 1 0 0  0 0 1 0  -0.5 0 0 1 } }
  osg::MatrixTransform { UniqueID 6 Children 1 { osg::Geode { UniqueID 3 } }
    Matrix { 1 0 0 0  0 1 0 0  0 0 1 0  0.5 0 0 1 } } } }
)");
    const auto shown = shoot({"tiles.osgt", "--shadow", "none", "--size", "160x120"});
    int greens = 0;
    for (int y = 0; y < shown->t(); ++y)
        for (int x = 0; x < shown->s(); ++x) greens += red(*shown, x, y) == 0;
    EXPECT_GT(greens, 1000) << "a third of what it fills from any side above";
}

/// A telescope: the square of side 1 at a distance of 9 is 2 atan(0.5 / 9) = 6.36 degrees wide.
TEST_F(Gnomonshot, LooksThroughATelescope) {
    folder.write("plate.obj", plate(false));
    const auto image = shoot({"plate.obj", "-O", "noRotation", "--shadow", "none", "--ground", "none", "--eye",
                              "0,0,10", "--center", "0,0,0", "--viewup", "0,1,0", "--size", "100x100", "--fovy=0.5"});
    for (const int at : {0, 50, 99}) EXPECT_NE(red(*image, at, at), 51) << "the plate, no background";
}

/// Ground lit 0.1 + 0.7 cos 45° = 0.595 of white, shadowed 0.1: 151.7 and 25.5 of 255. A sun at 45° moves the shadow by the
/// height.
TEST_F(Gnomonshot, TakesAwayExactlyTheLight) {
    folder.write("both.obj", plate(false) + "v -.01 -.01 0\nv .01 -.01 0\nv .01 .01 0\nf 5 6 7\n");
    const osg::ref_ptr<osg::Image> image =
        shoot(Arguments{"both.obj", "-O", "noRotation", "--shadow", "planar", "--light", "1,0,1,0", "--ambient", "0.1",
                        "--diffuse", "0.7", "--ground", "8"} +
              fromAbove); // ground at z = 0; 100 pixels show 2 · 10 tan 22.5° = 8.28
    const auto at = [&](double x, double y) { return red(*image, int(50 + x * 12.07), int(50 + y * 12.07)); };
    EXPECT_NEAR(at(-1.1, 0.0), 25.5, 0.6);
    EXPECT_NEAR(at(-1.4, 0.4), 25.5, 0.6);
    EXPECT_EQ(at(-1.6, 0.0), 152);
    EXPECT_EQ(at(1.1, 0.0), 152);
    EXPECT_EQ(at(-1.1, 0.6), 152);
}

/// Without options: a level ground gets 0.3 of ambient light and 0.35 sin 30° of the fill light; a sun at 45° adds 0.65 sin 45°.
TEST_F(Gnomonshot, LightsShadowsSoftlyWhereNoOptionSaysOtherwise) {
    folder.write("both.obj", plate(false) + "v -.01 -.01 0\nv .01 -.01 0\nv .01 .01 0\nf 5 6 7\n");
    run(Arguments{"both.obj", "-O", "noRotation", "--light", "1,0,1,0", "--out", "o.png"} + fromAbove);
    const osg::ref_ptr<osg::Image> image = load("o.png");
    const double dark = 0.3 + 0.35 * 0.5, lit = dark + 0.65 * std::sqrt(0.5);
    EXPECT_NEAR(red(*image, 50 - 13, 50), 255.0 * dark, 0.6);
    EXPECT_NEAR(red(*image, 50 + 13, 50), 255.0 * lit, 0.6);
    EXPECT_NEAR(red(*image, 50 - 20, 50), 255.0 * lit, 0.6);
}

/// The same ground: 0.1, 0.2 and 0.3 of ambient light, and 0.5, 0.4 and 0 sin 45° of the sun.
TEST_F(Gnomonshot, TakesColoursOfLight) {
    folder.write("plate.obj", plate(false));
    const auto image = shoot(Arguments{"plate.obj", "-O", "noRotation", "--light", "1,0,1,0", "--shadow", "none",
                                       "--ambient", "0.1,0.2,0.3", "--diffuse", "0.5,0.4,0"} +
                             fromAbove);
    const osg::Vec4 lit = image->getColor(90, 50);
    const double sun = std::sqrt(0.5);
    EXPECT_NEAR(lit.r(), 0.1 + 0.5 * sun, 0.6 / 255.0);
    EXPECT_NEAR(lit.g(), 0.2 + 0.4 * sun, 0.6 / 255.0);
    EXPECT_NEAR(lit.b(), 0.3, 0.6 / 255.0);
}

/// osgShadow takes the lights that a traversal has met before its nodes.
TEST_F(Gnomonshot, LightsFilesThatHoldOsgShadowsNodes) {
    const std::string
        box = "osg::Geode { UniqueID 2 Drawables 2 {\n"
              "  osg::ShapeDrawable { UniqueID 3 Shape TRUE { osg::Box { UniqueID 4 Center 0 0 1 HalfLengths 0.5 0.5 "
              "0.5 } } }\n  osg::ShapeDrawable { UniqueID 5 Shape TRUE { osg::Box { UniqueID 6 Center 0 0 -0.1 "
              "HalfLengths 3 3 0.1 } } } } }\n",
        start = "#Ascii Scene\n#Version 161\n#Generator by hand\n";
    folder.write("plain.osgt", start + box);
    folder.write("shadowed.osgt", start + "osgShadow::ShadowedScene { UniqueID 1 Children 1 { " + box +
                                      "} ShadowTechnique TRUE { osgShadow::ShadowMap { UniqueID 7 } } }\n");
    const Arguments view = {"--shadow", "none", "--light", "1,0,1,0"};
    EXPECT_GT(countDifferent(*shoot(Arguments{"plain.osgt"} + view + fromAbove),
                             *shoot(Arguments{"shadowed.osgt"} + view + fromAbove), 40.0f),
              50);
}

TEST_F(Gnomonshot, DrawsEightSamplesAPixelWithoutAnOption) {
    const Arguments view = {scene, "--shadow", "planar", "--size", "160x120", "--out", "o.png"};
    run(view);
    const auto usual = load("o.png");
    run(view + Arguments{"--samples", "8"});
    EXPECT_EQ(countDifferent(*usual, *load("o.png")), 0);
    run(view + Arguments{"--samples", "1"});
    EXPECT_GT(countDifferent(*usual, *load("o.png")), 200);
}

/// Neither a horizon nor a corner of the ground is seen: the outermost pixels, sky and ground, have one colour.
TEST_F(Gnomonshot, ItsGroundEndsNowhere) {
    folder.write("box.osgt", greenBox);
    for (const std::string eye : {"-4,-6,5", "-4,-6,1.2", "-20,-30,2"})
        for (const std::string light : {"1,-1,1,0", "1,0.5,0.4,0", "-0.2,0.1,3,0"}) {
            run({"box.osgt", "--eye", eye, "--light", light, "--size", "160x120", "--out", "o.png"});
            const auto image = load("o.png");
            int least = 255, most = 0;
            for (int y = 0; y < image->t(); ++y)
                for (int x = 0; x < image->s(); ++x)
                    if (x == 0 || y == 0 || x == image->s() - 1 || y == image->t() - 1) {
                        least = std::min(least, red(*image, x, y));
                        most = std::max(most, red(*image, x, y));
                    }
            EXPECT_LE(most - least, 1) << eye << " " << light;
        }
}

TEST_F(Gnomonshot, TurnsScenesThatAreYUp) {
    folder.write("z.obj", plate(false));
    folder.write("y.obj", plate(true));
    const Arguments rest = {"-O", "noRotation", "--shadow", "planar", "--light", "1,0.5,3,0"};
    const osg::ref_ptr<osg::Image> z = shoot(Arguments{"z.obj"} + rest + fromAbove);
    EXPECT_EQ(countDifferent(*z, *shoot(Arguments{"y.obj", "--up", "y"} + rest + fromAbove)), 0);
    EXPECT_GT(countDifferent(*z, *shoot(Arguments{"y.obj"} + rest + fromAbove)), 0);
}

TEST_F(Gnomonshot, PutsGroundOnlyUnderScenesWithoutOne) {
    folder.write("plate.obj", plate(false));
    const osg::ref_ptr<osg::Image> none = shoot({"plate.obj", "--ground", "none"});
    EXPECT_GT(countDifferent(*none, *shoot({"plate.obj"})), 1000);
    EXPECT_GT(countDifferent(*shoot({"plate.obj", "--ground", "2"}), *shoot({"plate.obj"})), 1000);
    EXPECT_EQ(countDifferent(*shoot({scene}), *shoot({scene, "--ground", "none"})), 0);
}

/// A box on a sheet that is no ground by its name.
const std::string boxOnItsFloor = R"(#Ascii Scene
#Version 161
#Generator by hand
osg::Geode { UniqueID 1 Name "mat" Drawables 2 {
  osg::ShapeDrawable { UniqueID 2 Shape TRUE { osg::Box { UniqueID 3 Center 0 0 0.5 HalfLengths 0.5 0.5 0.5 } } }
  osg::ShapeDrawable { UniqueID 4 Shape TRUE { osg::Box { UniqueID 5 Center 0 0 0 HalfLengths 3 3 0 } } Color 0 1 0 1 } } }
)";

/// The sheet is green, from wherever it is seen, and a ground white; red is 0 of the one, 255 of the other, 51 of the sky.
TEST_F(Gnomonshot, LeavesAFloorOfTheModelsOwnWhole) {
    folder.write("floor.osgt", boxOnItsFloor);
    const Arguments flat = {"floor.osgt", "--shadow", "none", "--ambient", "1", "--diffuse", "0"};
    for (const Arguments& view : {fromAbove, Arguments{"--size", "160x120", "--eye", "-9,-13,9"}}) {
        const auto alone = shoot(flat + view), onGround = shoot(flat + view + Arguments{"--ground", "20"});
        int greens = 0;
        for (int y = 0; y < alone->t(); ++y)
            for (int x = 0; x < alone->s(); ++x) {
                greens += red(*alone, x, y) == 0;
                if (red(*alone, x, y) != 51) EXPECT_EQ(red(*alone, x, y), red(*onGround, x, y)) << x << " " << y;
            }
        EXPECT_GT(greens, 1000);
        EXPECT_EQ(red(*alone, 80, 3), 51);
        EXPECT_EQ(red(*onGround, 80, 3), 255);
    }
    EXPECT_EQ(run(flat + Arguments{"--out", "o.png"}).err, "");
    EXPECT_EQ(run(flat + Arguments{"--out", "o.png", "--ground", "20"}).err, "");
    folder.write("plate.obj", plate(false));
    const std::string said = run({"plate.obj", "--out", "o.png"}).err;
    EXPECT_NE(said.find("gnomonshot: note: the scene has no floor"), std::string::npos) << said;
}

/// Of floors, a slab is one, and what dips into it a little does not matter; a box alone is none, flat as it may be.
TEST_F(Gnomonshot, KnowsAFloorByWhatStandsOnIt) {
    const auto sceneOf = [](const std::string& floor, const std::string& box) {
        return "#Ascii Scene\n#Version 161\n#Generator by hand\nosg::Geode { UniqueID 1 Drawables 2 {\n"
               "  osg::ShapeDrawable { UniqueID 2 Shape TRUE { osg::Box { UniqueID 3 " +
               floor + " } } }\n  osg::ShapeDrawable { UniqueID 4 Shape TRUE { osg::Box { UniqueID 5 " + box +
               " } } } } }\n";
    };
    const std::string slab = "Center 0 0 -0.05 HalfLengths 4 4 0.05", flat = "Center 9 0 0.1 HalfLengths 1 1 0.1";
    const auto hasGround = [&](const std::string& file) {
        folder.write("scene.osgt", file);
        return run({"scene.osgt", "--shadow", "none", "--out", "o.png"}).err.find("got a white ground") !=
               std::string::npos;
    };
    EXPECT_FALSE(hasGround(sceneOf(slab, "Center 0 0 0.5 HalfLengths 0.5 0.5 0.5")));
    EXPECT_FALSE(hasGround(sceneOf(slab, "Center 1 0 0.3 HalfLengths 0.5 0.5 0.6"))) << "0.2 below the slab";
    EXPECT_TRUE(hasGround(sceneOf("Center 8 0 0.1 HalfLengths 1 1 0.1", flat))) << "two of one height";
    EXPECT_TRUE(hasGround(sceneOf("Center 0 0 2 HalfLengths 4 4 2", "Center 0 0 5 HalfLengths 1 1 1")))
        << "a house and its tower";
}

/// Two pages of a book, 30 long together, of which one lies: so little of it that it is no floor, or half.
TEST_F(Gnomonshot, FramesAllOfAModelWhoseFloorIsAPartOfIt) {
    for (const std::string lies : {"10", "15"}) {
        const std::string pages = "v 0 0 0\nv L 0 0\nv L 6 0\nv 0 6 0\nv 30 0 6\nv 30 6 6\n"
                                  "f 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\n";
        folder.write("book.obj", std::regex_replace(pages, std::regex("L"), lies));
        const auto image = shoot({"book.obj", "-O", "noRotation", "--ground", "none", "--shadow", "none"});
        int drawn = 0;
        for (int y = 0; y < image->t(); ++y)
            for (int x = 0; x < image->s(); ++x) {
                const bool isAtRim = x == 0 || y == 0 || x == image->s() - 1 || y == image->t() - 1;
                drawn += red(*image, x, y) != 51;
                if (isAtRim) EXPECT_EQ(red(*image, x, y), 51) << lies << ": " << x << " " << y;
            }
        EXPECT_GT(drawn, 1000);
    }
}

TEST_F(Gnomonshot, SaysThatALightBelowTheGroundThrowsNoShadowOnIt) {
    const auto saidOf = [this](const std::string& light, const Arguments& more = {}) {
        return run(Arguments{scene, "--size", "80x60", "--out", "o.png", "--light", light} + more).err;
    };
    const std::string start = "gnomonshot: note: the light ", says = " does not stand above the ground, so no shadow ";
    EXPECT_EQ(saidOf("0,0,-1,0"), start + "0,0,-1,0" + says + "falls there; give --light x,y,z,0 with z above 0.\n");
    EXPECT_EQ(saidOf("1,2,0,0"), start + "1,2,0,0" + says + "falls there; give --light x,y,z,0 with z above 0.\n");
    EXPECT_EQ(saidOf("1,2,-3,1"), start + "1,2,-3,1" + says + "falls there; give --light x,y,z,1 with z above 0.\n")
        << "the ground of lab8 lies at 0";
    for (const std::string above : {"0,0,1,0", "1,2,3,1"}) EXPECT_EQ(saidOf(above), "");
    for (const std::string name : {"--casters", "--shadow"}) EXPECT_EQ(saidOf("0,0,-1,0", {name, "none"}), "");
    folder.write("plate.obj", plate(false));
    const Arguments groundless = {"plate.obj", "--ground", "none", "--light", "0,0,-1,0", "--out", "o.png"};
    EXPECT_EQ(run(groundless).err.find("note"), std::string::npos);
}

TEST_F(Gnomonshot, SaysNothingOfCastersThatAreNotToBe) {
    EXPECT_EQ(run({scene, "--casters", "none", "--out", "o.png"}).err, "");
    folder.write("line.obj", "v 0 0 0\nv 1 0 1\nl 1 2\n");
    const std::string said = run({"line.obj", "--ground", "none", "--shadow", "volume", "--out", "o.png"}).err;
    EXPECT_NE(said.find("because the ShadowCasterGroup holds no triangles"), std::string::npos) << said;
}

/// Three lights at most are relit.
TEST_F(Gnomonshot, SaysCuresInTheWordsOfItsOptions) {
    Arguments lights = {scene, "--shadow", "volume", "--out", "o.png"};
    for (const char* light : {"0,0,1,0", "1,0,1,0", "0,1,1,0", "-1,0,1,0"})
        lights = lights + Arguments{"--light", light};
    const std::string said = run(lights).err;
    EXPECT_NE(said.find("Set BLEND (composite=blend), which takes any number of lights."), std::string::npos) << said;
}

/// A light of the file's own, from 45°, on for the file's own box only.
const std::string boxUnderItsLight = R"(#Ascii Scene
#Version 161
#Generator by hand
osg::Group { UniqueID 1
  StateSet TRUE { osg::StateSet { UniqueID 2 ModeList 1 { GL_LIGHT2 ON } } }
  Children 2 {
    osg::LightSource { UniqueID 3 Light TRUE { osg::Light { UniqueID 4 LightNum 2
      Ambient 0 0 0 1 Diffuse 1 1 1 1 Position 1 0 1 0 } } }
    osg::Geode { UniqueID 5 Drawables 1 { osg::ShapeDrawable { UniqueID 6
      Shape TRUE { osg::Box { UniqueID 7 Center 0 0 1 HalfLengths 0.5 0.5 0.5 } } } } } } }
)";

// As above: a sun at 45° of 0.7, and 0.1.
TEST_F(Gnomonshot, SetsThePartsOfTheScenesOwnLights) {
    folder.write("lit.osgt", boxUnderItsLight);
    const auto image =
        shoot(Arguments{"lit.osgt", "--shadow", "planar", "--ambient", "0.1", "--diffuse", "0.7"} + fromAbove);
    EXPECT_EQ(red(*image, 66, 50), 152);
    EXPECT_NEAR(red(*image, 37, 50), 25.5, 0.6) << "the box's shadow goes from x = -0.5 to -1.5";
}

/// OSG's ambient light of 0.1, the light of 1 at 45°, and nothing else.
TEST_F(Gnomonshot, LeavesTheLightOfScenesThatHaveLights) {
    folder.write("lit.osgt", boxUnderItsLight);
    run(Arguments{"lit.osgt", "--out", "o.png"} + fromAbove);
    EXPECT_NEAR(red(*load("o.png"), 66, 50), 255.0 * (0.1 + std::sqrt(0.5)), 0.6);
    EXPECT_NEAR(red(*load("o.png"), 37, 50), 255.0 * 0.1, 0.6);
}

/// An image beside a file is found wherever the program runs.
TEST_F(Gnomonshot, FindsTexturesBesideItsFiles) {
    std::filesystem::create_directory(folder.path() / "sub");
    osg::ref_ptr<osg::Image> black = new osg::Image;
    black->allocateImage(4, 4, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill_n(black->data(), black->getTotalSizeInBytes(), static_cast<unsigned char>(0));
    black->setFileName("black.png");
    ASSERT_TRUE(osgDB::writeImageFile(*black, (folder.path() / "sub/black.png").string()));
    const osg::ref_ptr<osg::Geometry> square = osg::createTexturedQuadGeometry({-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
    square->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(black));
    for (const char* name : {"sub/square.osgb", "sub/square.osgt"}) {
        const osg::ref_ptr<osgDB::Options> byName = new osgDB::Options("WriteImageHint=UseExternal");
        ASSERT_TRUE(osgDB::writeNodeFile(*square, (folder.path() / name).string(), byName));
        EXPECT_EQ(red(*shoot(Arguments{name, "--shadow", "none", "--ground", "none"} + fromAbove), 50, 50), 0) << name;
    }
}

TEST_F(Gnomonshot, LightsItsGroundByTheScenesOwnLights) {
    folder.write("lit.osgt", boxUnderItsLight);
    const Arguments above = {"lit.osgt", "--eye", "0,0,6", "--center", "0,0,0", "--viewup", "0,1,0"};
    const auto plain = shoot(above + Arguments{"--shadow", "none"});
    EXPECT_GT(red(*plain, 110, 60), 150);
    EXPECT_GT(countDifferent(*plain, *shoot(above + Arguments{"--shadow", "planar"})), 50);
}

TEST_F(Gnomonshot, CastsOnlyWhatIsNamed) {
    const osg::ref_ptr<osg::Image> lit = shoot({scene, "--shadow", "none"});
    const long all = countDifferent(*lit, *shoot({scene, "--shadow", "planar"}));
    const long cube = countDifferent(*lit, *shoot({scene, "--shadow", "planar", "--casters", "cube"}));
    EXPECT_GT(cube, 0);
    EXPECT_LT(cube, all);
    EXPECT_EQ(countDifferent(*lit, *shoot({scene, "--shadow", "planar", "--casters", "none"})), 0);
}

TEST_F(Gnomonshot, UsesNearAndFarExactly) {
    const Arguments view = {scene, "--shadow", "none", "--eye", "0,-5,0.25", "--center", "0,0,0.25"};
    const osg::ref_ptr<osg::Image> whole = shoot(view);
    EXPECT_EQ(countDifferent(*whole, *shoot(view + Arguments{"--near", "0.1", "--far", "100"})), 0);
    EXPECT_GT(countDifferent(*whole, *shoot(view + Arguments{"--near", "0.1", "--far", "4.8"})), 200);
}

TEST_F(Gnomonshot, DrawsLampsFarFromTheOriginAsNearIt) {
    folder.write("plate.obj", plate(false));
    const auto from = [&](const std::string& file, const std::string& x, const std::string& lamp) {
        return shoot({file, "-O", "noRotation", "--shadow", "planar", "--ground", "8", "--light", lamp + ",0,3,1",
                      "--eye", x + ",0,10", "--center", x + ",0,0", "--viewup", "0,1,0", "--size", "100x100"});
    };
    EXPECT_EQ(
        countDifferent(*from("plate.obj", "0", "1.25"), *from("plate.obj.6400000,0,0.trans", "6400000", "6400001.25")),
        0);
}

TEST_F(Gnomonshot, LooksStraightDownWithoutAViewUp) {
    const Arguments down = {scene, "--eye", "0,0,10", "--center", "0,0,0"};
    EXPECT_EQ(countDifferent(*shoot(down), *shoot(down + Arguments{"--viewup", "0,1,0"})), 0);
}

TEST_F(Gnomonshot, TakesSeveralFilesAndLights) {
    folder.write("plate.obj", plate(false));
    const osg::ref_ptr<osg::Image> one = shoot({scene, "--shadow", "planar"});
    EXPECT_GT(countDifferent(*one, *shoot({scene, "plate.obj", "--shadow", "planar"})), 500);
    EXPECT_GT(countDifferent(*one, *shoot({scene, "--shadow", "planar", "--light", "1,0,1,0", "--light", "0,1,1,0"})),
              500);
}

// Maps are drawn in the first frame, none while all stands still, and one a light in each frame of a moving light.
TEST_F(Gnomonshot, StatsCountTheMapsThatAreDrawn) {
    run({scene, "--shadow", "planar", "--shadow", "map:size=256", "--size", "80x60", "--frames", "4", "--light",
         "1,0,1,0", "--light", "0,1,1,0", "--stats", "s.json"});
    const nlohmann::json passes = nlohmann::json::parse(readFile(folder.path() / "s.json")).at("shadowPasses");
    ASSERT_EQ(passes.size(), 2u);
    const nlohmann::json maps = {{"first", 2}, {"still", 0}, {"moving", 2 * 4}};
    EXPECT_EQ(passes.at(1), (nlohmann::json{{"technique", "map:size=256"}, {"lights", 2}, {"maps", maps}}));
}

TEST_F(Gnomonshot, WritesStats) {
    run({scene, "--shadow", "planar", "--size", "80x60", "--frames", "3", "--stats", "s.json"});
    const nlohmann::json stats = nlohmann::json::parse(readFile(folder.path() / "s.json"));
    EXPECT_NE(stats.at("renderer").get<std::string>().find("llvmpipe"), std::string::npos);
    EXPECT_EQ(stats.at("technique"), "planar");
    EXPECT_EQ(stats.at("diagnosis"), nlohmann::json::array());
    EXPECT_GT(stats.at("triangles"), 14);
    EXPECT_EQ(stats.at("draws"), 3);
    EXPECT_EQ(stats.at("shadowPasses").at(0), (nlohmann::json{{"technique", "planar"}, {"planes", 1}, {"lights", 1}}));
    EXPECT_GT(stats.at("msFirst"), 0.0);
    EXPECT_GT(stats.at("peakMiB"), 1.0);
    for (const char* times : {"msSteady", "msMoving", "msNone"}) {
        EXPECT_GT(stats.at(times).at("q1"), 0.0) << times;
        EXPECT_LE(stats.at(times).at("q1"), stats.at(times).at("median")) << times;
        EXPECT_LE(stats.at(times).at("median"), stats.at(times).at("q3")) << times;
    }
}

TEST_F(Gnomonshot, RecommendsTheTechniqueThatAutoDraws) {
    const Arguments view = {scene, "--size", "80x60", "--light", "1,0,1,0", "--eye", "-4.8,-6.85,5.08"};
    const auto with = [&view](Arguments more) {
        more.insert(more.begin(), view.begin(), view.end());
        return more;
    };
    run(with({"--shadow", "auto", "--frames", "2", "--stats", "s.json"}));
    const nlohmann::json chosen = nlohmann::json::parse(readFile(folder.path() / "s.json")).at("decisions").at(0);
    EXPECT_EQ(chosen.at("light"), 0);
    EXPECT_TRUE(chosen.at("keepsBudget").get<bool>());
    EXPECT_EQ(chosen.at("decisions"), 2) << "the first frame, and the third, which knows what moves";
    EXPECT_GT(chosen.at("ms").at("still"), 0.0);
    const std::string out = run(with({"--recommend"})).out, spec = chosen.at("spec");
    const std::string reason = ", the most accurate of those that keep 1 px and take hardly more than the cheapest: ";
    EXPECT_EQ(out.rfind("light 0: " + spec + reason, 0), 0u) << out; // few pixels: smooth edges take little longer
    for (const char* part :
         {"volume", "traced:edges=smooth  ", "map:", "hull", "no terrain is named as receiver", "in C++: "})
        EXPECT_NE(out.find(part), std::string::npos) << part << " is not in\n" << out;
    EXPECT_EQ(runGnomonshot(with({"--recommend", "--shadow", "map"}), folder.path()).lastLine(),
              "gnomonshot: --recommend needs --shadow auto and no other. Leave --shadow out, or give its budget.");
}

TEST_F(Gnomonshot, SaysWhyThereIsNoShadow) {
    const Ending ending = run({scene, "--shadow", "planar", "--light", "0,0,-1,0", "--out", "o.png"});
    EXPECT_NE(ending.err.find("gnomonshot: note: "), std::string::npos) << ending.err;
}

/// Mesa draws both with the same rasteriser: no pixel may differ. Another renderer rounds colours and places edges by
/// its own rules, which OpenGL allows: a step or two of 255, and single pixels along the edges.
TEST_F(Gnomonshot, OnEglDrawsThePictureThatItDrawsInMemory) {
    osg::ref_ptr<osg::Image> lit;
    for (const std::string shadow :
         {"none", "planar", "traced", "traced:composite=blend", "planar:composite=blend,dark=0.4"}) {
        osg::ref_ptr<osg::Image> pictures[2];
        std::string renderers[2];
        for (const int egl : {0, 1}) {
            const Ending ending = runProgram(egl ? GNOMONSHOT_EGL : GNOMONSHOT,
                                             {scene, "--size", "320x240", "--out", "o.png", "--frames", "1", "--stats",
                                              "s.json", "--shadow", shadow},
                                             folder.path());
            ASSERT_EQ(ending.status, 0) << ending.err;
            pictures[egl] = load("o.png");
            renderers[egl] = nlohmann::json::parse(readFile(folder.path() / "s.json")).at("renderer");
        }
        const bool same = renderers[0] == renderers[1];
        EXPECT_LE(countDifferent(*pictures[0], *pictures[1], same ? 0.0f : 2.0f), same ? 0 : 320 * 240 / 100) << shadow;
        if (!lit) lit = pictures[1];
        EXPECT_EQ(countDifferent(*lit, *pictures[1], 2.0f) > 100, shadow != "none") << shadow;
    }
}

} // namespace
