// SPDX-License-Identifier: MIT
#include "Program.h"

#include <gtest/gtest.h>

#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

namespace {

using namespace gnomon::testing;
using Arguments = std::vector<std::string>;

const std::string scene = GNOMON_DATA "/lab8.osgt";

/// gnomonshot in a folder of its own. Whatever it refuses, it says one sentence last and leaves no file.
class BadInput : public ::testing::Test {
protected:
    /// The sentence, without "gnomonshot: ".
    std::string refusal(const Arguments& arguments) {
        const std::vector<std::string> before = folder.list();
        const Ending ending = runGnomonshot(arguments, folder.path());
        EXPECT_EQ(ending.status, 1) << ending.err;
        EXPECT_EQ(folder.list(), before) << "nothing is left behind";
        const std::string line = ending.lastLine(), prefix = "gnomonshot: ";
        EXPECT_EQ(line.substr(0, prefix.size()), prefix) << ending.err;
        EXPECT_EQ(line.back(), '.') << line;
        return line.substr(std::min(line.size(), prefix.size()));
    }

    std::string refusalOf(const std::string& file) { return refusal({file, "--shadow", "planar", "--out", "o.png"}); }

    std::string refusalWith(Arguments more) {
        more.insert(more.begin(), {scene, "--out", "o.png"});
        return refusal(more);
    }

    TemporaryFolder folder;
};

std::string damaged(const std::string& file) {
    return "\"" + file +
           "\" cannot be read as a scene: it is damaged, or it does not match its name. Allowed: obj, osgt, ive, stl, "
           "3ds, ….";
}

std::string empty(const std::string& file) {
    return "\"" + file + "\" holds nothing to draw. It is empty or damaged, or it does not match its name.";
}

/// A sphere in OSG's own format of this ending.
std::string sphereFile(const TemporaryFolder& folder, const std::string& name) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(new osg::Sphere));
    osgDB::writeNodeFile(*geode, (folder.path() / name).string());
    return readFile(folder.path() / name);
}

TEST_F(BadInput, MissingFile) {
    EXPECT_EQ(refusalOf("gone.osgt"), "there is no file \"gone.osgt\", or no reader for its type.");
    EXPECT_EQ(refusalOf("gone"), "there is no file \"gone\", or no reader for its type.");
}

TEST_F(BadInput, Directory) {
    std::filesystem::create_directory(folder.path() / "dir.osgt");
    EXPECT_EQ(refusalOf("dir.osgt"), "\"dir.osgt\" is a directory. Give a scene file.");
    EXPECT_EQ(refusalOf("."), "\".\" is a directory. Give a scene file.");
}

TEST_F(BadInput, EmptyFile) {
    for (const char* name : {"a.osgt", "a.osgb", "a.ive", "a.obj", "a.stl", "a.3ds", "a.ply"}) {
        folder.write(name, "");
        const std::string said = refusalOf(name);
        EXPECT_TRUE(said == damaged(name) || said == empty(name)) << said;
    }
}

TEST_F(BadInput, TruncatedFile) {
    for (const char* name : {"whole.osgt", "whole.osgb", "whole.ive", "whole.stl", "whole.3ds"}) {
        const std::string bytes = sphereFile(folder, name);
        ASSERT_GT(bytes.size(), 100u) << name;
        for (const std::size_t part : {2, 10}) {
            const std::string cut = "cut" + std::to_string(part) + std::filesystem::path(name).extension().string();
            folder.write(cut, bytes.substr(0, bytes.size() / part));
            const Ending ending = runGnomonshot({cut, "--out", "o.png"}, folder.path());
            const bool drawn = std::filesystem::remove(folder.path() / "o.png");
            EXPECT_EQ(ending.status, drawn ? 0 : 1) << cut << " " << ending.err;
            if (!drawn) refusalOf(cut);
        }
    }
}

