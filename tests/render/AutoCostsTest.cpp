// SPDX-License-Identifier: MIT
// What work takes: found once a renderer, kept in the user's cache, and corrected by what frames take.
#include "GlComplaints.h"
#include "GlSnapshot.h"

#include "../io/Program.h"

#include <support/Scene.h>

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/auto/FrameCosts.h>
#include <gnomon/auto/RendererCosts.h>
#include <gnomon/choice/RatioFile.h>
#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Notify>
#include <osg/Texture2D>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace fs = std::filesystem;
using namespace test;
using gnomon::RendererCosts;

namespace {

const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);
const Mesh cube = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});

/// What osg::notify() is given.
struct Notes : public osg::NotifyHandler {
    void notify(osg::NotifySeverity, const char* message) override { text += message; }
    std::string text;
};

/// One for the whole program: Mesa keeps shaders beside, and does not look where else they might be.
const fs::path& cacheOfAll() {
    static const gnomon::testing::TemporaryFolder folder;
    static const fs::path path = folder.path();
    return path;
}

/// Measured costs, as a user's program has them, with a cache of its own.
class AutoCosts : public testing::Test {
protected:
    AutoCosts() {
        fs::remove_all(cache / "gnomon");
        setenv("XDG_CACHE_HOME", cache.c_str(), 1);
        setenv("GNOMON_AUTO_RATES", "measured", 1);
        RendererCosts::forget();
        osg::setNotifyHandler(notes);
    }
    ~AutoCosts() override {
        osg::setNotifyHandler(new osg::StandardNotifyHandler);
        setenv("GNOMON_AUTO_RATES", "fixed", 1);
        unsetenv("XDG_CACHE_HOME");
        RendererCosts::forget();
    }
    /// Frames of a scene under automatic choice, in a program that knows nothing yet.
    gnomon::ShadowDecision draw(int frames = 2) {
        RendererCosts::forget();
        notes->text.clear();
        Scene scene = groundScene({cube}, 8.0, sun);
        const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
        scene.addShadow(technique);
        Camera camera(scene.root, perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 96, 72));
        for (int i = 0; i < frames; ++i) camera.frame();
        return technique->lastDecision().at(0);
    }
    std::vector<fs::path> kept() const {
        std::vector<fs::path> files;
        if (fs::is_directory(cache / "gnomon"))
            for (const auto& entry : fs::directory_iterator(cache / "gnomon")) files.push_back(entry.path());
        return files;
    }
    /// The time that fixed costs expect of a first frame. Measured ones are in the cache afterwards.
    double fixedThenMeasured() {
        setenv("GNOMON_AUTO_RATES", "fixed", 1);
        const double fixed = draw(1).chosen.still;
        setenv("GNOMON_AUTO_RATES", "measured", 1);
        draw();
        return fixed;
    }
    /// Leaves what a file begins with: kind and renderer.
    static void writeRatios(const fs::path& file, const gnomon::CostRatios& ratios) {
        std::ifstream in(file);
        std::string head, renderer;
        std::getline(in, head);
        std::getline(in, renderer);
        std::ofstream(file) << head << "\n" << renderer << "\n" << ratios.text();
    }
    static void writeTenfold(const fs::path& file, unsigned tests = gnomon::CostRatios::enoughTests) {
        writeRatios(file, {10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, tests});
    }
    long sentences() const { return std::count(notes->text.begin(), notes->text.end(), '\n'); }

    const fs::path& cache = cacheOfAll();
    const osg::ref_ptr<Notes> notes = new Notes;
};

std::string drawnBy(const gnomon::ShadowDecision& decision) {
    return decision.onTrial.empty() ? decision.chosen.spec : decision.onTrial;
}

/// Two boxes in whose shadows others stand, and what else a scene has.
struct Rivals {
    Rivals() : scene(groundScene({cube, box({-3.0, -1.5, 0.0}, {-2.0, 0.5, 0.5})}, 8.0, sun)) {
        scene.addShadow(technique);
    }
    bool isOnTrial() const { return !technique->lastDecision().at(0).onTrial.empty(); }
    std::string drawn() const { return drawnBy(technique->lastDecision().at(0)); }

    Scene scene;
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
};

View viewOfRivals() { return perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 96, 72); }

