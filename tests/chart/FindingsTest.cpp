// SPDX-License-Identifier: MIT
// What the page says in words, from points whose winners are plain to see.
#include "Findings.h"

#include <support/SyntheticChart.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace gnomon::examples;
using test::chartPoint;

ChartResults resultsOf(const std::vector<ChartPoint>& points) {
    ChartResults results;
    results.scenes.emplace_back().name = "boxes";
    results.scenes.back().title = "Boxes";
    results.points = points;
    return results;
}

SceneFinding stillOf(const std::vector<ChartPoint>& points) { return findings(resultsOf(points)).at(0); }

bool says(const SceneFinding& finding, const std::string& sentence) {
    const auto& all = finding.sentences;
    return std::find(all.begin(), all.end(), sentence) != all.end();
}

std::string allOf(const SceneFinding& finding) {
    std::string text;
    for (const std::string& sentence : finding.sentences) text += sentence + "\n";
    return text;
}

TEST(Findings, NameTheBestForTheirTime) {
    const SceneFinding finding =
        stillOf({chartPoint("Gnomon", "map", "size 512", 2, 4.2), chartPoint("Gnomon", "map", "size 1024", 3.14159, 2),
                 chartPoint("Gnomon", "planar", "defaults", 123.4, 0.456),
                 chartPoint("osgShadow", "ShadowMap", "defaults", 200, 50)});
    EXPECT_FALSE(finding.peerBeatsUs);
    EXPECT_EQ(allOf(finding), "The best for their time, from the fastest to the most accurate: map, size 512 (2 ms, "
                              "4.2 px); map, size 1024 (3.1 ms, 2 px); planar (123 ms, 0.46 px).\n");
}

TEST(Findings, SayPlainlyWhereAPeerBeatsUs) {
    const SceneFinding finding =
        stillOf({chartPoint("Gnomon", "map", "a", 2, 4), chartPoint("Gnomon", "map", "b", 9, 1),
                 chartPoint("osgShadow", "ShadowMap", "a", 3, 2), chartPoint("osgShadow", "ShadowMap", "b", 4, 1.5)});
    EXPECT_TRUE(finding.peerBeatsUs);
    EXPECT_TRUE(says(finding,
                     "A peer beats every Gnomon technique: osgShadow ShadowMap, a (3 ms, 2 px); osgShadow ShadowMap, b "
                     "(4 ms, 1.5 px). At equal or lower cost, the most accurate of Gnomon's is map, a (2 ms, 4 px)."))
        << allOf(finding);
}

TEST(Findings, SayWhereAPeerIsCheaperThanAll) {
    const SceneFinding finding =
        stillOf({chartPoint("Gnomon", "map", "a", 2, 4), chartPoint("osgShadow", "ShadowMap", "a", 1, 50)});
    EXPECT_TRUE(finding.peerBeatsUs);
    EXPECT_TRUE(says(finding, "A peer is cheaper than every Gnomon technique: osgShadow ShadowMap (1 ms, 50 px)."))
        << allOf(finding);
}

TEST(Findings, APeerAsGoodAsOursDoesNotBeatIt) {
    EXPECT_FALSE(
        stillOf({chartPoint("osgShadow", "ShadowMap", "", 2, 4), chartPoint("Gnomon", "map", "", 2, 4)}).peerBeatsUs);
}

/// Ours at 3 ms or 33 ms and 2.2 px.
TEST(Findings, TellPeersThatAreAheadByMoreThanRunsDifferBy) {
    struct Case {
        double ours, theirs, error;
        bool ahead;
    };
    const Case cases[] = {{3, 2.01, 2.01, false},   {3, 1.99, 2.01, true},   {3, 2.01, 1.99, true},
                          {33, 30.01, 2.01, false}, {33, 29.99, 2.01, true}, {33, 30.01, 1.99, true}};
    for (const Case& one : cases) {
        const auto all = findings(resultsOf({chartPoint("Gnomon", "map", "", one.ours, 2.2),
                                             chartPoint("osgShadow", "ShadowMap", "", one.theirs, one.error)}));
        EXPECT_TRUE(all[0].peerBeatsUs);
        EXPECT_EQ(all[0].peerIsAhead, one.ahead) << one.theirs << " ms, " << one.error << " px";
        EXPECT_EQ(says(all[0], "The lead is within the variation between runs: at most 1 ms or a tenth of the time, "
                               "and a tenth of the error."),
                  !one.ahead);
        const std::string summary = findingsSummary(all);
        EXPECT_EQ(summary.find("in none.") != std::string::npos, !one.ahead) << summary;
    }
}