/// The cut at 7 parts of 40 crashes OSG 3.6.5's reader.
TEST_F(BadInput, ReaderThatCrashes) {
    osgDB::writeNodeFile(*osgDB::readRefNodeFile(scene), (folder.path() / "whole.osgb").string());
    const std::string bytes = readFile(folder.path() / "whole.osgb");
    for (std::size_t part = 1; part < 40; part += 6) {
        folder.write("cut.osgb", bytes.substr(0, bytes.size() * part / 40));
        const Ending ending = runGnomonshot({"cut.osgb", "--out", "o.png"}, folder.path());
        if (ending.status == 0) continue;
        EXPECT_EQ(ending.status, 1) << part;
        EXPECT_EQ(ending.lastLine().rfind("gnomonshot: \"cut.osgb\" ", 0), 0u) << ending.err;
        EXPECT_EQ(folder.list(), (std::vector<std::string>{"cut.osgb", "whole.osgb"})) << part;
    }
}

TEST_F(BadInput, AnotherType) {
    folder.write("noise.png", "\x89PNG\r\n\x1a\n then nothing");
    folder.write("readme.txt", "Hello.\n");
    folder.write("letter.osgt", "Dear OpenSceneGraph,\n");
    folder.write("letter.obj", "Dear OpenSceneGraph,\n");
    for (const char* name : {"noise.png", "letter.obj", "letter.osgt"}) EXPECT_EQ(refusalOf(name), damaged(name));
    refusalOf("readme.txt");
}

TEST_F(BadInput, EmptyNode) {
    folder.write("empty.osgt", "#Ascii Scene\n#Version 161\n#Generator by hand\n\nosg::Group {\n  UniqueID 1\n}\n");
    EXPECT_EQ(refusalOf("empty.osgt"), empty("empty.osgt"));
}

TEST_F(BadInput, VerticesThatAreNotFinite) {
    folder.write("nan.obj", "v nan nan nan\nv nan 0 0\nv 0 nan 0\nf 1 2 3\n");
    EXPECT_EQ(refusalOf("nan.obj"), empty("nan.obj"));
}

TEST_F(BadInput, UnknownTechniqueOrKey) {
    EXPECT_EQ(refusalWith({"--shadow", "plane"}),
              "--shadow plane cannot be used. \"plane\" is not a shadow technique. Allowed: none, planar, box, hull, "
              "map, volume, traced, auto.");
    EXPECT_EQ(refusalWith({"--shadow", "planar:soft=1"}), "--shadow planar:soft=1 cannot be used. the technique planar "
                                                          "has no key \"soft\". Allowed: composite, dark, receiver.");
}

TEST_F(BadInput, MixedComposites) {
    EXPECT_EQ(refusalWith({"--shadow", "planar", "--shadow", "planar:composite=blend"}),
              "composite=relight and composite=blend cannot be mixed. Give every shadow the same.");
}

TEST_F(BadInput, NodesThatAreNotThere) {
    EXPECT_EQ(refusalWith({"--shadow", "planar", "--receiver", "roof"}),
              "no node is named \"roof\" to receive the shadow. Names in the scene: lab8, ground, sphere, cube.");
    EXPECT_EQ(refusalWith({"--casters", "roof"}),
              "--casters: no node is named \"roof\". Allowed: all, none, or a node's name.");
}

TEST_F(BadInput, Size) {
    for (const char* size : {"0x600", "800x0", "0", "1000000x1000000", "1000000x1", "-8x6", "8x", "x6", "8.5x6",
                             "8x6x4", "nanxnan", "800", "99999999999999999999x1"})
        EXPECT_EQ(refusalWith({"--size", size}), "--size " + std::string(size) +
                                                     " cannot be used. Allowed: WIDTHxHEIGHT from 1x1 to "
                                                     "16384x16384 pixels.");
}

