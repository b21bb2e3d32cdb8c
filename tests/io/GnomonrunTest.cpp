// SPDX-License-Identifier: MIT
// gnomonrun on programs that know nothing of Gnomon, on an X server, by their pictures.
#include "Desktop.h"
#include "Program.h"
#include "Rays.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <osgDB/ReadFile>

#include <cmath>
#include <fstream>
#include <set>
#include <thread>

namespace {

using namespace gnomon::testing;

// The scene of plain_program/scene.cpp, by rays.

constexpr int width = 320, height = 240;
constexpr double unitsAPixel = 0.025;
const osg::Vec3d towardsSun(2, -1, 2);

/// @param x  where the box is.
bool isShadowed(double column, double row, double x = 0.0) {
    const osg::Vec3d seen((column - width / 2.0) * unitsAPixel - x, (row - height / 2.0) * unitsAPixel, 0.0);
    const bool onTop = std::abs(seen.x()) < 0.5 && std::abs(seen.y()) < 0.5;
    return !onTop && std::isfinite(meetBox(seen, towardsSun, {-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}));
}

/// A pixel's centre and its neighbours' give one answer. The pixel that an edge crosses may have either.
bool isClear(int x, int y, double box) {
    const bool here = isShadowed(x + 0.5, y + 0.5, box);
    for (const int d : {-1, 1})
        if (isShadowed(x + 0.5 + d, y + 0.5, box) != here || isShadowed(x + 0.5, y + 0.5 + d, box) != here)
            return false;
    return true;
}

/// A window that shows something yet.
bool hasSeveralColors(const Screenshot& picture) {
    return std::set<std::uint32_t>(picture.pixels.begin(), picture.pixels.end()).size() > 1;
}

/// Pixels with and without shadow that are not as rays have it, and those in shadow.
struct Judged {
    int wrong = 0, dark = 0;
};
Judged judged(const osg::Image& without, const osg::Image& with, double box = 0.0) {
    Judged result;
    for (int y = 1; y < height - 1; ++y)
        for (int x = 1; x < width - 1; ++x) {
            const bool differs = with.getColor(unsigned(x), unsigned(y)) != without.getColor(unsigned(x), unsigned(y));
            result.dark += differs;
            result.wrong += isClear(x, y, box) && differs != isShadowed(x + 0.5, y + 0.5, box);
        }
    return result;
}

class Gnomonrun : public testing::Test {
protected:
    /// Builds the plain programs once for all tests, as its makers would.
    static void SetUpTestSuite() {
        made = std::make_unique<TemporaryFolder>();
        // The sources' own path may hold a blank, which make takes for two names.
        std::filesystem::copy(PLAIN_PROGRAM, made->path());
        const Ending built = runProgram("/usr/bin/make", {"all"}, made->path(), 300);
        ASSERT_EQ(built.status, 0) << built.err;
    }
    /// A program of another build system.
    static std::string built(const std::string& name) { return made->path() / name; }
    static void TearDownTestSuite() { made.reset(); }

    /// Runs gnomonrun in the test's folder, on its own X server.
    Ending run(const std::string& arguments) { return runAlone("'" GNOMONRUN "' " + arguments); }
    /// The same without gnomonrun.
    Ending runAlone(const std::string& command) {
        return runProgram("/bin/sh", {"-c", "DISPLAY=" + desktop.name() + " OSG_WINDOW='0 0 320 240' " + command},
                          folder.path());
    }
    osg::ref_ptr<osg::Image> picture(const std::string& name) { return osgDB::readRefImageFile(folder.path() / name); }

    /// The plain program's picture with shadows beside that without. @param says  each run. @param box  where it is in x.
    void expectShadowOfRays(const std::vector<std::string>& techniques, const std::string& option,
                            const std::string& says = "", double box = 0.0) {
        const auto frame = [&](const std::string& technique) {
            const Ending ending =
                run("--shadow " + technique + " --frames 5 --out o.png -- " + built("scene") + " " + option);
            EXPECT_EQ(ending.status, 0) << ending.err;
            EXPECT_NE(ending.out.find(says), std::string::npos) << ending.out;
            return picture("o.png");
        };
        const osg::ref_ptr<osg::Image> without = frame("none");
        for (const std::string& technique : techniques) {
            const osg::ref_ptr<osg::Image> with = frame(technique);
            ASSERT_TRUE(without && with);
            ASSERT_TRUE(with->s() == width && with->t() == height);
            EXPECT_EQ(judged(*without, *with, box).wrong, 0) << technique;
            EXPECT_GT(judged(*without, *with, box).dark, 1000) << technique;
        }
    }

