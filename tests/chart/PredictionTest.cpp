// SPDX-License-Identifier: MIT
// What auto expects of its candidates, asked for a scene of the chart.
#include "SmallScene.h"

#include <gnomon/ShadowDecision.h>
#include <gnomon/ShadowSpec.h>

#include <gtest/gtest.h>

using namespace gnomon::examples;
using gnomon::ShadowCandidate;
using gnomon::ShadowSpec;

namespace {

/// auto's candidate that draws as a specification does.
ShadowCandidate candidateOf(const ChartScene& scene, const std::string& text) {
    const ShadowSpec spec = gnomon::parseShadowSpec(text);
    const bool blends = spec.composite == gnomon::ShadowCasterGroup::BLEND;
    const Contender chooser = gnomonContender(blends ? "auto:composite=blend" : "auto", Receives::EVERYTHING);
    StageViewer viewer(chooser.stage(scene, Look::SHADED), scene.camera, StageViewer::Colour::BYTES);
    viewer.draw();
    const std::vector<ShadowCandidate> all = viewer.staging().decisions().front().candidates;
    for (const int cascades : {spec.map.cascades, 1}) // where as many as the size asks for are one, that alone is there
        for (const ShadowCandidate& candidate : all) {
            const ShadowSpec its = gnomon::parseShadowSpec(candidate.spec);
            const bool sameMaps = its.map.size == spec.map.size && its.map.filter == spec.map.filter &&
                                  its.map.cascades == cascades && its.map.edges == spec.map.edges;
            if (candidate.obstacle.empty() && its.technique == spec.technique && sameMaps) return candidate;
        }
    ADD_FAILURE() << "auto has no candidate " << text;
    return {};
}

} // namespace

TEST(Predictions, KnowWhatIsCoarserAndWhatIsCheaper) {
    const auto of = [](const char* spec) { return candidateOf(test::smallScene(), spec); };
    EXPECT_GT(of("map:filter=nearest").error, of("map:edges=smooth").error);
    EXPECT_LT(of("map:filter=nearest").moving, of("map:edges=smooth").moving);
    EXPECT_LT(of("volume:composite=blend").flying, of("volume").flying);
}

// At street level the widest texel stands at the eye, where no edge is, and in a room all about it. Both are measured against
// rays. A factor of 1.5 is what auto promises of nine predictions in ten.
TEST(Predictions, OfMapsAreByTheEdgesThatAreSeen) {
    for (const char* name : {"street", "room"}) {
        const ChartScene scene = chartScene(name, 320, 240);
        const Yardstick yardstick(scene, false);
        for (const char* spec : {"map:filter=nearest,composite=blend,size=1024,cascades=1", "map"}) {
            const Contender contender = gnomonContender(spec, Receives::EVERYTHING);
            const auto measured = test::errorsOf(contender, scene, yardstick);
            const double predicted = candidateOf(scene, spec).error, edge = measured.boundary->p95;
            EXPECT_LT(predicted, 1.5 * edge) << name << ", " << spec;
            EXPECT_GT(predicted, edge / 1.5) << name << ", " << spec;
        }
    }
}
