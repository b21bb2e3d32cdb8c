// SPDX-License-Identifier: MIT
// What an automatic choice keeps from frame to frame, and what it tells of itself.
// A camera flies, and what is chosen automatically changes: how often, why, and that nobody sees it.
#include "AutoTrial.h"

#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/auto/Situation.h>

#include <gtest/gtest.h>
#include <osg/PolygonOffset>
#include <support/Picture.h>
#include <support/Scene.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace test;

namespace {

const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);
const Mesh cube = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});

View viewFrom(double x) { return perspective({x, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 160, 120); }

constexpr int frames = 600;
constexpr double budget = 1.0; // pixels, of the edge
constexpr int width = 160, height = 120;

/// 49 houses of several heights in streets.
std::vector<Mesh> town() {
    std::vector<Mesh> houses;
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x) {
            const double tall = 2.0 + (x * 5 + y * 3 + 30) % 7;
            houses.push_back(box({x * 6.0 - 1.5, y * 6.0 - 1.5, 0.0}, {x * 6.0 + 1.5, y * 6.0 + 1.5, tall}));
        }
    return houses;
}

View seen(const osg::Vec3d& eye, const osg::Vec3d& center) {
    return perspective(eye, center, width, height, 50.0, 0.3, 200.0);
}

/// In over the roofs, down into a street, along it, and up again.
View overTheTown(double at) {
    const double above = 1.7 + 22.0 * std::pow(std::cos(osg::PI * at), 2.0);
    const osg::Vec3d eye(2.9 + 0.05 * std::sin(20.0 * at), -30.0 + 60.0 * at, above);
    return seen(eye, eye + osg::Vec3d(0.2, 10.0, -0.35 * above));
}

View aroundTheModel(double at) {
    const double angle = 2.0 * osg::PI * at, away = 9.0 + 5.0 * std::sin(2.0 * angle);
    return seen({away * std::cos(angle), away * std::sin(angle), 4.0 + 2.0 * std::cos(angle)}, {0.0, 0.0, 1.0});
}

/// Pixels that are not alike in two pictures, with no other edge of brightness of the first within the two budgets of it.
int jumps(const Picture& before, const Picture& after) {
    constexpr int reach = int(2.0 * budget);
    int result = 0;
    const auto isEdge = [&](int x, int y) {
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx) {
                const int nx = std::clamp(x + dx, 0, width - 1), ny = std::clamp(y + dy, 0, height - 1);
                if (before.at(nx, ny) != before.at(x, y) && after.at(nx, ny) == before.at(nx, ny)) return true;
            }
        return false;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto a = int(before.at(x, y) & 0xffu), b = int(after.at(x, y) & 0xffu);
            result += std::abs(a - b) > 2 && !isEdge(x, y);
        }
    return result;
}

struct Flight {
    const char* name;
    std::vector<Mesh> casters;
    View (*at)(double);
    double half;
};

/// A frame by a technique that is named.
Picture drawnBy(const std::string& spec, const Flight& flight, const View& view) {
    Scene scene = groundScene(flight.casters, flight.half, sun);
    scene.addShadow(spec);
    return render(scene.root, view);
}

void fly(const Flight& flight) {
    const AutoTrial trial(flight.casters, {budget}, flight.half, sun);
    Camera camera(trial.scene.root, flight.at(0.0));
    std::string before;
    unsigned decisions = 0, changes = 0;
    for (int i = 0; i < frames; ++i) {
        const View view = flight.at(double(i) / frames);
        camera.setView(view);
        camera.viewer().frame();
        const auto all = trial.technique->lastDecision();
        if (all.empty()) continue; // nothing casts in this view
        const gnomon::ShadowDecision& now = all.front();
        decisions = now.decisions;
        if (!before.empty() && now.chosen.spec != before) {
            ++changes;
            EXPECT_FALSE(now.reason.empty());
            const int jumped = jumps(drawnBy(before, flight, view), drawnBy(now.chosen.spec, flight, view));
            std::cout << flight.name << ", frame " << i << ": " << before << " -> " << now.chosen.spec << ", "
                      << now.reason << "; " << now.chosen.error << " px; " << jumped << " pixels jump\n";
            EXPECT_LE(jumped, width * height / 1000) << before << " -> " << now.chosen.spec << " in frame " << i;
        }
        EXPECT_TRUE(now.keepsBudget) << now.reason;
        before = now.chosen.spec;
    }
    std::cout << flight.name << ": " << frames << " frames, " << decisions << " decisions, " << changes << " changes\n";
    EXPECT_GE(decisions, 7u) << "every 64 frames at least, also where the first one took long";
    EXPECT_LE(changes, 12u) << "two a second of a flight of ten seconds, and less";
    EXPECT_EQ(trial.technique->diagnose(), std::vector<std::string>());
}

} // namespace