osg::ref_ptr<osg::Geode> board() {
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry({-1.5f, -3.0f, 3.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}));
    const osg::ref_ptr<osg::Image> white = new osg::Image;
    white->allocateImage(1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    white->setColor({1.0f, 1.0f, 1.0f, 1.0f}, 0u, 0u);
    geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(white));
    return geode;
}

/// What comes after a first frame finds in OpenGL.
GlSnapshot afterFrame(const char* rates) {
    setenv("GNOMON_AUTO_RATES", rates, 1);
    Scene scene = groundScene({cube}, 8.0, sun);
    scene.addShadow(new gnomon::AutoShadowTechnique);
    Camera camera(scene.root, perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 96, 72));
    const osg::ref_ptr<GlProbeCallback> end = new GlProbeCallback;
    camera.viewer().getCamera()->setFinalDrawCallback(end);
    const GlComplaints complaints(camera);
    camera.frame();
    EXPECT_EQ(complaints.all(), std::vector<std::string>());
    return end->seen();
}

} // namespace

TEST_F(AutoCosts, AreMeasuredWithoutATraceInOpenGl) {
    const GlSnapshot expected = afterFrame("fixed"), actual = afterFrame("measured");
    EXPECT_TRUE(RendererCosts::latest()) << "the self-test has run";
    EXPECT_EQ(difference(expected, actual), "");
}

TEST_F(AutoCosts, AreKeptInTheUsersCacheAndReadByTheNextProgram) {
    draw();
    ASSERT_EQ(kept().size(), 1u);
    ASSERT_TRUE(RendererCosts::latest());
    const double measured = RendererCosts::latest()->call / gnomon::CostRates().call;
    EXPECT_GT(measured, 0.05);
    EXPECT_LT(measured, 20.0);
    std::ifstream in(kept().front());
    std::string text(std::istreambuf_iterator<char>(in), {});
    const std::size_t from = text.find("\ncall ") + 6;
    text.replace(from, text.find('\n', from) - from, "7.5");
    text.replace(text.rfind('1'), 1, std::to_string(gnomon::CostRatios::enoughTests));
    std::ofstream(kept().front()) << text;
    draw();
    EXPECT_DOUBLE_EQ(RendererCosts::latest()->call, 7.5 * gnomon::CostRates().call) << "read, not measured again";
    EXPECT_EQ(notes->text, "");
}

// Other programs may have slowed the first test down.
TEST_F(AutoCosts, AreTheLeastThatTheFirstProgramsMeasure) {
    draw();
    ASSERT_EQ(kept().size(), 1u);
    for (unsigned tests = 1; tests < gnomon::CostRatios::enoughTests; ++tests) {
        writeTenfold(kept().front(), tests);
        draw();
        EXPECT_LT(RendererCosts::latest()->triangle, 5.0 * gnomon::CostRates().triangle) << tests;
        std::ifstream in(kept().front());
        const std::string text(std::istreambuf_iterator<char>(in), {});
        EXPECT_NE(text.find("\ntests " + std::to_string(tests + 1) + "\n"), std::string::npos) << text;
    }
}

TEST_F(AutoCosts, OfAnEarlierProgramCountInTheFirstFrame) {
    const double fixed = fixedThenMeasured();
    ASSERT_EQ(kept().size(), 1u);
    writeTenfold(kept().front());
    EXPECT_NEAR(draw(1).chosen.still, 10.0 * fixed, 1e-6 * fixed);
    EXPECT_EQ(draw(2).decisions, 1u) << "the renderer is the same, so that nothing is compared again";
}

TEST_F(AutoCosts, OfAnotherRendererGiveWayToItsOwnInTheSecondFrame) {
    const double fixed = fixedThenMeasured();
    ASSERT_EQ(kept().size(), 1u);
    const fs::path other = kept().front().parent_path() / "costs-0.txt";
    fs::rename(kept().front(), other);
    writeTenfold(other);
    EXPECT_NEAR(draw(1).chosen.still, 10.0 * fixed, 1e-6 * fixed);
    fs::last_write_time(other, fs::file_time_type::clock::now() + std::chrono::hours(1));
    const gnomon::ShadowDecision second = draw(2);
    EXPECT_EQ(second.decisions, 2u);
    EXPECT_GT(std::abs(second.chosen.still - 10.0 * fixed), 1e-3 * fixed) << "no two machines agree to a thousandth";
    EXPECT_EQ(kept().size(), 2u);
}

