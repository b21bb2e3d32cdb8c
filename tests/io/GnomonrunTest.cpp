// SPDX-License-Identifier: MIT
// gnomonrun on programs that know nothing of Gnomon, on an X server, by their pictures.
#include "Desktop.h"
#include "Program.h"
#include "Rays.h"

#include <gtest/gtest.h>

#include <osgDB/ReadFile>

#include <cmath>

namespace {

using namespace gnomon::testing;

// The scene of plain_program/scene.cpp, by rays.

constexpr int width = 320, height = 240;
constexpr double unitsAPixel = 0.025;
const osg::Vec3d towardsSun(2, -1, 2);

bool isShadowed(double column, double row) {
    const osg::Vec3d seen((column - width / 2.0) * unitsAPixel, (row - height / 2.0) * unitsAPixel, 0.0);
    const bool onTop = std::abs(seen.x()) < 0.5 && std::abs(seen.y()) < 0.5;
    return !onTop && std::isfinite(meetBox(seen, towardsSun, {-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}));
}

/// A pixel's centre and its neighbours' give one answer. The pixel that an edge crosses may have either.
bool isClear(int x, int y) {
    const bool here = isShadowed(x + 0.5, y + 0.5);
    for (const int d : {-1, 1})
        if (isShadowed(x + 0.5 + d, y + 0.5) != here || isShadowed(x + 0.5, y + 0.5 + d) != here) return false;
    return true;
}

class Gnomonrun : public testing::Test {
protected:
    /// Runs gnomonrun in the test's folder, on its own X server.
    Ending run(const std::string& arguments) {
        return runProgram("/bin/sh",
                          {"-c", "DISPLAY=" + desktop.name() + " OSG_WINDOW='0 0 320 240' " GNOMONRUN " " + arguments},
                          folder.path());
    }
    osg::ref_ptr<osg::Image> picture(const std::string& name) { return osgDB::readRefImageFile(folder.path() / name); }

    TemporaryFolder folder;
    Desktop desktop{folder.path()};
};

TEST_F(Gnomonrun, AProgramOfAnotherBuildSystemHasTheShadowThatRaysHave) {
    const Ending built =
        runProgram("/usr/bin/make", {"-f", PLAIN_PROGRAM "/Makefile", "SOURCE=" PLAIN_PROGRAM, "scene"}, folder.path());
    ASSERT_EQ(built.status, 0) << built.err;
    const Ending plain = run("--shadow none --frames 5 --out none.png -- ./scene");
    ASSERT_EQ(plain.status, 0) << plain.err;
    for (const std::string technique : {"traced", "map", "map:composite=blend"}) {
        const Ending ending = run("--shadow " + technique + " --frames 5 --out shadow.png -- ./scene");
        ASSERT_EQ(ending.status, 0) << ending.err;
        const osg::ref_ptr<osg::Image> without = picture("none.png"), with = picture("shadow.png");
        ASSERT_TRUE(without && with);
        ASSERT_EQ(with->s(), width);
        ASSERT_EQ(with->t(), height);
        int wrong = 0, dark = 0;
        for (int y = 1; y < height - 1; ++y)
            for (int x = 1; x < width - 1; ++x) {
                const bool differs =
                    with->getColor(unsigned(x), unsigned(y)) != without->getColor(unsigned(x), unsigned(y));
                dark += differs;
                wrong += isClear(x, y) && differs != isShadowed(x + 0.5, y + 0.5);
            }
        EXPECT_EQ(wrong, 0) << technique;
        EXPECT_GT(dark, 1000) << technique;
    }
}

TEST_F(Gnomonrun, OsgviewerHasTheShadowsOfEveryTechniqueOrTheirCauses) {
    const Ending ending = run("--diagnose --frames 8 --light 1,1,2,0 -- osgviewer " GNOMON_DATA "/lab8.osgt");
    EXPECT_EQ(ending.status, 0) << ending.err;
    for (const std::string technique : {"none: ", "planar: ", "box: ", "hull: ", "drape: ", "map: ", "volume: ", "traced: "})
        EXPECT_NE(ending.err.find("gnomonrun: " + technique), std::string::npos) << technique << ending.err;
    EXPECT_NE(ending.err.find(" of it for shadows"), std::string::npos) << ending.err;
}

TEST_F(Gnomonrun, WhatCannotBeReachedIsSaid) {
    const Ending none = run("-- /bin/true");
    EXPECT_EQ(none.status, 1);
    EXPECT_NE(none.lastLine().find("gave no scene to osgViewer::View::setSceneData()"), std::string::npos) << none.err;
    const Ending missing = run("-- ./nothing");
    EXPECT_EQ(missing.status, 127);
    EXPECT_EQ(missing.lastLine(), "gnomonrun: ./nothing cannot be started: No such file or directory.");
    const Ending unnamed = run("--shadow map");
    EXPECT_EQ(unnamed.status, 1);
    EXPECT_NE(unnamed.lastLine().find("no program is given"), std::string::npos) << unnamed.err;
}

TEST_F(Gnomonrun, TheProgramsOwnStatusIsItsStatus) { EXPECT_EQ(run("-- /bin/sh -c 'exit 7'").status, 7); }

} // namespace
