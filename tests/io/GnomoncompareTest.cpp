// SPDX-License-Identifier: MIT
// gnomoncompare as users run it, on the box of tests/math/metrics: pictures and truth through files and back.
#include "../math/metrics/BoxOnGround.h"
#include "ImageFile.h"
#include "Program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <osg/ValueObject>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cmath>
#include <functional>
#include <limits>

namespace {

using namespace gnomon::testing;
using gnomon::examples::truthImage;
using gnomon::examples::truthOf;
using gnomon::metrics::Picture;
using gnomon::metrics::TruthMaps;
using gnomon::test::BoxOnGround;
using gnomon::test::filled;
using gnomon::test::perfect;
using nlohmann::json;
using Arguments = std::vector<std::string>;

/// A grey picture as floats.
osg::ref_ptr<osg::Image> floats(const Picture& picture) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_LUMINANCE, GL_FLOAT);
    for (std::size_t i = 0; i < picture.cells.size(); ++i)
        reinterpret_cast<float*>(image->data())[i] = static_cast<float>(picture.cells[i]);
    return image;
}

/// As bytes up to 200, in colours whose mean is the grey, reddish and bluish by turns.
osg::ref_ptr<osg::Image> bytes(const Picture& picture) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (std::size_t i = 0; i < picture.cells.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const long tint = (i % 2 ? 30 : -30) * (1 - long(c));
            image->data()[3 * i + c] = static_cast<unsigned char>(std::lround(200.0 * picture.cells[i]) + tint);
        }
    return image;
}

class Gnomoncompare : public ::testing::Test {
protected:
    void save(const osg::Image& image, const std::string& name) {
        ASSERT_TRUE(osgDB::writeImageFile(image, (folder.path() / name).string()));
    }

    /// B, S and the truth; A is `visibility`.
    void saveAll(const Picture& visibility, const TruthMaps& truth = BoxOnGround().truth()) {
        save(*floats(visibility), "a.tif");
        save(*floats(Picture(visibility.width, visibility.height, 1.0)), "b.tif");
        save(*floats(Picture(visibility.width, visibility.height, 0.0)), "s.tif");
        save(*truthImage(truth), "t.osgb");
    }

    static Arguments given(Arguments more, const std::string& a, const std::string& b, const std::string& t) {
        more.insert(more.begin(), {"--casting", a, "--not-casting", b, "--truth", t});
        return more;
    }
    Ending run(const Arguments& more, const std::string& a = "a.tif", const std::string& b = "b.tif") {
        return runProgram(GNOMONCOMPARE, given(more, a, b, "t.osgb"), folder.path());
    }
    /// The one sentence of a run that must be refused.
    std::string refused(const Arguments& more, const std::string& a = "a.tif", const std::string& b = "b.tif",
                        const std::string& t = "t.osgb") {
        return refusal(GNOMONCOMPARE, given(more, a, b, t), folder, false);
    }

    json numbers(const Arguments& more = {}) {
        Arguments all = more;
        all.insert(all.end(), {"--json", "n.json"});
        const Ending ending = run(all);
        EXPECT_EQ(ending.status, 0) << ending.err;
        return json::parse(readFile(folder.path() / "n.json"));
    }

    TemporaryFolder folder;
};

TEST_F(Gnomoncompare, ATruePictureHasNoError) {
    saveAll(perfect());
    const json n = numbers({"--shadowed", "s.tif"});
    EXPECT_EQ(n["awayFromEdges"]["misclassified"], 0.0);
    EXPECT_EQ(n["awayFromEdges"]["iou"], 1.0);
    EXPECT_EQ(n["boundaryPixels"]["max"], 0.0);
    EXPECT_EQ(n["rmsePointSun"]["all"], 0.0);
    EXPECT_EQ(n["rmseDiscSun"]["all"], nullptr);
    EXPECT_EQ(n["rmsePointSunFiltered4x4"]["all"], 0.0);
    EXPECT_EQ(n["catastrophes"]["any"], false);
    EXPECT_EQ(n["pixels"]["sound"], true);
}