// The decision for what is drawn late would hide the other.
TEST(AutoDecisions, AreToldOfAllKindsOfReceiversAndTheUsualOnesFirst) {
    AutoTrial trial({cube});
    const gnomon::AutoShadowTechnique& technique = *trial.technique;
    const auto add = [&trial](const Mesh& mesh) {
        const osg::ref_ptr<osg::Geode> geode = node(mesh);
        trial.scene.content->addChild(geode);
        return geode->getOrCreateStateSet();
    };
    add(box({-1.0, -5.0, 0.0}, {1.0, -3.5, 1.0}))->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    Camera camera(trial.scene.root, viewFrom(-7.0));
    camera.frame();
    const auto told = [&technique] {
        std::vector<std::string> all;
        for (const gnomon::ShadowDecision& each : technique.lastDecision())
            all.push_back(each.subject() + ": " + each.chosen.spec);
        return all;
    };
    EXPECT_EQ(told(), (std::vector<std::string>{"light 0: volume", "light 0, receivers drawn late: volume"}));
    EXPECT_EQ(technique.lastDecision().back().text().rfind("light 0, receivers drawn late: volume, predicted", 0), 0u);
    add(moved(square(0.5), {-2.5, -1.0, 0.001}))
        ->setAttributeAndModes(new osg::PolygonOffset(1.0f, 1.0f), osg::StateAttribute::ON);
    camera.frame();
    ASSERT_EQ(told().size(), 3u);
    EXPECT_EQ(technique.lastDecision()[0].receivers, "");
    EXPECT_EQ(technique.lastDecision()[1].receivers, "with a depth range or polygon offset");
    EXPECT_EQ(technique.lastDecision()[2].receivers, "drawn late");
    trial.scene.content->removeChildren(2, 2); // the box and the carpet
    camera.frame();
    EXPECT_EQ(told(), std::vector<std::string>{"light 0: volume"}) << "the others are of earlier frames";
}

// The casters' box is 16 by 16 by 2, and its diagonal 22.7. The eye is 7.1 away from it.
TEST(AutoDecisions, AreTakenInMotionOnceTheSituationHasChangedByAnEighth) {
    AutoTrial trial({cube});
    const osg::Vec3d eye(-7.0, -9.0, 9.0), center(-0.5, -0.5, 0.0);
    const double reach = std::sqrt(1.0 + 49.0) + 0.1 * std::sqrt(16.0 * 16.0 * 2.0 + 2.0 * 2.0), step = 0.02;
    const int enough = int(std::ceil(0.125 * reach / step)), parts = 3;
    Camera camera(trial.scene.root, perspective(eye, center, 160, 120));
    std::vector<int> taken;
    for (int i = 0; i < 160; ++i) {
        const osg::Vec3d way(step * i, 0.0, 0.0); // along the box
        camera.setView(perspective(eye + way, center + way, 160, 120));
        camera.viewer().frame();
        while (int(taken.size()) < int(trial.decision().decisions)) taken.push_back(i);
    }
    const int third = 2 + enough + parts - 1, fourth = third + enough + parts - 1;
    EXPECT_EQ(taken, (std::vector<int>{0, 2, third, fourth}));
}

TEST(Situation, ChangesByTheLargestShareOfAny) {
    gnomon::Situation then;
    then.eye = {0.0, 0.0, 11.0};
    then.ahead = {0.0, 0.0, -1.0};
    then.light = {0.0, 0.0, 1.0, 0.0};
    then.casters = {{-3.0, -4.0, 0.0}, {3.0, 4.0, 0.0}}; // its diagonal is 10
    then.lens = 2.0;
    then.seen = 10.0;
    EXPECT_EQ(then.changeTo(then), 0.0);
    const auto change = [&](const auto& act) {
        gnomon::Situation now = then;
        act(now);
        return then.changeTo(now);
    };
    EXPECT_NEAR(change([](auto& now) { now.eye.x() = 3.0; }), 3.0 / (11.0 + 1.0), 1e-12);
    EXPECT_NEAR(change([](auto& now) { now.lens = 2.5; }), 0.25, 1e-12);
    EXPECT_NEAR(change([](auto& now) { now.seen = 12.0; }), 0.2, 1e-12);
    EXPECT_NEAR(change([](auto& now) { now.casters._max.z() = 2.0; }), 0.2, 1e-12);
    EXPECT_NEAR(change([](auto& now) { now.ahead = {std::sin(0.01), 0.0, -std::cos(0.01)}; }), 0.01, 1e-6);
    EXPECT_NEAR(change([](auto& now) { now.light = {0.0, std::sin(0.01), std::cos(0.01), 0.0}; }), 0.01, 1e-6);
    then.light = {0.0, 0.0, 4.0, 1.0}; // a lamp
    EXPECT_NEAR(change([](auto& now) { now.light.y() = 1.0; }), 1.0 / (4.0 + 1.0), 1e-12);
}

TEST(AutoCandidate, TakesInEachFrameWhatIsDueToWhatMoves) {
    gnomon::ShadowWork millisecond;
    millisecond.calls = 1.0;
    millisecond.calls /= timeOf(millisecond, gnomon::llvmpipeRates);
    const auto taking = [&](double milliseconds) {
        gnomon::ShadowWork work;
        work.calls = milliseconds * millisecond.calls;
        return work;
    };
    gnomon::AutoCandidate candidate;
    candidate.still = taking(2.0);
    candidate.light = taking(10.0);
    candidate.casters = taking(4.0);
    candidate.view = taking(1.0);
    const gnomon::ShadowCandidate judged = candidate.judged(gnomon::llvmpipeRates, {0.5, 0.25, 0.125});
    EXPECT_NEAR(judged.still, 2.0, 1e-9);
    EXPECT_NEAR(judged.flying, 3.0, 1e-9);
    EXPECT_NEAR(judged.moving, 12.0, 1e-9);
    EXPECT_NEAR(judged.time, 8.125, 1e-9);
}

TEST(AutoFlight, OverAndThroughATownChangesSeldomAndUnseen) { fly({"town", town(), overTheTown, 40.0}); }

TEST(AutoFlight, AroundAModelChangesSeldomAndUnseen) {
    const Mesh arch = joined({box({-2.0, -1.0, 0.0}, {-1.2, 1.0, 2.4}), box({1.2, -1.0, 0.0}, {2.0, 1.0, 2.4}),
                              box({-2.0, -1.0, 2.4}, {2.0, 1.0, 3.0})});
    fly({"model", {arch, sphere({0.0, 0.0, 1.0}, 0.9, 60)}, aroundTheModel, 12.0});
}
