// SPDX-License-Identifier: MIT
// Programs say in one sentence what they cannot do, and what they can do with --help.
#include "Program.h"

#include <gtest/gtest.h>

#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cctype>
#include <set>
#include <sstream>
#include <sys/stat.h>

namespace {

using namespace gnomon::testing;
using Arguments = std::vector<std::string>;

const std::string scene = GNOMON_DATA "/lab8.osgt", shadScene = GNOMON_DATA "/shad.osgt";

/// Part of what a program says. Options and their values are read by one reader: what it refuses in general stands below, by
/// gnomonshot.
struct Refused {
    const char* program;
    Arguments arguments;
    const char* says;
    bool alone = true; ///< a library says nothing before.
};

const Refused refused[] = {
    {CS4470_FAKESHADOW, {"--keys", "w", "--offscreen"}, "there is no key w"},
    {CS4470_FAKESHADOW, {"--size", "0x4", "--offscreen"}, "--size 0x4 cannot be used"},
    {GUS_SHADOW, {"--points", "0,0,0,1,1,1,2,2,2", "--offscreen"}, "--points lie on one line"},
    {GUS_SHADOW, {"--points", "1,2,3,1,2,3,4,5,6", "--offscreen"}, "--points lie on one line"},
    {GUS_SHADOW, {"--points", "1,2,3", "--offscreen"}, "Allowed: 9 numbers"},
    {GUS_SHADOW, {"--points", "nan,0,0,1,0,0,0,1,0", "--offscreen"}, "Allowed: 9 numbers"},
    {GUS_SHADOW, {"--light", "1,2,3", "--offscreen"}, "Allowed: 4 numbers"},
    {GUS_SHADOW, {"--light=1,1,1,2", "--offscreen"}, "or a position with w = 1"},
    {HALOMAGIC, {"--keys", "W", "--offscreen"}, "there is no key W"},
    {LAB8, {"--eye", "1,2", "--offscreen"}, "--eye 1,2 cannot be used. Allowed: 3 numbers"},
    {LAB8, {"--eye", "0,0,0", "--at", "0,0,0", "--offscreen"}, "--eye"},
    {LAB8, {"--keys", "?", "--offscreen"}, "there is no key ?"},
    {LAB8, {"--frames", "0", "--offscreen"}, "Allowed: a whole number"},
    {LAB8, {"thing"}, "\"thing\" is not an option"},
    {LAB8, {"--thing"}, "there is no option --thing"},
    {LAB8, {"--out", "o.nothing"}, "o.nothing"},
    {SHAD, {}, "no scene file is given. Usage: shad [OPTION...] FILE..."},
    {SHAD, {"nowhere.osgt", "--offscreen"}, "nowhere.osgt"},
    {SHAD, {"/dev/null", "--offscreen"}, "\"/dev/null\" is a device or a pipe. Give a scene file."},
    {SHAD, {"empty.osgt", "--out=o.png"}, "\"empty.osgt\" cannot be read as a scene"},
    {SHAD, {".", "--offscreen"}, "\".\" is a directory"},
    {SHAD, {shadScene, "-e", "nothing", "--offscreen"}, "-e nothing cannot be used.", false},
    {SHAD, {shadScene, "-l", "nothing", "--offscreen"}, "-l nothing cannot be used.", false},
    {SHAD, {shadScene, "--lights", "5", "--offscreen"}, "--lights 5 cannot be used"},
    {SHAD, {shadScene, "--keys", "W", "--offscreen"}, "there is no key W"},
    {ARL_TERRAIN, {"--shadow", "planar", "--out", "o.png"}, "Allowed: none, box, hull."},
    {ARL_TERRAIN, {"--shadow", "drape", "--out", "o.png"}, "Use hull on terrain"},
    {ARL_TERRAIN, {"--hour", "3", "--out", "o.png"}, "Allowed: a number from 6.5 to 17.5."},
    {ARL_TERRAIN, {"--hour", "noon", "--out", "o.png"}, "Allowed: a number from 6.5 to 17.5."},
    {ARL_TERRAIN, {"--size", "0x10", "--out", "o.png"}, "--size 0x10 cannot be used"},
    {ARL_TERRAIN, {"--nothing"}, "there is no option --nothing"},
    {ARL_TERRAIN, {"--out"}, "--out needs a value"},
    {ARL_TERRAIN, {"--out", "o.png", "--report", "r"}, "--out and --report exclude each other. Give one of them."},
    {ARL_TERRAIN, {"a.gdal", "b.gdal", "--out", "o.png"}, "\"b.gdal\" is a second elevation model"},
    {ARL_TERRAIN,
     {GNOMON_DATA "/jacksboro.vrt", "--out", "o.png"},
     "jacksboro.vrt\" cannot be read as an elevation model: its name does not say that GDAL is to read it. Give \""},
    {ARL_TERRAIN, {"missing.tif.gdal", "--out", "o.png"}, "there is no file \"missing.tif.gdal\"", false},
    {ARL_TERRAIN, {"small.asc.gdal", "--out", "o.png"}, "no place for the town: 900 m", false},
    {ARL_TERRAIN, {"--out", "nowhere/o.png"}, "nowhere"},
    {ARL_TERRAIN, {"/dev/zero", "--out", "o.png"}, "is a device or a pipe. Give an elevation model file."},
    {ARL_TERRAIN, {"--hour=25", "--out", "o.png"}, "--hour 25 cannot be used"},
    {ARL_TERRAIN, {"--out", "o.nothing"}, "o.nothing"},
    {ARL_TERRAIN, {"--report", "small.asc"}, "small.asc"},
    {GNOMONVIEWER, {scene}, "no window can be opened", false},
    {GNOMONVIEWER, {scene, "--samples", "4"}, "no window of 4 samples can be opened. Give fewer --samples.", false},
    {GNOMONVIEWER, {}, "no scene file"},
    {GNOMONVIEWER, {"pipe.osgt"}, "\"pipe.osgt\" is a device or a pipe. Give a scene file."},
    {GNOMONVIEWER, {"empty.osgt"}, "\"empty.osgt\" cannot be read as a scene"},
    {GNOMONVIEWER,
     {"small.asc"},
     "\"small.asc\" cannot be read as a scene: by its name it is an elevation model. Use arl_terrain "
     "\"small.asc.gdal\"."},
    {GNOMONVIEWER, {GNOMON_DATA "/jacksboro.vrt"}, "/jacksboro.vrt.gdal\"."},
    {GNOMONVIEWER, {GNOMON_DATA "/jacksboro.vrt.gdal"}, "/jacksboro.vrt.gdal\".", false},
    {GNOMONVIEWER, {scene, "--samples=0"}, "--samples 0 cannot be used. Allowed: a whole number from 1 to 16."},
    {GNOMONRUN, {}, "no program is given"},
    {GNOMONRUN, {"true"}, "\"true\" stands before --."},
    {GNOMONRUN, {"--frames=0", "--", "true"}, "--frames 0 cannot be used"},
    {GNOMONRUN, {"--shadow=map:size=3", "--", "true"}, "--shadow map:size=3: size=3 cannot be used."},
    {GNOMONRUN, {"--out", "o.png", "--", "true"}, "--out needs --frames N."},
    {GNOMONRUN, {"--frames", "3", "--out", "/dev/null", "--", "true"}, "\"/dev/null\" cannot be written"},
    {GNOMONRUN, {"--frames", "3", "--compare", "small.asc", "--", "true"}, "--compare small.asc is not a folder."},
    {GNOMONRUN, {"--size", "3x3", "--", "true"}, "there is no option --size"},
    {GNOMONCHART, {"nofile", "--out", "c"}, "there is no file \"nofile\"."},
    {GNOMONCHART, {"/dev/null", "--out", "c"}, "is a device or a pipe"},
    {GNOMONCHART, {scene, "--technique", "nothing", "--out", "c"}, "no technique's name contains \"nothing\"."},
    {GNOMONCHART, {"--again", "gone"}, "\"gone\" holds neither results.json nor stability.json."},
    {GNOMONCHART, {"--again=damaged"}, "\"damaged/results.json\" is damaged"},
    {ADDSHADOWS, {}, "no scene file can be read."},
    {ADDSHADOWS, {scene}, "no window can be opened.", false},
    {GNOMONVIEWER, {"/nowhere.osgt"}, "there is no file"},
    {GNOMONVIEWER, {scene, "--shadow", "moon"}, "not a shadow technique"},
    {GNOMONVIEWER, {scene, "--size", "0x5"}, "Allowed: WIDTHxHEIGHT"},
    {GNOMONVIEWER, {scene, "--out", "x.png"}, "no option --out"},
    {GNOMONVIEWER, {scene, "--sun-speed", "60"}, "--sun-speed needs exactly one --sun"},
    {GNOMONVIEWER, {scene, "--sun-speed", "-1"}, "Allowed: a number from 0 to 100000."},
    {GNOMONVIEWER, {scene, "--shadow", "planar", "--receiver", "sea"}, "no node is named \"sea\""},
    {GNOMONCOMPARE, {}, "--casting is missing. See --help."},
    {GNOMONCOMPARE, {"--casting", "a.tif", "--not-casting", "b.tif"}, "--truth is missing. See --help."},
    {GNOMONCOMPARE, {"--casting", "a", "--not-casting", "b", "--truth", "t", "a.tif"}, "no option takes \"a.tif\""},
    {GNOMONCOMPARE, {"--casting", "a", "--not-casting", "b", "--truth", "t", "--tolerance", "3"}, "--tolerance"},
    {GNOMONCOMPARE,
     {"--casting", "a", "--not-casting", "b", "--truth", "t", "--contact", "near"},
     "--contact near cannot be used"},
};

TEST(Programs, SayInOneSentenceWhatTheyCannotDo) {
    const TemporaryFolder folder;
    folder.write("small.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\n7 8 9\n4 5 6\n1 2 3\n");
    folder.write("empty.osgt", "");
    mkfifo((folder.path() / "pipe.osgt").c_str(), 0600);
    std::filesystem::create_directory(folder.path() / "damaged");
    folder.write("damaged/results.json", "{}");
    for (const Refused& each : refused) {
        const std::string said = refusal(each.program, each.arguments, folder, each.alone);
        EXPECT_NE(said.find(each.says), std::string::npos) << each.program << " says " << said << ", not " << each.says;
    }
    for (const std::string display : {"nonsense", ":9999"})
        EXPECT_EQ(runProgram("env", {"DISPLAY=" + display, GNOMONVIEWER, scene}, folder.path()).status, 1) << display;
}

TEST(Programs, SayBeforeTheyOpenAWindowThatALightIsBelowTheGround) {
    const TemporaryFolder folder;
    const Ending ending = runProgram("env", {"DISPLAY=", GNOMONVIEWER, scene, "--light", "0,0,-1,0"}, folder.path());
    EXPECT_EQ(ending.err.find("gnomonviewer: note: the light 0,0,-1,0 does not stand above the ground"), 0u);
}

TEST(Programs, HelpNamesOptionsWithDefaultsAndKeys) {
    const Arguments ofExamples = {"--size WxH",  "--out IMAGE", "--offscreen", "--keys LETTERS",
                                  "--frames N",  "(default 8)", "KEYS",        "  g        ",
                                  "  m        ", "  Esc      ", "Example: "},
                    ofGnomonshot = {"--shadow SPEC",
                                    "--light x,y,z,w",
                                    "--eye x,y,z",
                                    "--center x,y,z",
                                    "--viewup x,y,z",
                                    "--fovy DEG",
                                    "--near N",
                                    "--far F",
                                    "--size WxH",
                                    "--receiver NODENAME",
                                    "--casters all|none|NODENAME",
                                    "--ambient A",
                                    "--diffuse D",
                                    "--background r,g,b",
                                    "--frames N",
                                    "--out IMAGE",
                                    "--stats FILE.json",
                                    "--recommend",
                                    "--ground auto|none|SIZE",
                                    "--up y|z",
                                    "--help",
                                    "planar",
                                    "composite=",
                                    "azimuth 135"};
    const struct {
        const char* program;
        Arguments texts;
        bool isExample = false;
    } rows[] = {
        {CS4470_FAKESHADOW, {"  k        ", "  x        ", "(default 640x512)"}, true},
        {GUS_SHADOW, {"--points x,y,z", "--light x,y,z,w", "  k        "}, true},
        {HALOMAGIC, {"  p        ", "  9        ", "halo"}, true},
        {LAB8, {"--eye (x,y,z)", "--at (x,y,z)", "--light (x,y,z)", "0,5,0", "  n        ", "  u        "}, true},
        {SHAD, {"shad [OPTION...] FILE...", "  q        ", "  v        ", "--lights N", "(default 640x512)"}, true},
        {ARL_TERRAIN,
         {"--shadow none|box|hull", "--objects N", "1 to 1000000", "--hour H", "6.5 to 17.5 hours", "--size WxH",
          "--out IMAGE", "--report FOLDER", "(default hull)", "(default 9)", "Half an hour later"}},
        {GNOMONVIEWER, {"--shadow SPEC", "--light x,y,z,w", "--size WxH", "(default 800x600)", "KEYS", "  n  "}},
        {GNOMONCOMPARE,
         {"--casting", "--not-casting", "--shadowed", "--ambient", "--truth", "--overlay", "--json", "--contact",
          "--attached", "litCentre", "blockerDistance", "litByDisc", "towardsLight"}},
        {GNOMONSHOT, ofGnomonshot},
        {GNOMONRUN, {"--compare FOLDER", "--version", "(default auto)"}},
        {GNOMONCHART, {"--quick", "--version"}},
    };
    const TemporaryFolder folder;
    for (const auto& [program, texts, isExample] : rows) {
        const Ending ending = runProgram(program, {"--help"}, folder.path());
        EXPECT_EQ(ending.status, 0) << program;
        EXPECT_EQ(ending.err, "") << program;
        for (const std::string& text : texts) EXPECT_NE(ending.out.find(text), std::string::npos) << program << text;
        const Ending version = runProgram(program, {"--version"}, folder.path());
        EXPECT_EQ(version.status, 0);
        EXPECT_EQ(version.out, std::filesystem::path(program).filename().string() + " " GNOMON_VERSION "\n");
        for (const std::string& text : isExample ? ofExamples : Arguments())
            EXPECT_NE(ending.out.find(text), std::string::npos) << program << text;
        if (program == std::string(ARL_TERRAIN))
            EXPECT_EQ(ending.out.find("planar"), std::string::npos) << "what is not allowed";
    }
}

/// gnomonshot in a folder of its own.
class BadInput : public ::testing::Test {
protected:
    std::string refusalOf(const std::string& file) {
        return refusal(GNOMONSHOT, {file, "--shadow", "planar", "--out", "o.png"}, folder, false);
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

TEST_F(BadInput, FilesThatAreMissingOrOfAnotherType) {
    std::filesystem::create_directory(folder.path() / "dir.osgt");
    folder.write("noise.png", "\x89PNG\r\n\x1a\n then nothing");
    folder.write("readme.txt", "Hello.\n");
    folder.write("letter.osgt", "Dear OpenSceneGraph,\n");
    folder.write("letter.obj", "Dear OpenSceneGraph,\n");
    for (const std::string name : {"gone.osgt", "gone"})
        EXPECT_EQ(refusalOf(name), "there is no file \"" + name + "\".");
    for (const std::string name : {"dir.osgt", "."})
        EXPECT_EQ(refusalOf(name), "\"" + name + "\" is a directory. Give a scene file.");
    EXPECT_EQ(refusal(GNOMONVIEWER, {"gone"}, folder, false), "there is no file \"gone\".")
        << "no plugin is loaded yet";
    EXPECT_EQ(refusalOf("gone.osgt.30,0,0.rot"), "there is no file \"gone.osgt.30,0,0.rot\".");
    for (const char* name : {"noise.png", "letter.obj", "letter.osgt"}) EXPECT_EQ(refusalOf(name), damaged(name));
    refusalOf("readme.txt");
    folder.write("fox.gltf", "{}\n");
    for (const std::string name : {"fox.gltf", "fox.gltf.30,0,0.rot"})
        EXPECT_EQ(refusalOf(name),
                  "\"" + name +
                      "\" cannot be read as a scene: no plugin of OpenSceneGraph here reads files that "
                      "end in .gltf. Allowed: obj, osgt, ive, stl, 3ds, ….");
}

TEST_F(BadInput, FilesWithNothingInThem) {
    for (const char* name : {"a.osgt", "a.osgb", "a.ive", "a.obj", "a.stl", "a.3ds", "a.ply"}) {
        folder.write(name, "");
        const std::string said = refusalOf(name);
        EXPECT_TRUE(said == damaged(name) || said == empty(name)) << said;
    }
    folder.write("empty.osgt", "#Ascii Scene\n#Version 161\n#Generator by hand\n\nosg::Group {\n  UniqueID 1\n}\n");
    folder.write("nan.obj", "v nan nan nan\nv nan 0 0\nv 0 nan 0\nf 1 2 3\n");
    for (const char* name : {"empty.osgt", "nan.obj"}) EXPECT_EQ(refusalOf(name), empty(name));
}

/// A scene of which a class is nobody's: refused where nothing is left, told of where something is.
TEST_F(BadInput, ClassesThatNoPluginKnows) {
    const std::string head = "#Ascii Scene\n#Version 161\n#Generator by hand\n\n",
                      lamp = "elsewhere::Lamp { UniqueID 9 }";
    folder.write("all.osgt", head + lamp + "\n");
    EXPECT_EQ(refusalOf("all.osgt"),
              "no plugin here reads elsewhere::Lamp in \"all.osgt\". Name the folder of its plugin's "
              "folder in OSG_LIBRARY_PATH.");
    folder.write("part.osgt", head + "osg::Group { UniqueID 1 Children 2 { " + lamp +
                                  " osg::Geode { UniqueID 2 Drawables 1 { osg::ShapeDrawable { UniqueID 3 Shape TRUE { "
                                  "osg::Sphere { UniqueID 4 } } } } } } }\n");
    const Ending ending = runGnomonshot({"part.osgt", "--out", "o.png", "--ground", "none"}, folder.path());
    EXPECT_EQ(ending.status, 0);
    EXPECT_EQ(ending.err,
              "gnomonshot: note: \"part.osgt\" is shown in part: no plugin here reads its elsewhere::Lamp.\n");
}

/// Readers of text say the same of each thing that is behind the end.
TEST_F(BadInput, ALineOfOpenSceneGraphsIsSaidOnce) {
    const std::string whole = readFile(scene);
    folder.write("cut.osgt", whole.substr(0, whole.size() * 9 / 10));
    const Ending ending = runGnomonshot({"cut.osgt", "--out", "o.png"}, folder.path());
    std::istringstream lines(ending.out + ending.err);
    std::multiset<std::string> said;
    for (std::string line; std::getline(lines, line);) said.insert(line);
    EXPECT_GT(said.size(), 1u);
    for (const std::string& line : said) EXPECT_EQ(said.count(line), 1u) << line;
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
        if (ending.status != 0) EXPECT_EQ(refusalOf("cut.osgb").find("\"cut.osgb\" "), 0u) << part;
        std::filesystem::remove(folder.path() / "o.png");
    }
}

TEST_F(BadInput, ValuesThatCannotBeUsed) {
    const struct {
        const char* option;
        Arguments values;
        const char* allowed;
    } rows[] = {
        {"--shadow",
         {"plane"},
         "\"plane\" is not a shadow technique. Allowed: none, planar, box, hull, map, volume, traced, auto."},
        {"--shadow",
         {"planar:soft=1"},
         "the technique planar has no key \"soft\". Allowed: edges, composite, dark, terminator, receiver."},
        {"--size",
         {"0x600", "800x0", "0", "1000000x1000000", "1000000x1", "-8x6", "8x", "x6", "8.5x6", "8x6x4", "nanxnan", "800",
          "99999999999999999999x1"},
         "Allowed: WIDTHxHEIGHT from 1x1 to 16384x16384 pixels."},
        {"--light",
         {"nan,0,1,0", "0,0,inf,0", "0,0,1", "0,0,1,0,0", "a,b,c,d", "0,0,1e300,1", "1,,1,0"},
         "Allowed: 4 numbers from -1e+12 to 1e+12, separated by commas."},
        {"--light",
         {"0,0,0,0", "1,1,1,2", "1,1,1,-1"},
         "Allowed: a direction other than 0,0,0 with w = 0, or a position with w = 1."},
        {"--sun",
         {"noon", "2026-06-21T15:00:00Z", "2026-02-30T15:00:00Z,40,0", "2026-06-21T15:00:00,40,0"},
         "Allowed: a moment in UTC as 2026-06-21T15:00:00Z, a latitude from -90 to 90 and a longitude from -180 to 180 "
         "degrees, separated by commas."},
        {"--sun", {"2026-06-21T15:00:00Z,91,0"}, "The latitude must be from -90 to 90 degrees."},
        {"--sun", // 90 degrees less the declination of 23.44
         {"2026-06-21T00:00:00Z,0,0"},
         "The sun is 66.6 degrees below the horizon"},
        {"--eye", {"0,nan,1"}, "Allowed: 3 numbers from -1e+12 to 1e+12, separated by commas."},
        {"--center", {"0,nan,1"}, "Allowed: 3 numbers from -1e+12 to 1e+12, separated by commas."},
        {"--viewup", {"0,nan,1"}, "Allowed: 3 numbers from -1e+12 to 1e+12, separated by commas."},
        {"--fovy", {"0", "180", "-40", "nan", "wide"}, "Allowed: a number from 0.001 to 170."},
        {"--near", {"0"}, "Allowed: a number from 1e-09 to 1e+12."},
        {"--ambient", {"nan"}, "Allowed: a number from 0 to 10."},
        {"--diffuse", {"-1"}, "Allowed: a number from 0 to 10."},
        {"--background", {"0,0,2"}, "Allowed: 3 numbers from 0 to 1, separated by commas."},
        {"--samples", {"0", "17", "1.5"}, "Allowed: a whole number from 1 to 16."},
        {"--frames", {"0", "2.5"}, "Allowed: a whole number from 1 to 100000."},
        {"--up", {"x"}, "Allowed: y, z."},
        {"--ground", {"big"}, "Allowed: auto, none, or a side from 1e-09 to 1e+12."},
    };
    for (const auto& [option, values, allowed] : rows)
        for (const std::string& value : values) {
            const char* joint = std::islower(static_cast<unsigned char>(allowed[0])) ? ": " : ". ";
            const std::string expected = std::string(option) + " " + value + " cannot be used" + joint + allowed;
            for (const Arguments& given : {Arguments{option, value}, Arguments{option + ("=" + value)}}) {
                Arguments all = {scene, "--out", "o.png"};
                all.insert(all.end(), given.begin(), given.end());
                EXPECT_EQ(refusal(GNOMONSHOT, all, folder).substr(0, expected.size()), expected);
            }
        }
    EXPECT_EQ(refusal(GNOMONSHOT, {scene, "--out", "o.png", "--shadow", "map:size=3"}, folder),
              "--shadow map:size=3: size=3 cannot be used. Allowed: 16 to 16384, texels.");
}

TEST_F(BadInput, OptionsThatDoNotFit) {
    std::filesystem::create_directory(folder.path() / "dir.png");
    Arguments nineLights;
    for (int i = 0; i < 9; ++i) nineLights.insert(nineLights.end(), {"--light", "0,0,1,0"});
    const std::pair<Arguments, const char*> withPicture[] = {
        {{"--shadow", "planar", "--shadow", "planar:composite=blend"},
         "composite=relight and composite=blend cannot be mixed. Give every shadow the same."},
        {{"--shadow", "planar", "--receiver", "roof"},
         "no node is named \"roof\" to receive the shadow. Names in the scene: lab8, ground, sphere, cube. Give one of "
         "them as receiver=NAME."},
        {{"--casters", "roof"},
         "--casters: no node is named \"roof\". Allowed: all, none, or a node's name: lab8, ground, sphere, cube."},
        {nineLights, "--light is given more than 8 times. Allowed: 1 to 8 lights."},
        {{"--eye", "1,2,3", "--center", "1,2,3"}, "--eye and --center are the same point. Give two different points."},
        {{"--viewup", "0,0,0"}, "--viewup 0,0,0 is not a direction. Give any other vector."},
        {{"--eye", "0,0,5", "--center", "0,0,0", "--viewup", "0,0,1"},
         "--viewup is parallel to the view. Give a vector at an angle to it."},
        {{"--near", "5", "--far", "5"}, "--near must be less than --far."},
        {{"--near", "5"}, "--near and --far need each other. Give both or neither."},
        {{"--moon", "full"}, "there is no option --moon. See --help for all options."},
        {{"--size"}, "--size needs a value: WxH."},
        {{"--size", "8x8", "--size", "9x9"}, "--size is given twice. Give it once."},
        {{"--size=8x8", "--size", "9x9"}, "--size is given twice. Give it once."},
        {{"--size="}, "--size  cannot be used. Allowed: WIDTHxHEIGHT from 1x1 to 16384x16384 pixels."},
        {{"--shadow", "map:side=3"},
         "--shadow map:side=3 cannot be used: the technique map has no key \"side\". Allowed: size, filter, cascades, "
         "edges, sun-angle, lamp-size, radius, view, composite, dark, terminator, receiver."},
        {{"--siz=8x8"}, "there is no option --siz. See --help for all options."},
        {{"--"}, "there is no option --. See --help for all options."},
        {{""}, "there is no file \"\"."},
        {{"-O"}, "-O needs a value."},
    };
    const std::pair<Arguments, const char*> alone[] = {
        {{scene, "--out", "--size", "8x8"}, "--out needs a value: IMAGE."},
        {{scene, "--out", "gone/o.png"}, "\"gone/o.png\" cannot be written: there is no directory \"gone\"."},
        {{scene, "--out", "dir.png"}, "\"dir.png\" cannot be written: it is a directory. Give a file's name."},
        {{scene, "--out", "/dev/null"},
         "\"/dev/null\" cannot be written: it is not a regular file. Give another name."},
        {{scene, "--out", "/proc/o.png"},
         "\"/proc/o.png\" cannot be written: its directory is not writable. Give another one."},
        {{scene, "--out", "o.obj"},
         "\"o.obj\" cannot be written: OpenSceneGraph writes no such images. Allowed: png, jpg, bmp, tif, rgb."},
        {{scene, "--stats", "gone/s.json"}, "\"gone/s.json\" cannot be written: there is no directory \"gone\"."},
        {{scene, "--truth", "t.png"},
         "\"t.png\" cannot be written: this format cannot hold the data. Allowed: .osgb, .osgt, .osgx."},
        {{scene, "--truth", "t.osgb", "--casters", "cube"},
         "--truth and --casters exclude each other. Give one of them: the truth is that of all casters."},
        {{scene, "--truth", "t.osgb", "--light", "1,0,1,0", "--light", "0,1,1,0"},
         "--truth needs exactly one light, but the scene has 2."},
        {{}, "no scene file is given. See --help."},
        {{"--out", "o.png"}, "no scene file is given. See --help."},
        {{scene}, "no output is asked for. Give --out IMAGE, --stats FILE.json, --truth FILE.osgb or --recommend."},
    };
    for (const auto& [more, says] : withPicture) {
        Arguments arguments = {scene, "--out", "o.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(refusal(GNOMONSHOT, arguments, folder), says);
    }
    for (const auto& [arguments, says] : alone) EXPECT_EQ(refusal(GNOMONSHOT, arguments, folder), says);
}

/// A scene of so many spheres, each with a name; and one without any.
TEST_F(BadInput, NamesAFewOfManyNodesAndCountsTheOthers) {
    const auto refusalOfCasters = [this](int spheres) {
        osg::ref_ptr<osg::Group> all = new osg::Group;
        for (int i = 0; i < std::max(spheres, 1); ++i) {
            osg::ref_ptr<osg::Geode> geode = new osg::Geode;
            geode->addDrawable(new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(), 1.0f)));
            if (spheres > 0) geode->setName("s" + std::to_string(i));
            all->addChild(geode);
        }
        osgDB::writeNodeFile(*all, (folder.path() / "many.osgt").string());
        return refusal(GNOMONSHOT, {"many.osgt", "--casters", "roof", "--ground", "none", "--out", "o.png"}, folder);
    };
    const std::string start = "--casters: no node is named \"roof\". Allowed: all, none";
    EXPECT_EQ(refusalOfCasters(0), start + "; no node here has a name.");
    EXPECT_EQ(refusalOfCasters(13), start + ", or a node's name: s0, s1, s2, s3, s4, s5, s6, s7, s8, s9 and 3 more.");
    EXPECT_NE(refusalOfCasters(1500).find("s9 and at least 990 more."), std::string::npos);
}

TEST_F(BadInput, LeavesAFileThatIsThereAsItIs) {
    folder.write("o.png", "precious");
    refusal(GNOMONSHOT, {scene, "--out", "o.png", "--shadow", "planar", "--receiver", "roof"}, folder);
    EXPECT_EQ(readFile(folder.path() / "o.png"), "precious");
}

/// A picture under a scene's ending would take a scene's place sooner or later.
TEST_F(BadInput, NoProgramWritesAPictureUnderAScenesEnding) {
    for (const char* name : {"o.osgt", "o.osgb", "o.osgx", "o.ive", "o.OSGT"}) {
        const std::string says = std::string("\"") + name +
                                 "\" cannot be written: its ending is a scene's. Allowed: png, jpg, bmp, tif, rgb.";
        EXPECT_EQ(refusal(GNOMONSHOT, {scene, "--out", name}, folder, false), says);
        for (const char* program : {LAB8, ARL_TERRAIN})
            EXPECT_EQ(refusal(program, {"--out", name}, folder, false), says) << program;
        EXPECT_EQ(refusal(GNOMONRUN, {"--frames", "1", "--out", name, "--", "true"}, folder, false), says);
        const Arguments compared = {"--casting", "a", "--not-casting", "b", "--truth", "c", "--overlay", name};
        EXPECT_EQ(refusal(GNOMONCOMPARE, compared, folder, false), says);
    }
}

/// A scene that reads a material file, which reads a texture.
TEST_F(BadInput, NoProgramWritesOverAFileThatItReads) {
    folder.write("quad.obj", "mtllib quad.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"
                             "f 1/1 3/3 2/2\n");
    folder.write("quad.mtl", "newmtl m\nKd 1 1 1\nmap_Kd quad.png\n");
    osg::ref_ptr<osg::Image> dot = new osg::Image;
    dot->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    osgDB::writeImageFile(*dot, (folder.path() / "quad.png").string());
    const std::string texture = readFile(folder.path() / "quad.png"), model = readFile(folder.path() / "quad.obj");
    const auto says = [](const std::string& file) {
        return "\"" + file + "\" cannot be written: the program reads it. Give another name.";
    };
    const std::string elsewhere = "../" + folder.path().filename().string() + "/quad.png";
    for (const std::string& out : {std::string("quad.png"), elsewhere})
        EXPECT_EQ(refusal(GNOMONSHOT, {"quad.obj", "--size", "8x8", "--out", out}, folder, false), says(out));
    for (const char* out : {"quad.obj", "quad.mtl"})
        EXPECT_EQ(refusal(GNOMONSHOT, {"quad.obj", "--size", "8x8", "--stats", out, "--frames", "1"}, folder, false),
                  says(out));
    EXPECT_EQ(refusal(GNOMONRUN, {"--frames", "1", "--out", "quad.png", "--", "true", "quad.png"}, folder),
              says("quad.png"));
    EXPECT_EQ(readFile(folder.path() / "quad.png"), texture);
    EXPECT_EQ(readFile(folder.path() / "quad.obj"), model);
}

} // namespace