TEST_F(BadInput, LightThatIsNotFinite) {
    for (const char* light : {"nan,0,1,0", "0,0,inf,0", "0,0,1", "0,0,1,0,0", "a,b,c,d", "0,0,1e300,1", "1,,1,0"})
        EXPECT_EQ(refusalWith({"--light", light}),
                  "--light " + std::string(light) +
                      " cannot be used. Allowed: 4 numbers from -1e+12 to 1e+12, separated by commas.");
    EXPECT_EQ(refusalWith({"--light", "0,0,0,0"}), "--light 0,0,0,0 cannot be used. Allowed: a direction other than "
                                                   "0,0,0 with w = 0, or a position with w = 1.");
}

TEST_F(BadInput, SunOfNoMomentOrPlaceOrNight) {
    for (const char* sun : {"noon", "2026-06-21T15:00:00Z", "2026-02-30T15:00:00Z,40,0", "2026-06-21T15:00:00,40,0"})
        EXPECT_EQ(
            refusalWith({"--sun", sun}),
            "--sun " + std::string(sun) +
                " cannot be used. Allowed: a moment in UTC as 2026-06-21T15:00:00Z, a latitude from -90 to 90 and a "
                "longitude from -180 to 180 degrees, separated by commas.");
    EXPECT_EQ(refusalWith({"--sun", "2026-06-21T15:00:00Z,91,0"}),
              "--sun 2026-06-21T15:00:00Z,91,0 cannot be used. The latitude must be from -90 to 90 degrees.");
    EXPECT_EQ(refusalWith({"--sun", "2026-06-21T00:00:00Z,0,0"})
                  .find("--sun 2026-06-21T00:00:00Z,0,0 cannot be used. The sun "
                        "is 66.6 degrees below the horizon"),
              0u); // 90 degrees less the declination of 23.44
}

TEST_F(BadInput, NineLights) {
    Arguments lights;
    for (int i = 0; i < 9; ++i) lights.insert(lights.end(), {"--light", "0,0,1,0"});
    EXPECT_EQ(refusalWith(lights), "--light is given more than 8 times. Allowed: 1 to 8 lights.");
}

TEST_F(BadInput, CameraThatIsNotFinite) {
    for (const char* option : {"--eye", "--center", "--viewup"})
        EXPECT_EQ(refusalWith({option, "0,nan,1"}),
                  std::string(option) +
                      " 0,nan,1 cannot be used. Allowed: 3 numbers from -1e+12 to 1e+12, separated by commas.");
}

TEST_F(BadInput, CameraThatLooksNowhere) {
    EXPECT_EQ(refusalWith({"--eye", "1,2,3", "--center", "1,2,3"}),
              "--eye and --center are the same point. Give two different points.");
    EXPECT_EQ(refusalWith({"--viewup", "0,0,0"}), "--viewup 0,0,0 is not a direction. Give any other vector.");
    EXPECT_EQ(refusalWith({"--eye", "0,0,5", "--center", "0,0,0", "--viewup", "0,0,1"}),
              "--viewup is parallel to the view. Give a vector at an angle to it.");
}

TEST_F(BadInput, AnglesAndPlanesOutOfRange) {
    for (const char* angle : {"0", "180", "-40", "nan", "wide"})
        EXPECT_EQ(refusalWith({"--fovy", angle}),
                  "--fovy " + std::string(angle) + " cannot be used. Allowed: a number from 1 to 170.");
    EXPECT_EQ(refusalWith({"--near", "5", "--far", "5"}), "--near must be less than --far.");
    EXPECT_EQ(refusalWith({"--near", "5"}), "--near and --far need each other. Give both or neither.");
    EXPECT_EQ(refusalWith({"--near", "0", "--far", "5"}),
              "--near 0 cannot be used. Allowed: a number from 1e-09 to 1e+12.");
}

