// SPDX-License-Identifier: MIT
// Figures as gnuplot draws them: what is in the SVG, and that nothing else is left behind.
#include "../io/Program.h"
#include "FigureSvg.h"
#include "Gnuplot.h"
#include "ReportFigures.h"

#include <support/SyntheticChart.h>

#include <gtest/gtest.h>

#include <osgDB/ReadFile>

#include <cstdlib>

namespace {

using namespace gnomon::examples;
using namespace gnomon::testing;
using test::chartPoint;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++found;
    return found;
}

Figure figureOf(const std::vector<ChartPoint>& points) {
    ChartResults results;
    results.points = points;
    Figure figure{"figure", "Title", "remark", {}, 1};
    figure.panels.push_back({"still", "Still", sceneCurves(results, "boxes", LightMotion::Still), 0.4});
    return figure;
}

class FigureFiles : public ::testing::Test {
protected:
    std::string path() const { return folder.path().string(); }
    std::string svg(const std::string& name = "figure") const { return readFile(folder.path() / (name + ".svg")); }

    void draw(const std::vector<ChartPoint>& points) {
        ChartResults results;
        results.points = points;
        drawFigure(figureOf(points), CurveStyles(results), path());
    }
    /// What Python's parser says of an SVG; empty if it is well-formed.
    std::string malformed(const std::string& name) {
        const std::string script = "import sys, xml.dom.minidom; xml.dom.minidom.parse('" + name + "')";
        return runProgram(PYTHON3, {"-c", script}, folder.path()).lastLine();
    }

    TemporaryFolder folder;
};

TEST_F(FigureFiles, AreAnSvgAPngAndTheScriptThatDrawsThemAgain) {
    draw({chartPoint("Gnomon", "map", "size 512", 2, 4)});
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"figure.gnuplot", "figure.png", "figure.svg"}));
    EXPECT_EQ(malformed("figure.svg"), "");
    const osg::ref_ptr<osg::Image> png = osgDB::readRefImageFile(path() + "/figure.png");
    ASSERT_TRUE(png);
    EXPECT_EQ(png->s(), 1800); // twice the page's 900
    const std::string first = readFile(folder.path() / "figure.png");
    std::filesystem::remove(folder.path() / "figure.png");
    EXPECT_EQ(runProgram("/usr/bin/env", {"gnuplot", "figure.gnuplot"}, folder.path()).status, 0);
    EXPECT_EQ(readFile(folder.path() / "figure.png"), first);
}

/// The group of the marker of the nth point: the shape is drawn twice, a white ground first.
TEST_F(FigureFiles, CatastrophesAreHollowAndNothingElseIs) {
    ChartPoint bad = chartPoint("Gnomon", "map", "size 512", 2, 4);
    bad.errors->catastrophes.allLit = true;
    const std::string blue = "color='rgb(  0, 114, 178)'"; // of the first technique, a circle: 5 hollow, 6 filled
    const auto shapes = [&](int shape) {
        const std::string text = svg();
        std::size_t found = 0;
        for (std::size_t at = 0;
             (at = text.find("#figure-gpPt" + std::to_string(shape) + "'", at)) != std::string::npos; ++at)
            found += holds(text.substr(at, text.find("/>", at) - at), blue);
        return found;
    };
    draw({chartPoint("Gnomon", "map", "size 512", 2, 4)});
    const std::size_t filledKey = 1, hollowKey = 1; // what the line below the title shows
    EXPECT_EQ(shapes(5), hollowKey);
    EXPECT_EQ(shapes(6), filledKey + 1);
    draw({bad});
    EXPECT_EQ(shapes(5), hollowKey + 1);
    EXPECT_EQ(shapes(6), filledKey);
}

TEST_F(FigureFiles, MarkersKnowWhatTheyStandFor) {
    draw({chartPoint("Gnomon", "map", "size 512", 2, 4), chartPoint("osgShadow", "ShadowMap", "best", 3, 5)});
    EXPECT_EQ(count(svg(), "class=\"point\""), 2u);
    EXPECT_TRUE(holds(svg(), "data-kit=\"osgShadow\" data-technique=\"ShadowMap\" data-setting=\"best\"><title>"
                             "osgShadow ShadowMap, best: 3 ms (3 to 3), 5 px</title>"));
    EXPECT_FALSE(holds(svg(), "onmousemove"));
    EXPECT_FALSE(holds(svg(), "id=\"gnuplot") || holds(svg(), "id='gp")); // ids are the figure's own
}

TEST_F(FigureFiles, TextIsNeverMarkupOrACommand) {
    const char* name = "a'\"`touch x`</text><script>{/Bold}$@\n${PANEL}";
    draw({chartPoint("Gnomon", name, name, 2, 4)});
    EXPECT_EQ(malformed("figure.svg"), "");
    EXPECT_FALSE(holds(svg(), "<script"));
    EXPECT_TRUE(holds(svg(), "a'\"`touch x`&lt;/text>&lt;script>{/Bold}$@ ${PANEL}"));
    EXPECT_EQ(folder.list().size(), 3u); // nothing was touched
}