TEST_F(Gnomoncompare, PlantedFaultsReachTheirNumbers) {
    const Picture hole = filled(perfect(), 50, 44, 6, 6, 1.0);
    saveAll(filled(filled(hole, 40, 32, 6, 32, 1.0), 100, 10, 2, 2, 0.0)); // a leak, a lifted base, acne
    const json causes = numbers()["causes"];
    EXPECT_EQ(causes["leak"], 36);
    EXPECT_EQ(causes["peterPanning"], 160);
    EXPECT_EQ(causes["acne"], 4);
    EXPECT_EQ(causes["halo"], 0);
    EXPECT_EQ(causes["erosion"], 0);
    EXPECT_NEAR(causes["gapMetres"].get<double>(), 0.25, 1e-5); // positions are floats
}

TEST_F(Gnomoncompare, ReportsEveryMetricAndANarrowerContactMakesPeterPanningErosion) {
    saveAll(filled(perfect(), 40, 32, 6, 32, 1.0));
    const std::string text = run({}).out;
    for (const char* word :
         {"boundary", "misclassified", "balanced error", "IoU", "acne 0 px", "halo 0 px", "peter-panning 160 px",
          "gap 0.25 m", "leak 0 px", "erosion 0 px", "over-dark", "RMSE", "catastrophes   none"})
        EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
    const json causes = numbers({"--contact", "0.2"})["causes"]; // columns 41 and 42
    EXPECT_EQ(causes["peterPanning"], 64);
    EXPECT_EQ(causes["erosion"], 96);
}

TEST_F(Gnomoncompare, WhatIsAttachedCanBeWidened) {
    saveAll(filled(perfect(), 50, 67, 1, 1, 0.0)); // 3.5 px from the boundary
    EXPECT_EQ(numbers()["causes"]["acne"], 1);
    EXPECT_EQ(numbers({"--attached", "4"})["causes"]["halo"], 1);
}

TEST_F(Gnomoncompare, PicturesOfBytesAndAnAmbientLevelGiveTheSameShadow) {
    saveAll(perfect());
    save(*bytes(gnomon::test::picture(128, 96, [v = perfect()](int x, int y) { return 0.2 + 0.8 * v.at(x, y); })),
         "a.png");
    save(*bytes(Picture(128, 96, 1.0)), "b.png");
    const Ending ending = run({"--ambient", "0.15686", "--json", "n.json"}, "a.png", "b.png");
    ASSERT_EQ(ending.status, 0) << ending.err;
    const json n = json::parse(readFile(folder.path() / "n.json"));
    EXPECT_EQ(n["awayFromEdges"]["misclassified"], 0.0);
    EXPECT_NEAR(n["boundaryPixels"]["p95"].get<double>(), 0.0, 0.02); // bytes
}

TEST_F(Gnomoncompare, TheOverlayShowsMissedRedAndFalseBlue) {
    Picture wrong = filled(filled(perfect(), 50, 44, 6, 6, 1.0), 100, 10, 4, 4, 0.0);
    wrong.at(110, 80) = std::nan("");
    saveAll(wrong);
    ASSERT_EQ(run({"--overlay", "o.png"}).status, 0);
    const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile((folder.path() / "o.png").string());
    ASSERT_TRUE(image);
    EXPECT_EQ(image->s(), 128);
    EXPECT_EQ(image->t(), 96);
    const auto at = [&](unsigned x, unsigned y) { return image->getColor(x, y); };
    EXPECT_TRUE(at(52, 46).r() > 0.8 && at(52, 46).b() < 0.2);
    EXPECT_TRUE(at(101, 11).b() > 0.9 && at(101, 11).r() < 0.2);
    EXPECT_TRUE(at(110, 80).r() == 1.0f && at(110, 80).g() == 0.0f && at(110, 80).b() == 1.0f);
    EXPECT_EQ(at(60, 60).r(), at(60, 60).b()); // grey where it is right
    EXPECT_LT(at(60, 60).r(), at(90, 60).r()); // dark in shadow
    EXPECT_LT(at(20, 40).r(), at(90, 60).r()); // and where it is not judged
}