TEST_F(AutoCosts, AreMeasuredAnewWhereTheCacheIsBroken) {
    draw();
    ASSERT_EQ(kept().size(), 1u);
    std::ofstream(kept().front()) << "\xff\xfe nonsense";
    EXPECT_EQ(draw().chosen.spec, "planar");
    EXPECT_EQ(sentences(), 1) << notes->text;
    EXPECT_NE(notes->text.find("cannot be read as measured costs"), std::string::npos) << notes->text;
    std::ifstream in(kept().front());
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}).rfind("gnomon cost ratios 2\n", 0), 0u)
        << "it is whole";
}

TEST_F(AutoCosts, AreMeasuredEachTimeWhereTheCacheCannotBeWritten) {
    std::ofstream(cache / "gnomon") << "a file where the folder should be\n";
    EXPECT_EQ(draw().chosen.spec, "planar");
    EXPECT_TRUE(RendererCosts::latest());
    EXPECT_EQ(sentences(), 1) << notes->text;
    EXPECT_NE(notes->text.find("cannot be written, so the next program measures costs again"), std::string::npos);
}

TEST_F(AutoCosts, AreFixedWhereTheEnvironmentSaysSo) {
    setenv("GNOMON_AUTO_RATES", "fixed", 1);
    EXPECT_EQ(draw(12).measured, 0.0);
    EXPECT_FALSE(RendererCosts::latest());
    EXPECT_TRUE(kept().empty());
}

TEST_F(AutoCosts, TellWhatFramesTook) { EXPECT_GT(draw(12).measured, 0.0); }

// A rival is a kind that would be drawn if it took a third of what is predicted: a fifth less than what is drawn.
TEST_F(AutoCosts, AreFoundForRivalsByDrawingEachForSomeFrames) {
    draw(); // so that the cache is there from the first frame on
    RendererCosts::forget();
    Scene scene = groundScene({cube, box({-3.0, -1.5, 0.0}, {-2.0, 0.5, 0.5})}, 8.0, sun);
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    scene.addShadow(technique);
    Camera camera(scene.root, perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 96, 72));
    const auto kindOf = [](const std::string& spec) { return spec.substr(0, spec.find(':')); };
    std::set<std::string> expected, tried, seen;
    gnomon::ShadowDecision before;
    for (int i = 0; i < 160; ++i) {
        camera.frame();
        const gnomon::ShadowDecision now = technique->lastDecision().at(0);
        seen.insert(kindOf(drawnBy(now)));
        for (const gnomon::ShadowCandidate& each : now.candidates) {
            if (i == 1 && kindOf(each.spec) != kindOf(now.chosen.spec) && each.obstacle.empty() && each.error <= 1.0 &&
                each.time < 2.0 * now.chosen.time)
                expected.insert(kindOf(each.spec));
            if (each.spec == now.onTrial) EXPECT_LE(each.error, 1.0);
        }
        if (!now.onTrial.empty()) {
            EXPECT_EQ(now.chosen.spec, before.chosen.spec) << "the choice stays what it was";
            EXPECT_EQ(now.reason, before.reason);
            EXPECT_NE(now.text().find("; " + now.onTrial + " is on trial"), std::string::npos) << now.text();
            if (now.onTrial != before.onTrial)
                EXPECT_TRUE(tried.insert(kindOf(now.onTrial)).second) << now.onTrial << " was tried before";
        }
        before = now;
    }
    EXPECT_GE(expected.size(), 1u) << "the scene has no rivals";
    for (const std::string& kind : expected) EXPECT_EQ(seen.count(kind), 1u) << kind;
    EXPECT_GT(technique->lastDecision().at(0).measured, 0.0);
}

// Volumes and a map take more calls than a map alone, so that they are a rival here.
TEST_F(AutoCosts, OfARivalThatHasBecomeWrongAreNotAskedFor) {
    draw();
    ASSERT_EQ(kept().size(), 1u);
    gnomon::CostRatios dearCalls;
    dearCalls.call = 10.0;
    dearCalls.tests = gnomon::CostRatios::enoughTests;
    writeRatios(kept().front(), dearCalls);
    RendererCosts::forget();
    Rivals rivals;
    rivals.technique->setError(0.6);
    const osg::ref_ptr<osg::Geode> tested = board();
    tested->getOrCreateStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    rivals.scene.content->addChild(tested);
    Camera camera(rivals.scene.root, viewOfRivals());
    for (int i = 0; i < 10; ++i) camera.frame();
    EXPECT_EQ(rivals.drawn().rfind("map", 0), 0u) << rivals.drawn();
    tested->getStateSet()->removeAttribute(osg::StateAttribute::ALPHAFUNC);
    for (int i = 0; i < 10; ++i) {
        camera.frame();
        EXPECT_EQ(rivals.drawn().find('+'), std::string::npos) << "no caster is left for the map";
    }
}