TEST_F(FigureFiles, ZeroIsDrawnAtTheLeastValue) {
    draw({chartPoint("Gnomon", "map", "size 512", -1, 0)});
    EXPECT_TRUE(holds(readFile(folder.path() / "figure.gnuplot"), "\n0.01\t0.01\t7\t"));
}

TEST_F(FigureFiles, AQuartileBelowNothingDoesNotStretchTheAxis) {
    ChartPoint point = chartPoint("Gnomon", "map", "size 512", 2, 4);
    point.cost->steadyWall = {-3, 2, 500};
    draw({point});
    const std::string script = readFile(folder.path() / "figure.gnuplot");
    EXPECT_TRUE(holds(script, "set xrange [1.42857:6]")); // 2 / 1.4, and thrice 2: the least that an axis spans
    EXPECT_TRUE(holds(script, "\n2\t4\t1.42857\t6\t"));   // the bar ends where the axis does
}

TEST_F(FigureFiles, TheStaircaseGoesDownToTheRight) {
    draw({chartPoint("Gnomon", "map", "1", 2, 4), chartPoint("Gnomon", "map", "2", 8, 1)});
    const std::string script = readFile(folder.path() / "figure.gnuplot");
    const std::size_t at = script.find("$still_staircase");
    // From above the first to its error, along it to the second, down to that one's, along it to the end (8 × 1.4).
    EXPECT_TRUE(holds(script.substr(at, 80), "\n2\t5.6\n2\t4\n8\t4\n8\t1\n11.2\t1\n")) << script.substr(at, 80);
}

TEST_F(FigureFiles, NothingMeasuredIsAnEmptyChartAndNoFailure) {
    draw({});
    EXPECT_EQ(malformed("figure.svg"), "");
}

TEST_F(FigureFiles, WithoutGnuplotOneSentenceSaysSo) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    try {
        draw({chartPoint("Gnomon", "map", "size 512", 2, 4)});
        ADD_FAILURE();
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "the figures need gnuplot, which cannot be started. Install gnuplot-nox.");
    }
    setenv("PATH", path.c_str(), 1);
    EXPECT_TRUE(folder.list().empty());
}

TEST_F(FigureFiles, NoWrongPixelsAreNoBarsAndNoFailure) {
    ChartResults results;
    results.points = {chartPoint("Gnomon", "map", "size 512", 2, 4)};
    results.points[0].errors->certain = 4000;
    drawFigures(results, path());
    EXPECT_EQ(malformed("causes.svg"), "");
    EXPECT_TRUE(holds(svg("causes"), ">0 %<"));
}

TEST_F(FigureFiles, AFolderThatIsNotThereIsRefused) {
    const std::vector<ChartPoint> points = {chartPoint("Gnomon", "map", "size 512", 2, 4)};
    EXPECT_THROW(drawFigure(figureOf(points), CurveStyles({}), path() + "/gone"), std::runtime_error);
}

TEST_F(FigureFiles, AReportHasThemForAllScenesAndForEach) {
    ChartResults results = test::syntheticChart();
    results.scenes.resize(2);
    std::vector<std::string> names;
    for (const DrawnFigure& figure : drawFigures(results, path())) names.push_back(figure.name);
    EXPECT_EQ(names, (std::vector<std::string>{"figure", "causes", "figure-boxes", "causes-boxes", "figure-town",
                                               "causes-town"}));
    for (const std::string& name : names) EXPECT_EQ(malformed(name + ".svg"), "") << name;
    EXPECT_EQ(folder.list().size(), 3 * names.size());
}

TEST_F(FigureFiles, CausesAreSharesOfTheWrongPixels) {
    ChartPoint point = chartPoint("Gnomon", "map", "size 512", 2, 4);
    point.errors->causes.acne = 10;
    point.errors->causes.erosion = 30;
    point.errors->certain = 4000;
    ChartResults results;
    results.complete = true;
    results.points = {point};
    drawFigures(results, path());
    const std::string script = readFile(folder.path() / "causes.gnuplot");
    EXPECT_TRUE(
        holds(script, "\n12.5\t0.5\t0\t25\t0.14\t0.86\t0x9ecae1\n62.5\t0.5\t25\t100\t0.14\t0.86\t0xe8593c\nEOD"));
    EXPECT_TRUE(holds(script, "$shares << EOD\n1\t0.5\t0x0072b2\n")); // 40 of 4000 are 1 %
    EXPECT_TRUE(holds(svg("causes"), "1 %"));
}

} // namespace