TEST_F(Gnomoncompare, CatastrophesAreNumbersAndNotFailures) {
    Picture black(128, 96, 0.0);
    black.at(3, 3) = std::numeric_limits<double>::infinity();
    saveAll(black);
    const json n = numbers();
    EXPECT_EQ(n["catastrophes"]["allShadowed"], true);
    EXPECT_EQ(n["catastrophes"]["notFinitePixels"], 1);
    EXPECT_EQ(n["boundaryPixels"], nullptr);
    EXPECT_NE(run({}).out.find("all is shadowed"), std::string::npos);
}

TEST_F(Gnomoncompare, TooMuchDroppedIsSaid) {
    TruthMaps truth = BoxOnGround().truth();
    truth.drawn = truth.receiver;
    for (int x = 0; x < 128; ++x)
        for (int y = 80; y < 90; ++y) truth.drawn.at(x, y) = 7;
    saveAll(perfect(), truth);
    EXPECT_NE(run({}).lastLine().find("more than 5 % of the surface is dropped"), std::string::npos);
    EXPECT_EQ(numbers()["pixels"]["sound"], false);
}

/// Two halves of the ground are of two greys, and A is drawn from a place d px aside: of 128 columns d are brighter than in B.
/// Then a truth without the ground of as many columns that are in shadow in A.
TEST_F(Gnomoncompare, PicturesOfAnotherViewAreToldWhereTheyCanBe) {
    const auto saidFrom = [&](int aside) {
        saveAll(perfect());
        const auto drawn = [](int edge) { return [edge](int x, int) { return x < edge ? 1.0 : 0.5; }; };
        save(*floats(gnomon::test::picture(128, 96, drawn(90 + aside))), "a.tif");
        save(*floats(gnomon::test::picture(128, 96, drawn(90))), "b.tif");
        return run({"--shadowed", "s.tif"}).err;
    };
    const std::string start =
                          "gnomoncompare: note: these numbers mean nothing, because A is brighter than B, or differs "
                          "from it where the truth has no surface, at ",
                      ending = " % of the pixels; draw A, B and the truth with one camera and light.\n";
    EXPECT_EQ(saidFrom(0), "");
    EXPECT_EQ(saidFrom(1), "") << "0.8 % of the pixels";
    EXPECT_EQ(saidFrom(8), start + "6" + ending);
    EXPECT_EQ(saidFrom(-8), "") << "darker, as in a false shadow: nobody can tell";
    TruthMaps holed = BoxOnGround().truth();
    for (int x = 40; x < 70; ++x)
        for (int y = 32; y < 64; ++y) holed.receiver.at(x, y) = 0;
    saveAll(perfect(), holed); // 30 * 32 of 128 * 96 pixels
    EXPECT_NE(run({"--shadowed", "s.tif"}).err.find(start + "8" + ending), std::string::npos);
}

TEST_F(Gnomoncompare, WhatIsTurnedAwayFromTheLightIsDarkAndNotWithoutANumber) {
    TruthMaps truth = BoxOnGround().truth();
    truth.facing.at(110, 80) = -0.5;
    Picture away = perfect();
    away.at(110, 80) = away.at(20, 80) = std::nan("");
    saveAll(away, truth);
    ASSERT_EQ(run({"--overlay", "o.png"}).status, 0);
    const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile((folder.path() / "o.png").string());
    EXPECT_LT(image->getColor(110, 80).r(), 0.15f);
    EXPECT_EQ(image->getColor(20, 80).r(), 1.0f);
}