    inline static std::unique_ptr<TemporaryFolder> made;
    TemporaryFolder folder;
    Desktop desktop{folder.path()};
};

TEST_F(Gnomonrun, AProgramOfAnotherBuildSystemHasTheShadowThatRaysHave) {
    expectShadowOfRays({"traced", "map", "map:composite=blend"}, "");
}

TEST_F(Gnomonrun, OsgviewerHasTheShadowsOfEveryTechniqueOrTheirCauses) {
    const Ending ending = run("--diagnose --frames 8 --light 1,1,2,0 -- osgviewer " GNOMON_DATA "/lab8.osgt");
    EXPECT_EQ(ending.status, 0) << ending.err;
    for (const std::string technique :
         {"none: ", "planar: ", "box: ", "hull: ", "map: ", "volume: ", "traced: ", "auto: "})
        EXPECT_NE(ending.err.find("gnomonrun: " + technique), std::string::npos) << technique << ending.err;
    EXPECT_NE(ending.err.find(" of it for shadows"), std::string::npos) << ending.err;
}

/// docs/files-and-viewers.md
TEST_F(Gnomonrun, TheGuidesFirstExampleShowsShadowsByAuto) {
    const auto shot = [&](const std::string& more) {
        const Ending ending =
            run(more + "--light 1,1,2,0 --frames 5 --out o.png -- osgviewer " GNOMON_DATA "/lab8.osgt.30,0,0.rot");
        EXPECT_EQ(ending.status, 0) << ending.err;
        EXPECT_EQ(ending.err.find("gnomonrun: auto: ") != std::string::npos, more.empty()) << ending.err;
        return picture("o.png");
    };
    const osg::ref_ptr<osg::Image> with = shot(""), without = shot("--shadow none ");
    ASSERT_TRUE(with && without);
    EXPECT_GT(judged(*without, *with).dark, 300);
}

TEST_F(Gnomonrun, OneFrameIsComparedInEveryWay) {
    const Ending ending = run("--frames 5 --compare compared -- " + built("scene"));
    ASSERT_EQ(ending.status, 0) << ending.err;
    const osg::ref_ptr<osg::Image> without = picture("compared/none.png");
    ASSERT_TRUE(without);
    std::ifstream file(folder.path() / "compared/compare.json");
    const auto table = nlohmann::json::parse(file);
    const std::set<std::string> exact = {"traced", "traced:composite=blend", "map"};
    std::set<std::string> names;
    for (const nlohmann::json& drawn : table["drawn"]) {
        const std::string name = drawn["name"];
        SCOPED_TRACE(name);
        names.insert(name);
        const osg::ref_ptr<osg::Image> with = picture("compared/" + drawn["file"].get<std::string>());
        ASSERT_TRUE(with);
        const Judged pixels = judged(*without, *with);
        EXPECT_EQ(drawn["glErrors"], 0);
        EXPECT_NEAR(drawn["darker"], pixels.dark, 2 * (width + height)); // that of the picture's margin
        if (exact.count(name)) EXPECT_EQ(pixels.wrong, 0);
        if (exact.count(name)) EXPECT_GT(pixels.dark, 1000);
        if (name == "hull") EXPECT_NE(drawn["causes"].dump().find("no node is named"), std::string::npos);
    }
    for (const std::string name : {"none", "again", "map:composite=blend", "hull", "osgShadow::ShadowMap"})
        EXPECT_TRUE(names.count(name)) << name;
    EXPECT_EQ(table["disagree"]["map"]["traced"], 0);
    EXPECT_GT(table["disagree"]["none"]["traced"], 1000);
}

TEST_F(Gnomonrun, AWindowOfFourSamplesWithoutStencilHasTheSameShadow) {
    if (runAlone(built("scene") + " samples").status == 1)
        GTEST_SKIP() << "The X server has no window of four samples, as with Mesa 25's llvmpipe.";
    expectShadowOfRays({"traced", "map", "volume"}, "multisampled", "4 samples, 0 stencil bits");
}

TEST_F(Gnomonrun, WithFramesTheProgramsTimeIsThatOfSixtyFramesASecond) {
    expectShadowOfRays({"traced"}, "moving", "", 15.0 * 4 / 60); // the fifth frame's
}

TEST_F(Gnomonrun, KeysSwitchTechniquesAndAtTheEndEachCostIsTold) {
    const std::string command =
        "OSG_WINDOW='0 0 320 240' exec '" GNOMONRUN "' --shadow auto -- " + built("scene") + " 2>said";
    ChildProcess program({"sh", "-c", command}, folder.path(), {"DISPLAY=" + desktop.name()});
    desktop.useWindow("");
    desktop.pictureWhere("a picture of several colours", hasSeveralColors);
    std::this_thread::sleep_for(std::chrono::seconds(1)); // the window hears keys by now
    const Screenshot shadowed = desktop.pictureWhere("a picture", hasSeveralColors);
    const auto isShadowed = [&](const Screenshot& now) { return now == shadowed; };
    desktop.press("n"); // after auto comes none
    desktop.pictureWhere("a picture without shadow", std::not_fn(isShadowed));
    std::this_thread::sleep_for(std::chrono::seconds(1)); // a technique's first three frames do not count
    desktop.press("Escape");
    EXPECT_EQ(program.ended(std::chrono::seconds(10)), 0);
    const std::string said = readFile(folder.path() / "said");
    for (const std::string technique : {"none", "auto"})
        EXPECT_NE(said.find("gnomonrun: " + technique + ": "), std::string::npos) << technique << said;
}

TEST_F(Gnomonrun, WhatCannotBeReachedIsSaid) {
    const Ending none = run("-- /bin/true");
    EXPECT_EQ(none.status, 1);
    EXPECT_EQ(none.lastLine(),
              "gnomonrun: /bin/true cannot be reached: it needs no library of OpenSceneGraph, or has it "
              "linked in statically.");
    const Ending convert = run("-- osgconv " GNOMON_DATA "/lab8.osgt copy.osgt"); // no viewer
    EXPECT_NE(convert.lastLine().find("gave no scene to osgViewer::View::setSceneData()"), std::string::npos)
        << convert.err;
    const Ending view = run("-- " + built("scene_view"));
    EXPECT_EQ(view.status, 1);
    EXPECT_NE(view.lastLine().find("it draws by osgUtil::SceneView, without a viewer."), std::string::npos) << view.err;
    const Ending missing = run("-- ./nothing");
    EXPECT_EQ(missing.status, 127);
    EXPECT_EQ(missing.lastLine(), "gnomonrun: ./nothing cannot be started: No such file or directory.");
    const Ending empty = run("--frames 5 -- " + built("scene") + " empty");
    EXPECT_EQ(empty.status, 1);
    EXPECT_NE(empty.lastLine().find("gave no scene to osgViewer::View::setSceneData()"), std::string::npos)
        << empty.err;
    const Ending killed = run("-- /bin/sh -c 'kill -SEGV $$'");
    EXPECT_EQ(killed.status, 128 + 11);
    EXPECT_EQ(killed.lastLine(), "gnomonrun: /bin/sh was ended by signal 11.");
    const Ending unnamed = run("--shadow map");
    EXPECT_EQ(unnamed.status, 1);
    EXPECT_NE(unnamed.lastLine().find("no program is given"), std::string::npos) << unnamed.err;
}

TEST_F(Gnomonrun, ItsFolderMayHoldABlankButNoColon) {
    const auto runCopyIn = [&](const std::string& name) {
        const std::filesystem::path copy = folder.path() / name, bin = copy / "bin", lib = copy / "lib";
        std::filesystem::create_directories(bin);
        std::filesystem::create_directories(lib);
        std::filesystem::copy(GNOMONRUN, bin);
        std::filesystem::copy(GNOMON_LIBRARIES "/gnomonrun_preload.so", lib);
        return runAlone("'" + (bin / "gnomonrun").string() + "' --frames 3 -- " + built("scene"));
    };
    const Ending ran = runCopyIn("a copy");
    EXPECT_EQ(ran.status, 0) << ran.err; // 1 where the scene was not reached
    const Ending refused = runCopyIn("a:copy");
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(refused.lastLine(), "gnomonrun: '" + (folder.path() / "a:copy/lib/gnomonrun_preload.so").string() +
                                      "' cannot be loaded into a program, because its path holds a colon or a "
                                      "semicolon. Put Gnomon's programs into a folder without.");
}

TEST_F(Gnomonrun, TheProgramsOwnStatusIsItsStatus) { EXPECT_EQ(run("-- /bin/sh -c 'exit 7'").status, 7); }

} // namespace
