// SPDX-License-Identifier: MIT
// index.html as text, and the pictures in it; report_page_test.py opens it in a browser.
#include "Page.h"
#include "../io/Program.h"
#include "ChartReport.h"
#include "OutputFile.h"
#include "PagePictures.h"
#include "ResultsFile.h"
#include "TextTemplate.h"

#include <support/SyntheticChart.h>

#include <gtest/gtest.h>

#include <osgDB/ReadFile>

#include <algorithm>
#include <fstream>

namespace {

using namespace gnomon::examples;
using namespace gnomon::testing;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Base64, IsThatOfItsStandard) { // RFC 4648, section 10
    const std::pair<const char*, const char*> known[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : known) EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(Template, FillsEachNameOnceAndKnowsWhichIsMissing) {
    EXPECT_EQ(fillTemplate("a ${X} b ${Y}${X}", {{"X", "${Y}"}, {"Y", "1"}}), "a ${Y} b 1${Y}");
    EXPECT_THROW(fillTemplate("${Z}", {{"X", ""}}), std::logic_error);
}

class Page : public ::testing::Test {
protected:
    std::string path() const { return folder.path().string(); }

    /// A picture that does not pack well.
    void noise(const std::string& name, int width, int height) {
        osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE);
        unsigned state = 1;
        for (unsigned i = 0; i < image->getTotalSizeInBytes(); ++i)
            image->data()[i] = static_cast<unsigned char>((state = state * 1664525u + 1013904223u) >> 24);
        OutputFile((folder.path() / name).string()).write(*image);
    }

    TemporaryFolder folder;
};

TEST_F(Page, APictureIsTakenInOnceAndWhole) {
    noise("a.png", 20, 10);
    PagePictures pictures(path());
    EXPECT_EQ(pictures.add("a.png"), 0);
    EXPECT_EQ(pictures.add("a.png"), 0);
    const nlohmann::json list = pictures.json();
    ASSERT_EQ(list.size(), 1u);
    EXPECT_EQ(list[0], "data:image/png;base64," + base64(readFile(folder.path() / "a.png")));
    EXPECT_EQ(pictures.shrunk(), 1);
}

TEST_F(Page, WhatIsNoPngFileIsNoPicture) {
    folder.write("secret.txt", "password");
    folder.write("text.png", "password");
    PagePictures pictures(path());
    for (const char* name : {"", "gone.png", "secret.txt", "text.png", ".", "/etc/passwd"})
        EXPECT_EQ(pictures.add(name), nullptr) << name;
    EXPECT_TRUE(pictures.json().empty());
}

TEST_F(Page, TooManyBytesOfPicturesAreHalvedUntilTheyFit) {
    noise("a.png", 128, 64);
    noise("b.png", 64, 64);
    const std::size_t whole = readFile(folder.path() / "a.png").size() + readFile(folder.path() / "b.png").size();
    PagePictures pictures(path(), whole / 6); // noise at half the size each way takes a quarter
    pictures.add("a.png");
    pictures.add("b.png");
    const nlohmann::json list = pictures.json();
    EXPECT_EQ(pictures.shrunk(), 4);
    EXPECT_LT(list.dump().size(), whole / 4);
    folder.write("back.b64", list[0].get<std::string>().substr(22));
    ASSERT_EQ(runProgram("/bin/sh", {"-c", "base64 -d back.b64 >back.png"}, folder.path()).status, 0);
    const osg::ref_ptr<osg::Image> back = osgDB::readRefImageFile(path() + "/back.png");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->s(), 32);
    EXPECT_EQ(back->t(), 16);
}

TEST_F(Page, OfNothingMeasuredIsWrittenAndSaysThatItIsNotWhole) {
    writeReport(ChartResults(), path());
    const std::string html = readFile(folder.path() / "index.html");
    EXPECT_TRUE(holds(html, "The run was interrupted or is still running: 0 points so far."));
    EXPECT_TRUE(holds(html, "What the numbers mean"));
}

TEST_F(Page, NoTextOfTheResultsIsMarkup) {
    const std::string evil = "</script><script>alert(1)</script><img src=x onerror='alert(2)'>\"&";
    ChartResults results;
    results.made = {{evil, evil}};
    results.scenes.push_back({evil, evil, 1, 0.0, 0.4, 1.0, evil, {{evil, evil}}});
    ChartPoint point = test::chartPoint("Gnomon", evil.c_str(), evil.c_str(), 1, 2);
    point.scene = evil;
    point.notes = {evil};
    point.settings = {{evil, evil}};
    point.errors->catastrophes.allLit = true;
    results.points = {point};
    writeReport(results, path());
    const std::string html = readFile(folder.path() / "index.html");
    EXPECT_FALSE(holds(html, "<script>alert"));
    EXPECT_FALSE(holds(html, "<img src=x"));
    EXPECT_TRUE(holds(html, "&lt;img src=x onerror=&#39;alert(2)&#39;&gt;&quot;&amp;"));
    EXPECT_FALSE(std::any_of(html.begin(), html.end(), [](char c) { return c == '\0'; }));
    std::size_t closing = 0;
    for (std::size_t at = 0; (at = html.find("</script", at)) != std::string::npos; ++at) ++closing;
    EXPECT_EQ(closing, 4u); // data, jQuery, DataTables, the page's own
}

TEST_F(Page, IsDrawnAgainFromTheResultsAlone) {
    ChartResults results;
    results.complete = true;
    results.scenes.push_back({"boxes", "Boxes", 1, 0.0, 0.4, 1.0, "", {}});
    results.points = {test::chartPoint("Gnomon", "map", "size 512", 1, 2)};
    saveResults(results, path());
    const Ending ending = runProgram(GNOMONCHART, {"--again", path()}, folder.path());
    EXPECT_EQ(ending.status, 0) << ending.err;
    const std::string html = readFile(folder.path() / "index.html");
    EXPECT_TRUE(holds(html, "Gnomon map, size 512: 1 ms (1 to 1), 2 px"));
    const Ending gone = runProgram(GNOMONCHART, {"--again", path() + "/gone"}, folder.path());
    EXPECT_EQ(gone.status, 1);
    EXPECT_TRUE(holds(gone.lastLine(), "there is no file \"" + path() + "/gone/results.json\"")) << gone.err;
}

TEST_F(Page, ThatCannotBeWrittenIsRefusedInOneSentence) {
    std::filesystem::create_directory(folder.path() / "index.html");
    try {
        writeReport(ChartResults(), path());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_TRUE(holds(error.what(), "index.html\" cannot be written: it is a directory"));
    }
}

} // namespace