/// gnomonshot's own pictures by its own truth, one light and then another.
TEST_F(Gnomoncompare, JudgesPicturesOfGnomonshotByTheTruthThatGnomonshotWrites) {
    const auto shoot = [&](Arguments more) {
        more.insert(more.begin(),
                    {GNOMON_DATA "/lab8.osgt", "--samples", "1", "--ambient", "0", "--fill", "0", "--size", "400x300",
                     "--eye", "-1,-3.6,2.2", "--center", "-0.15,0.1,0.1", "--light"});
        const Ending ending = runProgram(GNOMONSHOT, more, folder.path());
        EXPECT_EQ(ending.status, 0) << ending.err;
    };
    shoot({"1,-1,2,0", "--shadow", "traced", "--out", "a.tif", "--truth", "t.osgb"});
    shoot({"1,-1,2,0", "--casters", "none", "--shadow", "traced", "--out", "b.tif"});
    EXPECT_EQ(run({}).err, "");
    const json right = numbers();
    EXPECT_LE(right["awayFromEdges"]["misclassified"].get<double>(), 1e-4);
    EXPECT_GT(right["awayFromEdges"]["pixels"].get<int>(), 20000);
    EXPECT_LT(right["boundaryPixels"]["p95"].get<double>(), 0.5) << "a ray through each pixel's centre";
    EXPECT_TRUE(right["pixels"]["sound"]);
    shoot({"1,-1,1.6,0", "--shadow", "traced", "--out", "a.tif"});
    EXPECT_GT(numbers()["boundaryPixels"]["p95"].get<double>(), 2.0) << "under another light";
    EXPECT_NE(run({}).err.find("these numbers mean nothing"), std::string::npos) << "A's sides are brighter than B's";
    const Ending elsewhere =
        runProgram(GNOMONSHOT,
                   {GNOMON_DATA "/lab8.osgt", "--samples", "1", "--ambient", "0", "--fill", "0", "--size", "400x300",
                    "--eye", "-1,-3.2,2.0", "--center", "-0.15,0.1,0.1", "--light", "1,-1,2,0", "--out", "a.tif"},
                   folder.path());
    EXPECT_EQ(elsewhere.status, 0) << elsewhere.err;
    EXPECT_NE(run({}).err.find("these numbers mean nothing"), std::string::npos);
}

TEST_F(Gnomoncompare, RefusesFilesThatAreMissingOrDamagedOrOfOtherSizes) {
    saveAll(perfect());
    save(*floats(Picture(64, 96, 1.0)), "small.tif");
    const std::string whole = readFile(folder.path() / "t.osgb");
    folder.write("cut.osgb", whole.substr(0, whole.size() / 2));
    folder.write("empty.tif", "");
    const std::string gone = "there is no file \"gone.tif\".",
                      small = "\"small.tif\" is 64 x 96 px and \"a.tif\" 128 x 96 px. Give files of one size.";
    EXPECT_EQ(refused({"--json", "n.json"}, "gone.tif"), gone);
    EXPECT_EQ(refused({"--shadowed", "gone.tif"}), gone);
    EXPECT_EQ(refused({}, "a.tif", "b.tif", "gone.osgb"), "there is no file \"gone.osgb\".");
    EXPECT_NE(refused({}, "a.tif", "b.tif", "cut.osgb").find("\"cut.osgb\""), std::string::npos);
    EXPECT_NE(refused({}, "empty.tif").find("\"empty.tif\""), std::string::npos);
    EXPECT_EQ(refused({}, "a.tif", "small.tif"), small);
    EXPECT_EQ(refused({"--shadowed", "small.tif"}), small);
    EXPECT_EQ(refused({"--json", "n.json"}, "small.tif", "small.tif"),
              "\"t.osgb\" is 128 x 96 px and \"small.tif\" 64 x 96 px. Give files of one size.");
    EXPECT_EQ(refused({"--shadowed", "s.tif", "--ambient", "0"}),
              "--shadowed and --ambient exclude each other. Give one of them.");
    EXPECT_NE(refused({"--overlay", "o.txt"}).find("\"o.txt\" cannot be written"), std::string::npos);
    EXPECT_NE(refused({"--json", "gone/n.json"}).find("there is no directory"), std::string::npos);
}

