// SPDX-License-Identifier: MIT
// Random scenes: no technique loses its shadow without a word; a fault's scene is made plain.
#include "RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>

namespace {

using namespace gnomon::examples;

constexpr unsigned inCi = 200; // of the 10,000 that gnomonchart --random 10000 draws

bool goOn(std::size_t, const std::string&) { return true; }

/// Each seed has 3 or more of them.
std::vector<Entrant> techniques(const std::set<std::string>& names) {
    std::vector<Entrant> all = stabilityContenders({}, false);
    const auto isOther = [&](const Entrant& each) { return !names.count(each.contender.technique); };
    all.erase(std::remove_if(all.begin(), all.end(), isOther), all.end());
    return all;
}

RandomSearch searchOf(unsigned count, std::vector<Entrant> contenders) {
    RandomSearch search;
    search.count = count;
    search.contenders = std::move(contenders);
    search.width = 96;
    search.height = 72;
    search.workers = std::max(1u, std::thread::hardware_concurrency());
    return search;
}

TEST(RandomScenes, NeverLoseAShadowWithoutAWord) {
    const RandomSearch search = searchOf(inCi, techniques({"planar", "map", "traced"}));
    EXPECT_EQ(searchRandomScenes(search, goOn, [](const RandomFault& fault) { ADD_FAILURE() << faultText(fault); }),
              inCi);
}

/// Before their faults were mended, 10015, 10036 and 10044 lost shadows in `map`, the last in `volume`, too.
TEST(RandomScenes, OfMoreKindsNeverLoseAShadowWithoutAWord) {
    RandomSearch search = searchOf(45, techniques({"map", "volume"}));
    search.first = firstOfMoreKinds;
    EXPECT_EQ(searchRandomScenes(search, goOn, [](const RandomFault& fault) { ADD_FAILURE() << faultText(fault); }),
              search.count);
}

TEST(RandomScenes, AreTheSameForTheSameSeed) {
    for (const unsigned seed : {1u, 7u, 10000u}) EXPECT_EQ(describe(randomScene(seed)), describe(randomScene(seed)));
    EXPECT_NE(describe(randomScene(1)), describe(randomScene(2)));
}

TEST(RandomScenes, AreOfEveryKind) {
    std::set<int> shapes, grounds, states;
    unsigned lamps = 0, broken = 0, nested = 0, far = 0, vast = 0, stray = 0;
    for (unsigned seed = 1; seed <= 500; ++seed) {
        const RandomScene scene = randomScene(seed);
        grounds.insert(int(scene.ground));
        lamps += scene.light.w == 1.0;
        far += scene.offset > 1e5;
        vast += scene.half > 100.0;
        stray += scene.stray > 0.0;
        for (const RandomCaster& caster : scene.casters) {
            shapes.insert(int(caster.shape));
            states.insert(int(caster.state));
            broken += caster.broken;
            nested += caster.transforms > 0;
        }
    }
    EXPECT_EQ(shapes.size(), 7u);
    EXPECT_EQ(states.size(), 18u);
    EXPECT_EQ(grounds.size(), 3u);
    for (const unsigned count : {lamps, broken, nested, far, vast, stray}) EXPECT_GT(count, 40u);
}

/// Backdrops, fractions of a pixel, casters whose vertices change, water, and roofs that a callback or a clip plane keeps from the
/// view: rays see all of these, or none.
TEST(RandomScenes, OfLaterSeedsHaveMoreKinds) {
    unsigned backdrops = 0, fractions = 0, edited = 0, water = 0, culled = 0, cut = 0;
    for (unsigned seed = firstOfMoreKinds; seed < firstOfMoreKinds + 500; ++seed) {
        const RandomScene scene = randomScene(seed);
        backdrops += scene.backdrop;
        fractions += scene.fraction > 0.0;
        culled += scene.roof == RandomScene::Roof::CULLED;
        cut += scene.roof == RandomScene::Roof::CUT;
        for (const RandomCaster& caster : scene.casters) {
            edited += caster.edited;
            water += describe(scene).find("of water") != std::string::npos;
        }
    }
    for (const unsigned count : {backdrops, fractions, edited, water, culled, cut}) EXPECT_GT(count, 30u);
}

/// A scene without shadows is as wrong with one box on level ground as with all else.
TEST(RandomScenes, OfAFaultAreMadeAsPlainAsTheyCanBe) {
    std::vector<RandomFault> faults;
    const auto keep = [&faults](const RandomFault& fault) { faults.push_back(fault); };
    searchRandomScenes(searchOf(6, {{plainContender()}}), goOn, keep);
    ASSERT_GT(faults.size(), 0u);
    for (const RandomFault& fault : faults) {
        EXPECT_EQ(fault.technique, "none");
        EXPECT_LE(fault.plainest.casters.size(), randomScene(fault.seed).casters.size());
        EXPECT_EQ(fault.plainest.offset, 0.0) << faultText(fault);
        EXPECT_EQ(fault.plainest.scale, 1.0) << faultText(fault);
        EXPECT_TRUE(isRandomFault(fault.cell));
    }
}

/// A search of hours that is ended has told what it found, and says how far it came.
TEST(RandomScenes, TellTheirFaultsBeforeTheSearchEnds) {
    RandomSearch search = searchOf(600, {{plainContender()}});
    search.batch = 4;
    std::size_t faults = 0;
    const auto count = [&faults](const RandomFault&) { ++faults; };
    const unsigned done = searchRandomScenes(
        search, [&](std::size_t, const std::string&) { return faults == 0; }, count);
    EXPECT_GT(faults, 0u);
    EXPECT_GE(done, search.batch);
    EXPECT_LT(done, search.count);
    EXPECT_EQ(done % search.batch, 0u);
}

TEST(RandomScenes, HavePlainerOnesUntilNothingIsLeftToTakeAway) {
    RandomScene scene = randomScene(5);
    for (int steps = 0;; ++steps) {
        const std::vector<RandomScene> plainer = simpler(scene);
        if (plainer.empty()) break;
        ASSERT_LT(steps, 200);
        scene = plainer.back();
    }
    ASSERT_EQ(scene.casters.size(), 1u);
    EXPECT_EQ(scene.casters[0].shape, 0);
    EXPECT_EQ(scene.casters[0].state, 0);
    EXPECT_EQ(scene.half, RandomScene().half);
    EXPECT_EQ(scene.ground, RandomScene::Ground::FLAT);
}

TEST(RandomFaults, AreLargeShadowsLostWithoutAWord) {
    StabilityCell cell;
    cell.measured = true;
    cell.everywhere.shadow = 201;
    cell.everywhere.iou = 0.49;
    EXPECT_TRUE(isRandomFault(cell));
    StabilityCell invented = cell; // where there is none
    invented.everywhere.shadow = 0;
    invented.everywhere.wrong = 201;
    invented.everywhere.iou = 0.0;
    EXPECT_TRUE(isRandomFault(invented));
    StabilityCell small = cell, said = cell, right = cell, elsewhere = cell;
    small.everywhere.shadow = 200;
    said.diagnosis = {"it says so."};
    right.everywhere.iou = 0.5;
    elsewhere.onReceiver = right.everywhere;
    for (const StabilityCell& fine : {small, said, right, elsewhere}) EXPECT_FALSE(isRandomFault(fine));
    StabilityCell remarked = cell; // which is no limit
    remarked.diagnosis = {"invalid triangles are left out: 3, the first in 'a'."};
    EXPECT_TRUE(isRandomFault(remarked));
    said.failure = "crashed";
    EXPECT_TRUE(isRandomFault(said));
}

} // namespace