// Another technique in the view takes time, too.
TEST_F(AutoCosts, OfRivalsAreNotAskedForWhereTheyCannotBeMeasured) {
    draw();
    RendererCosts::forget();
    for (const bool alone : {true, false}) {
        Rivals rivals;
        if (!alone) rivals.scene.addShadow(planar());
        Camera camera(rivals.scene.root, viewOfRivals());
        int onTrial = 0;
        for (int i = 0; i < 30; ++i) {
            camera.frame();
            onTrial += rivals.isOnTrial();
        }
        EXPECT_EQ(onTrial > 0, alone);
    }
}

// The eighth frame after the first one of motion compares the candidates: by what was known before the trial, if it broke it
// off.
TEST_F(AutoCosts, OfARivalAreFoundWhereMotionBeginsJustBefore) {
    draw();
    int inTime = 0;
    for (const int start : {1, 3, 5, 7, 9, 11}) {
        RendererCosts::forget();
        Rivals rivals;
        Camera camera(rivals.scene.root, viewOfRivals());
        std::vector<int> firsts, lengths;
        std::string before;
        for (int i = 0; i < 60; ++i) {
            if (i >= start) rivals.scene.light->getLight()->setPosition({1.0f, 0.4f + 0.002f * float(i), 1.2f, 0.0f});
            camera.frame();
            const std::string now = rivals.isOnTrial() ? rivals.drawn() : "";
            if (!now.empty() && now != before) firsts.push_back(i), lengths.push_back(0);
            if (!now.empty()) ++lengths.back();
            before = now;
        }
        for (std::size_t i = 0; i < firsts.size(); ++i) {
            EXPECT_EQ(lengths[i], 7) << "motion from frame " << start << ", a trial from frame " << firsts[i];
            inTime += firsts[i] < start + 8 && start + 8 < firsts[i] + 7;
        }
    }
    EXPECT_GT(inTime, 0) << "no trial was running in the ninth frame of motion";
}

TEST_F(AutoCosts, OfARivalWhoseTrialIsBrokenOffAreFoundLater) {
    draw();
    RendererCosts::forget();
    Rivals rivals;
    Camera camera(rivals.scene.root, viewOfRivals());
    camera.frame();
    for (int i = 0; i < 40 && !rivals.isOnTrial(); ++i) camera.frame();
    ASSERT_TRUE(rivals.isOnTrial());
    const auto kind = [&rivals] { return rivals.drawn().substr(0, rivals.drawn().find(':')); };
    const std::string rival = kind();
    rivals.technique->setError(0.99); // another budget is another choice
    camera.frame();
    ASSERT_FALSE(rivals.isOnTrial());
    bool found = false;
    for (int i = 0; i < 60; ++i) {
        camera.frame();
        found = found || kind() == rival;
    }
    EXPECT_TRUE(found) << rival << " is never drawn again";
}

// Something may change every few frames for good.
TEST_F(AutoCosts, OfARivalWhoseTrialsAreAllBrokenOffAreGivenUp) {
    draw();
    RendererCosts::forget();
    Rivals rivals;
    Camera camera(rivals.scene.root, viewOfRivals());
    std::map<std::string, int> trials;
    for (int i = 0; i < 200; ++i) {
        camera.frame();
        if (!rivals.isOnTrial()) continue;
        ++trials[rivals.drawn().substr(0, rivals.drawn().find(':'))];
        rivals.technique->setError(0.9 + 1e-4 * i); // another budget ends it in the next frame
    }
    EXPECT_FALSE(trials.empty());
    for (const auto& [kind, times] : trials) EXPECT_LE(times, 3) << kind;
}