TEST_F(BadInput, LevelsOutOfRange) {
    EXPECT_EQ(refusalWith({"--ambient", "nan"}), "--ambient nan cannot be used. Allowed: a number from 0 to 10.");
    EXPECT_EQ(refusalWith({"--diffuse", "-1"}), "--diffuse -1 cannot be used. Allowed: a number from 0 to 10.");
    EXPECT_EQ(refusalWith({"--background", "0,0,2"}),
              "--background 0,0,2 cannot be used. Allowed: 3 numbers from 0 to 1, separated by commas.");
    EXPECT_EQ(refusalWith({"--frames", "0"}), "--frames 0 cannot be used. Allowed: a whole number from 1 to 100000.");
    EXPECT_EQ(refusalWith({"--frames", "2.5"}),
              "--frames 2.5 cannot be used. Allowed: a whole number from 1 to 100000.");
    EXPECT_EQ(refusalWith({"--up", "x"}), "--up x cannot be used. Allowed: y, z.");
    EXPECT_EQ(refusalWith({"--ground", "big"}),
              "--ground big cannot be used. Allowed: auto, none, or a side from 1e-09 to 1e+12.");
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
    std::filesystem::create_directory(folder.path() / "dir.png");
    EXPECT_EQ(refusal({scene, "--out", "gone/o.png"}),
              "\"gone/o.png\" cannot be written: there is no directory \"gone\".");
    EXPECT_EQ(refusal({scene, "--out", "dir.png"}),
              "\"dir.png\" cannot be written: it is a directory. Give a file's name.");
    EXPECT_EQ(refusal({scene, "--out", "/dev/null"}),
              "\"/dev/null\" cannot be written: it is not a regular file. Give another name.");
    EXPECT_EQ(refusal({scene, "--out", "/proc/o.png"}),
              "\"/proc/o.png\" cannot be written: its directory is not writable. Give another one.");
    EXPECT_EQ(refusal({scene, "--out", "o.obj"}),
              "\"o.obj\" cannot be written: OpenSceneGraph writes no such images. Allowed: png, jpg, bmp, tif, rgb.");
    EXPECT_EQ(refusal({scene, "--stats", "gone/s.json"}),
              "\"gone/s.json\" cannot be written: there is no directory \"gone\".");
}

TEST_F(BadInput, AFileThatIsThereStaysAsItIs) {
    folder.write("o.png", "precious");
    refusalWith({"--shadow", "planar", "--receiver", "roof"});
    EXPECT_EQ(readFile(folder.path() / "o.png"), "precious");
}

TEST_F(BadInput, OptionsThatAreWrong) {
    EXPECT_EQ(refusalWith({"--moon", "full"}), "there is no option --moon. See --help for all options.");
    EXPECT_EQ(refusalWith({"--size"}), "--size needs a value: WxH.");
    EXPECT_EQ(refusal({scene, "--out", "--size", "8x8"}), "--out needs a value: IMAGE.");
    EXPECT_EQ(refusalWith({"--size", "8x8", "--size", "9x9"}), "--size is given twice. Give it once.");
    EXPECT_EQ(refusalWith({"-O"}), "-O needs a value.");
}

TEST_F(BadInput, TruthsThatCannotBeHad) {
    EXPECT_EQ(refusal({scene, "--truth", "t.png"}),
              "\"t.png\" cannot be written: this format cannot hold the data. Allowed: .osgb, .osgt, .osgx.");
    EXPECT_EQ(refusal({scene, "--truth", "t.osgb", "--casters", "cube"}),
              "--truth and --casters exclude each other. Give one of them: the truth is that of all casters.");
    EXPECT_EQ(refusal({scene, "--truth", "t.osgb", "--light", "1,0,1,0", "--light", "0,1,1,0"}),
              "--truth needs exactly one light, but the scene has 2.");
}

TEST_F(BadInput, NothingToDo) {
    EXPECT_EQ(refusal({}), "no scene file is given. See --help.");
    EXPECT_EQ(refusal({"--out", "o.png"}), "no scene file is given. See --help.");
    EXPECT_EQ(refusal({scene}),
              "no output is asked for. Give --out IMAGE, --stats FILE.json, --truth FILE.osgb or --recommend.");
}

} // namespace
