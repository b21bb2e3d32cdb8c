// SPDX-License-Identifier: MIT
// What auto's model expects of fixed settings, asked for a small scene.
#include "SmallScene.h"

#include "Forecasts.h"

#include <support/Mesh.h>
#include <support/Picture.h>

#include <gtest/gtest.h>

using namespace gnomon::examples;
using gnomon::parseShadowSpec;
using gnomon::ShadowCandidate;

namespace {

std::vector<ShadowCandidate> candidatesOf(const std::vector<std::string>& specs) {
    std::vector<ShadowCandidate> all(specs.size());
    for (std::size_t i = 0; i < specs.size(); ++i) all[i].spec = specs[i];
    return all;
}

std::string found(const char* spec) {
    std::vector<ShadowCandidate> some = candidatesOf({"volume+map:size=512", "volume", "map:size=512",
                                                      "map:size=512,cascades=1", "map:size=2048,cascades=1", "hull"});
    some.front().mixed = true;
    const ShadowCandidate* candidate = candidateOf(some, parseShadowSpec(spec));
    return candidate ? candidate->spec : "";
}

/// What auto expects in the small scene.
std::optional<ChartPrediction> expectedOf(const char* spec, Receives receives = Receives::EVERYTHING) {
    static const ChartScene scene = test::smallScene();
    static Forecasts forecasts(scene);
    return forecasts.of(gnomonContender(spec, receives));
}

} // namespace

TEST(Forecasts, FindTheCandidateThatDrawsAsASettingDoes) {
    EXPECT_EQ(found("volume:composite=blend"), "volume");
    EXPECT_EQ(found("map:size=512"), "map:size=512");
    EXPECT_EQ(found("map:cascades=1,size=512"), "map:size=512,cascades=1");
    EXPECT_EQ(found("map:size=2048"), "map:size=2048,cascades=1") << "as many cascades as it asks for are one";
    EXPECT_EQ(found("map:size=2048,cascades=2"), "");
    EXPECT_EQ(found("map:size=512,edges=smooth"), "");
    EXPECT_EQ(found("hull"), "hull");
    EXPECT_EQ(found("auto"), "");
}

TEST(Forecasts, AreForAllSettingsThatAutoMightTake) {
    for (const char* spec : {"map", "map:size=512", "map:filter=nearest,composite=blend,cascades=1", "map:edges=smooth",
                             "volume", "volume:composite=blend", "traced"}) {
        const auto prediction = expectedOf(spec);
        ASSERT_TRUE(prediction) << spec;
        EXPECT_GT(prediction->error.value(), 0.0) << spec;
        EXPECT_GT(prediction->steady.time, 0.0) << spec;
        EXPECT_GE(prediction->moving.time, prediction->steady.time) << spec;
        EXPECT_EQ(prediction->spec, prediction->moving.spec);
    }
    EXPECT_FALSE(expectedOf("hull", Receives::TERRAIN)->error) << "others may get shadow, too";
    for (const char* spec : {"map:edges=soft", "map:size=1536", "auto", "planar"})
        EXPECT_FALSE(expectedOf(spec)) << spec;
    EXPECT_FALSE(expectedOf("box", Receives::TERRAIN));
    EXPECT_FALSE(expectedOf("hull")) << "no terrain receives alone";
}

TEST(Forecasts, KnowWhatIsCoarserAndWhatIsCheaper) {
    EXPECT_GT(expectedOf("map:filter=nearest")->error.value(), expectedOf("map:edges=smooth")->error.value());
    EXPECT_LT(expectedOf("map:filter=nearest")->moving.time, expectedOf("map:edges=smooth")->moving.time);
    EXPECT_LT(expectedOf("volume:composite=blend")->steady.time, expectedOf("volume")->steady.time);
}

// At street level the widest texel stands at the eye, where no edge is, and in a room all about it. Both are measured against
// rays. A factor of 1.5 is what auto promises of nine predictions in ten.
TEST(Forecasts, OfMapsAreByTheEdgesThatAreSeen) {
    for (const char* name : {"street", "room"}) {
        const ChartScene scene = chartScene(name, 320, 240);
        const Yardstick yardstick(scene, false);
        Forecasts forecasts(scene);
        for (const char* spec : {"map:filter=nearest,composite=blend,size=1024,cascades=1", "map"}) {
            const Contender contender = gnomonContender(spec, Receives::EVERYTHING);
            const auto measured = test::errorsOf(contender, scene, yardstick);
            const double predicted = forecasts.of(contender)->error.value(), edge = measured.boundary->p95;
            EXPECT_LT(predicted, 1.5 * edge) << name << ", " << spec;
            EXPECT_GT(predicted, edge / 1.5) << name << ", " << spec;
        }
    }
}