TEST_F(AutoCosts, FollowFramesThatTakeLongerThanPredicted) {
    const osg::ref_ptr<gnomon::FrameCosts> costs = new gnomon::FrameCosts;
    gnomon::FrameCosts::Frame frame{
        gnomon::AutoCandidate::Kind::Volume, {}, 1.0, std::make_shared<std::atomic<double>>()};
    frame.work.calls = 2.0 / gnomon::CostRates().call; // 2 ms
    const unsigned before = costs->generation();
    for (int i = 0; i < 2; ++i) costs->add(frame, 5.0);
    EXPECT_EQ(costs->generation(), before);
    costs->add(frame, 5.0);
    EXPECT_GT(costs->generation(), before) << "candidates are compared again";
    EXPECT_DOUBLE_EQ(*frame.taken, 6.0);
    EXPECT_NEAR(costs->now().factors[std::size_t(frame.kind)].still, 3.0, 1e-9);
    EXPECT_NEAR(costs->now().factors[std::size_t(frame.kind)].moving, 3.0, 1e-9) << "nothing better is known";
    gnomon::AutoCandidate volume, map;
    volume.kind = gnomon::AutoCandidate::Kind::Volume;
    map.kind = gnomon::AutoCandidate::Kind::Map;
    volume.still = map.still = frame.work;
    EXPECT_NEAR(volume.time(costs->now(), {}), 6.0, 1e-9);
    EXPECT_NEAR(map.time(costs->now(), {}), 2.0, 1e-9) << "of one kind only";
}

// A map that is drawn each frame may be dearer than thought, though looking it up is cheaper.
TEST_F(AutoCosts, OfFramesInWhichThingsMoveAreFollowedApart) {
    const osg::ref_ptr<gnomon::FrameCosts> costs = new gnomon::FrameCosts;
    gnomon::FrameCosts::Frame still{gnomon::AutoCandidate::Kind::Map, {}, 0.0, std::make_shared<std::atomic<double>>()};
    still.work.calls = 2.0 / gnomon::CostRates().call; // 2 ms
    gnomon::FrameCosts::Frame moving = still;
    moving.moving = true;
    moving.work.calls += 3.0 / gnomon::CostRates().call;
    for (int i = 0; i < 5; ++i) costs->add(still, 1.0);
    gnomon::AutoCandidate map;
    map.kind = gnomon::AutoCandidate::Kind::Map;
    map.still = still.work;
    map.change.calls = 3.0 / gnomon::CostRates().call;
    EXPECT_NEAR(map.time(costs->now(), {1.0, 0.0}), 2.5, 1e-9) << "half of 5, before any such frame";
    const unsigned before = costs->generation();
    for (int i = 0; i < 3; ++i) costs->add(moving, 6.0);
    EXPECT_GT(costs->generation(), before);
    EXPECT_NEAR(map.time(costs->now(), {0.0, 0.0}), 1.0, 1e-9);
    EXPECT_NEAR(map.time(costs->now(), {1.0, 0.0}), 5.0, 1e-9) << "6 for 5 is let be";
    for (int i = 0; i < 5; ++i) costs->add(moving, 10.0);
    EXPECT_NEAR(map.time(costs->now(), {1.0, 0.0}), 10.0, 1e-9);
    EXPECT_NEAR(map.time(costs->now(), {0.5, 0.0}), 5.5, 1e-9);
}

TEST(AutoCandidate, OfMapsAloneAMovingViewChangesWhatWasDrawn) {
    gnomon::AutoCandidate volume, map;
    volume.kind = gnomon::AutoCandidate::Kind::Volume;
    map.kind = gnomon::AutoCandidate::Kind::Map;
    for (gnomon::AutoCandidate* each : {&volume, &map}) {
        each->still.calls = 2.0 / gnomon::CostRates().call; // 2 ms
        each->change.calls = 10.0 / gnomon::CostRates().call;
    }
    const gnomon::ShadowCandidate sides = volume.judged({}, {0.5, 0.5}), texels = map.judged({}, {0.5, 0.5});
    EXPECT_NEAR(sides.still, 2.0, 1e-9);
    EXPECT_NEAR(sides.flying, 2.0, 1e-9) << "outlines are the light's and the casters'";
    EXPECT_NEAR(sides.moving, 12.0, 1e-9);
    EXPECT_NEAR(sides.time, 7.0, 1e-9);
    EXPECT_GT(texels.flying, 3.0);
    EXPECT_LT(texels.flying, 4.0) << "one frame in seven, about";
    EXPECT_NEAR(texels.time, (texels.flying + texels.moving) / 2.0, 1e-9);
}