TEST_F(Gnomoncompare, RefusesATruthThatIsNone) {
    saveAll(perfect());
    EXPECT_EQ(refused({}, "a.tif", "b.tif", "b.tif"),
              "\"b.tif\" is not a truth file: it is not an image of floats with one named layer for each map.");
    const std::string isNone = "\"spoilt.osgb\" is not a truth file: ",
                      noNumber = isNone + "a pixel of its surface holds NaN, or a share outside 0 to 1.";
    const std::pair<std::function<void(TruthMaps&)>, std::string> spoilt[] = {
        {[](TruthMaps& t) { t.facing = {}; }, isNone + "it has no layer \"facing\"."},
        {[](TruthMaps& t) { t.lit.at(5, 5) = std::nan(""); }, noNumber},
        {[](TruthMaps& t) { t.lit.at(5, 5) = 16.0; }, noNumber},
        {[](TruthMaps& t) { t.facing.at(5, 5) = std::nan(""); }, noNumber},
        {[](TruthMaps& t) { t.receiver.at(5, 5) = -1; },
         isNone + "its layer \"receiver\" holds a value that is not an id."},
        {[](TruthMaps& t) { t.receiver = gnomon::metrics::Grid<int>(128, 96, 0); }, "no pixel can be judged"}};
    for (const auto& [spoil, says] : spoilt) {
        TruthMaps truth = BoxOnGround().truth();
        spoil(truth);
        save(*truthImage(truth), "spoilt.osgb");
        EXPECT_NE(refused({}, "a.tif", "b.tif", "spoilt.osgb").find(says), std::string::npos) << says;
    }
}

TEST(TruthFile, KeepsEveryMap) {
    TruthMaps truth = BoxOnGround{{}, 0.3}.truth();
    truth.drawn = truth.receiver;
    truth.drawn.at(3, 4) = 16777216;
    truth.blocker = truth.drawn;
    truth.litByDisc = truth.lit;
    truth.edgeLength = truth.facing;
    truth.up = {0, 1, 0};
    const TemporaryFolder folder;
    for (const char* name : {"t.osgb", "t.osgt", "t.osgx"}) {
        const std::string file = (folder.path() / name).string();
        ASSERT_TRUE(osgDB::writeImageFile(*truthImage(truth), file));
        const TruthMaps back = gnomon::examples::readTruth(file, "test");
        EXPECT_EQ(back.lit.cells, truth.lit.cells); // sixteenths
        EXPECT_EQ(back.litCentre.cells, truth.litCentre.cells);
        EXPECT_EQ(back.receiver.cells, truth.receiver.cells);
        EXPECT_EQ(back.drawn.cells, truth.drawn.cells);
        EXPECT_EQ(back.blocker.cells, truth.blocker.cells);
        EXPECT_EQ(back.litByDisc.cells, truth.litByDisc.cells);
        EXPECT_NEAR(back.edgeLength.at(9, 9), truth.edgeLength.at(9, 9), 1e-7);
        EXPECT_NEAR(back.blockerDistance.at(50, 40), truth.blockerDistance.at(50, 40), 1e-6);
        EXPECT_TRUE(std::isinf(back.blockerDistance.at(100, 40)));
        EXPECT_NEAR(back.position.at(77, 11).x, truth.position.at(77, 11).x, 1e-6);
        EXPECT_NEAR(back.position.at(77, 11).y, truth.position.at(77, 11).y, 1e-6);
        EXPECT_EQ(back.towardsLight, truth.towardsLight);
        EXPECT_EQ(back.up, truth.up);
    }
}

TEST(TruthFile, LeavesOutWhatIsNotThere) {
    TruthMaps truth = BoxOnGround().truth();
    truth.position = {};
    const TruthMaps back = truthOf(*truthImage(truth), "memory");
    EXPECT_TRUE(back.position.empty());
    EXPECT_TRUE(back.drawn.empty());
    EXPECT_TRUE(back.litByDisc.empty());
}

} // namespace