TEST(Findings, NameOurTechniquesThatAreNeverWorthIt) {
    const SceneFinding finding =
        stillOf({chartPoint("Gnomon", "map", "a", 2, 1), chartPoint("Gnomon", "traced", "", 30, 3),
                 chartPoint("Gnomon", "box", "a", 1, 9), chartPoint("Gnomon", "box", "b", 4, 9),
                 chartPoint("osgShadow", "ShadowMap", "", 3, 2)});
    EXPECT_TRUE(
        says(finding, "Never worth it here, because at each setting a peer costs no more and errs no more: traced."))
        << allOf(finding); // of box only one setting is outdone
}

TEST(Findings, CatastrophesNeitherWinNorAreHidden) {
    ChartPoint black = chartPoint("osgShadow", "ShadowMap", "a", 1, 0.1), gone = chartPoint("Gnomon", "box", "", 1, 1);
    black.errors->catastrophes.allShadowed = true;
    gone.failure = "It crashed.";
    const SceneFinding finding =
        stillOf({black, gone, chartPoint("osgShadow", "ShadowMap", "b", 3, 9), chartPoint("Gnomon", "map", "", 2, 4)});
    EXPECT_FALSE(finding.peerBeatsUs);
    EXPECT_TRUE(says(finding, "Failed or catastrophic: osgShadow ShadowMap (1 of 2 settings); box.")) << allOf(finding);
}

TEST(Findings, WithNothingSoundOfOursAPeerWins) {
    ChartPoint ours = chartPoint("Gnomon", "map", "", 1, 1);
    ours.errors->catastrophes.allLit = true;
    const SceneFinding finding = stillOf({ours, chartPoint("osgShadow", "ShadowMap", "", 3, 2)});
    EXPECT_TRUE(says(
        finding, "No Gnomon technique gives a sound shadow here, but a peer does: osgShadow ShadowMap (3 ms, 2 px)."))
        << allOf(finding);
    ChartPoint theirs = chartPoint("osgShadow", "ShadowMap", "", 3, 2);
    theirs.errors->catastrophes.allLit = true;
    EXPECT_TRUE(says(stillOf({ours, theirs}), "No technique gives a sound shadow here."));
}

TEST(Findings, StillAndMovingLightAreJudgedApart) {
    ChartPoint cached = chartPoint("Gnomon", "map", "", 1, 2);
    cached.cost->movingWall = {9, 9, 9};
    const auto all = findings(resultsOf({cached, chartPoint("osgShadow", "ShadowMap", "", 3, 2)}));
    ASSERT_EQ(all.size(), 2u);
    EXPECT_FALSE(all[0].peerBeatsUs);
    EXPECT_TRUE(all[1].peerBeatsUs);
    EXPECT_EQ(findingsSummary(all),
              "In 1 of 2 cases (each scene with a still and with a moving light) a peer beats every "
              "Gnomon technique at some cost: boxes, moving light. The lead exceeds 1 ms and a tenth of the time, "
              "or a tenth of the error, in 1: boxes, moving light.");
}

TEST(Findings, AreNoneOfScenesWithoutPoints) {
    EXPECT_TRUE(findings(resultsOf({})).empty());
    const auto all =
        findings(resultsOf({chartPoint("Gnomon", "map", "", 1, 2), chartPoint("osgShadow", "ShadowMap", "", 3, 4)}));
    EXPECT_EQ(findingsSummary(all).substr(0, 50), "In none of 2 cases (each scene with a still and wi");
}

TEST(Findings, SayNothingOfWhoBeatsWhomWhereOneKitWasNotTimed) {
    ChartPoint untimed = chartPoint("osgShadow", "ShadowMap", "", 3, 4); // a run that ended before its race
    untimed.cost.reset();
    const ChartPoint ours = chartPoint("Gnomon", "map", "", 1, 2);
    EXPECT_TRUE(says(stillOf({ours, untimed}), "Only Gnomon's techniques were timed here, so there is no comparison."));
    EXPECT_TRUE(says(stillOf({untimed}), "Nothing was timed here."));
    EXPECT_FALSE(stillOf({chartPoint("osgShadow", "ShadowMap", "", 3, 4)}).peerBeatsUs);
    EXPECT_EQ(findingsSummary(findings(resultsOf({ours, untimed}))),
              "No scene is compared, because that needs timings of a Gnomon technique and of a peer.");
}

} // namespace
