// SPDX-License-Identifier: MIT
// What is chosen automatically, that it is right, and that a still scene costs next to nothing.
#include "AutoTrial.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Program>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

using gnomon::AutoShadowTechnique;
using gnomon::ShadowDecision;
using test::box;
using test::Camera;
using test::Picture;
using test::Scene;
using Trial = test::AutoTrial;

namespace {

const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);
const test::Mesh cube = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
const test::Mesh beside = box({-1.0, -5.0, 0.0}, {1.0, -3.5, 1.0}); // no shadow of the cube's, none on it
const test::Mesh below = box({-3.0, -1.5, 0.0}, {-2.0, 0.5, 0.5});  // in the cube's shadow

/// They have many edges on their outlines: a map takes less while nothing moves. Where the light moves, it takes more, as they have
/// more triangles still.
test::Mesh balls(int count) {
    std::vector<test::Mesh> all;
    for (int i = 0; i < count; ++i) all.push_back(test::sphere({-1.5 + i % 2, -0.8 + 0.8 * (i / 2), 2.0}, 0.4, 100));
    return test::joined(all);
}

/// Without what relighting takes, which is the same for all.
struct BlendTrial : Trial {
    BlendTrial(const std::vector<test::Mesh>& casters, const gnomon::AutoShadowOptions& options = {})
        : Trial(casters, options) {
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    }
};

test::View view() { return test::perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 160, 120); }

/// Of that decision whose specification begins so.
std::optional<gnomon::ShadowCandidate> candidate(const ShadowDecision& of, const std::string& start) {
    for (const gnomon::ShadowCandidate& each : of.candidates)
        if (each.spec.rfind(start, 0) == 0) return each;
    return std::nullopt;
}

/// The same scene by a technique that is named.
Picture drawnBy(const std::string& spec, const std::vector<test::Mesh>& casters) {
    Scene scene = test::groundScene(casters, 8.0, sun);
    scene.addShadow(spec);
    return test::render(scene.root, view());
}

bool startsWith(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

} // namespace

TEST(Auto, TakesVolumesForCastersOfFewEdgesAndMapsForDenseOnes) {
    Trial plain({cube, below}, {0.5});
    BlendTrial dense({balls(8), below});
    const Picture picture = test::render(plain.scene.root, view());
    EXPECT_EQ(plain.chosen(), "volume") << plain.decision().reason;
    EXPECT_EQ(picture.different(drawnBy("volume", {cube, below})), 0);
    test::render(dense.scene.root, view());
    EXPECT_TRUE(startsWith(dense.chosen(), "map")) << dense.chosen();
    ASSERT_TRUE(candidate(dense.decision(), "volume"));
    EXPECT_GT(candidate(dense.decision(), "volume")->still, dense.decision().chosen.still);
    EXPECT_GT(candidate(dense.decision(), "volume")->moving, candidate(dense.decision(), "volume")->still)
        << "outlines are found again";
}

TEST(Auto, DrawsWhatRaysFindWhateverItChooses) {
    for (const std::vector<test::Mesh>& casters : {std::vector{cube, beside}, std::vector{cube, below}}) {
        const test::GroundTruth truth(casters, 8.0, sun, view());
        const auto drawn = [&](double error) {
            Trial trial(casters, {error});
            const Picture picture = test::render(trial.scene.root, view());
            EXPECT_TRUE(trial.decision().keepsBudget);
            return picture;
        };
        for (const double error : {1.0, 4.0}) EXPECT_LE(truth.edgesOffBy(drawn(error)), error);
        EXPECT_LT(test::shareOff(drawn(0.2), truth.lit, truth.dark, truth.truth),
                  test::shareOff(drawn(1.0), truth.lit, truth.dark, truth.truth));
    }
}

// The edges of a level plate's shadow go along the sides of the picture, or at 30 degrees to these. One ray a pixel, as volumes
// have it, is off by nearly half a pixel along the sides, wherever it begins.
TEST(Auto, KeepsAnErrorWhereEdgesGoAlongRowsOfPixels) {
    constexpr double error = 0.4, pixel = 0.05, off = 0.47 * pixel;
    const test::Mesh plate = test::quad({-1.0 + off, -1.0 + off, 3.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0});
    for (const double degrees : {0.0, 30.0}) {
        test::View from = test::fromAbove(100.0 * pixel, 200);
        from.view.postMultRotate(osg::Quat(osg::DegreesToRadians(degrees), osg::Z_AXIS));
        const test::GroundTruth truth({plate}, 8.0, sun, from);
        Trial trial({plate}, {error});
        EXPECT_LE(truth.edgesOffBy(test::render(trial.scene.root, from)), error) << degrees;
        EXPECT_TRUE(trial.decision().keepsBudget) << degrees;
        EXPECT_EQ(trial.chosen() == "volume", degrees > 0.0) << trial.chosen();
        Scene volume = test::groundScene({plate}, 8.0, sun);
        volume.addShadow("volume");
        EXPECT_EQ(truth.edgesOffBy(test::render(volume.root, from)) <= error, degrees > 0.0) << degrees;
    }
}

TEST(Auto, AsksForNoMoreThanTheErrorNeeds) {
    Trial coarse({cube, below}, {4.0}), fine({cube, below}, {0.2});
    test::render(coarse.scene.root, view());
    test::render(fine.scene.root, view());
    EXPECT_LT(coarse.decision().chosen.time, fine.decision().chosen.time);
    EXPECT_LE(fine.decision().chosen.error, 0.2);
    EXPECT_GT(coarse.decision().chosen.error, fine.decision().chosen.error);
}

// By what it says of itself; for the rule by hand see CandidateChoiceTest.cpp.
TEST(Auto, TakesTheMostAccurateOfThoseThatTakeUpToAQuarterMoreThanTheCheapest) {
    BlendTrial trial({balls(8), below}, {4.0});
    test::render(trial.scene.root, test::perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 640, 480));
    const ShadowDecision decision = trial.decision();
    double cheapest = decision.chosen.time;
    for (const gnomon::ShadowCandidate& each : decision.candidates)
        if (each.obstacle.empty() && each.error <= 4.0) cheapest = std::min(cheapest, each.time);
    EXPECT_LT(cheapest, decision.chosen.time) << "the scene has no such candidates";
    EXPECT_LE(decision.chosen.time, 1.25 * cheapest);
    int others = 0;
    for (const gnomon::ShadowCandidate& each : decision.candidates) {
        if (!each.obstacle.empty() || each.time > 1.25 * cheapest) continue;
        EXPECT_GE(1.05 * each.error, decision.chosen.error) << each.spec;
        if (each.error == decision.chosen.error) EXPECT_GE(each.moving, decision.chosen.moving) << each.spec;
        ++others;
    }
    EXPECT_GT(others, 3);
    EXPECT_EQ(decision.reason.rfind("the most accurate of those that keep 4 px and take hardly more", 0), 0u)
        << decision.reason;
}

TEST(Auto, DrawsTheSamePicturesInTwoRuns) {
    const auto run = [] {
        Trial trial({balls(4), below});
        Camera camera(trial.scene.root, view());
        std::vector<Picture> pictures;
        for (int i = 0; i < 40; ++i) {
            if (i > 20)
                trial.scene.light->getLight()->setPosition(osg::Vec4(1.0f, 0.4f + 0.01f * float(i), 1.2f, 0.0f));
            pictures.push_back(camera.frame());
        }
        return std::make_pair(pictures, trial.decision().text());
    };
    const auto first = run(), second = run();
    EXPECT_EQ(first.second, second.second);
    for (std::size_t i = 0; i < first.first.size(); ++i)
        EXPECT_EQ(first.first[i].different(second.first[i]), 0) << "frame " << i;
}

TEST(Auto, SaysWhichRowOfTheRuleFired) {
    Trial walls({cube, below}), none({});
    for (Trial* trial : {&walls, &none}) test::render(trial->scene.root, view());
    EXPECT_EQ(walls.decision().reason.rfind("the cheapest that keeps 1 px: its volumes have some ", 0), 0u)
        << walls.decision().reason;
    EXPECT_EQ(none.decision().reason, "none is needed: no shadow can fall on what is in sight");
}

TEST(Auto, SaysWhereNoTechniqueKeepsTheError) {
    Trial trial({cube, below}, {0.01});
    test::render(trial.scene.root, view());
    EXPECT_FALSE(trial.decision().keepsBudget);
    ASSERT_EQ(trial.technique->diagnose().size(), 1u);
    EXPECT_NE(trial.technique->diagnose().front().find("no technique keeps an error of 0.01 pixels here"),
              std::string::npos)
        << trial.technique->diagnose().front();
    for (const gnomon::ShadowCandidate& each : trial.decision().candidates)
        if (each.obstacle.empty()) EXPECT_GE(each.error * 1.06, trial.decision().chosen.error) << each.spec;
}

TEST(Auto, DrawsNothingWhereNoShadowCanBeSeen) {
    Trial bare({});
    test::render(bare.scene.root, view());
    EXPECT_EQ(bare.chosen(), "none") << bare.decision().reason;
    Trial away({cube});
    const test::View up = test::perspective({0.0, -9.0, 3.0}, {0.0, -18.0, 9.0}, 160, 120);
    Camera camera(away.scene.root, up);
    camera.frame();
    EXPECT_TRUE(away.chosen() == "none" || away.technique->lastDecision().empty()) << away.chosen();
    Trial tiny({box({-1e-3, -1e-3, 0.0}, {1e-3, 1e-3, 2e-3})});
    test::render(tiny.scene.root, view());
    EXPECT_EQ(tiny.chosen(), "none");
    EXPECT_NE(tiny.decision().reason.find("narrower than half a pixel"), std::string::npos);
    for (Trial* trial : {&bare, &away, &tiny}) EXPECT_EQ(trial->technique->diagnose(), std::vector<std::string>());
}

TEST(Auto, DrawsNothingWhereTheLightIsTooFaintToMissIt) {
    Trial trial({cube});
    osg::Light& light = *trial.scene.light->getLight();
    const auto shines = [&](float diffuse, float specular) {
        light.setDiffuse({diffuse, diffuse, 0.0f, 1.0f});
        light.setSpecular({specular, specular, 0.0f, 1.0f});
    };
    shines(1.0f / 255.0f, 0.0f);
    Camera camera(trial.scene.root, view());
    const auto chosen = [&] {
        camera.frame();
        return trial.chosen();
    };
    EXPECT_EQ(chosen(), "none");
    EXPECT_NE(trial.decision().reason.find("so faint that nobody could see its shadow"), std::string::npos);
    EXPECT_EQ(trial.technique->diagnose(), std::vector<std::string>());
    shines(1.0f / 255.0f, 1.5f / 255.0f);
    EXPECT_EQ(chosen(), "volume") << "both together can be seen, at once though nothing moves";
    shines(1.9f / 255.0f, 0.0f);
    EXPECT_EQ(chosen(), "none");
    trial.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_NE(chosen(), "none") << "a factor does not ask for the light";
    trial.scene.group->setComposite(gnomon::ShadowCasterGroup::RELIGHT);
    EXPECT_EQ(chosen(), "none");
    trial.scene.content->getOrCreateStateSet()->setAttributeAndModes(new osg::Program, osg::StateAttribute::OVERRIDE |
                                                                                           osg::StateAttribute::ON);
    EXPECT_NE(chosen(), "none") << "a program may make much of little light";
}

/// OpenGL divides what a lamp gives by its constant attenuation, if nothing else is set: 1 step by 0.1 makes 10. A sun's is the
/// same at any distance.
TEST(Auto, TakesALampForFaintOnlyIfItsAttenuationMakesNoMoreOfIt) {
    const auto chosenAt = [](const osg::Vec4d& place, float constant) {
        Trial trial({cube}, {}, 8.0, place);
        osg::Light& light = *trial.scene.light->getLight();
        light.setDiffuse({1.0f / 255.0f, 1.0f / 255.0f, 1.0f / 255.0f, 1.0f});
        light.setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        light.setConstantAttenuation(constant);
        Camera(trial.scene.root, view()).frame();
        return trial.chosen();
    };
    const osg::Vec4d lamp(3.0, 2.0, 9.0, 1.0);
    EXPECT_EQ(chosenAt(lamp, 1.0f), "none");
    EXPECT_NE(chosenAt(lamp, 0.1f), "none");
    EXPECT_EQ(chosenAt(sun, 1.0f), "none");
    EXPECT_EQ(chosenAt(sun, 0.1f), "none");
}

// 1.2 and 1.3 of 255 steps are 2.5 together: where both shadows fall, that can be seen.
TEST(Auto, CountsFaintLightsTogether) {
    Trial trial({cube});
    const osg::ref_ptr<osg::LightSource> other = new osg::LightSource(*trial.scene.light, osg::CopyOp::DEEP_COPY_ALL);
    other->getLight()->setLightNum(1);
    trial.scene.root->addChild(other);
    trial.scene.group->addLight(trial.scene.light);
    trial.scene.group->addLight(other);
    const auto shine = [](osg::LightSource& source, float strength) {
        source.getLight()->setDiffuse({strength, strength, strength, 1.0f});
        source.getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
    };
    shine(*trial.scene.light, 1.3f / 255.0f);
    shine(*other, 1.2f / 255.0f);
    Camera camera(trial.scene.root, view());
    const auto chosenOf = [&](int light) {
        for (const ShadowDecision& decision : trial.technique->lastDecision())
            if (decision.light == light) return decision.chosen.spec;
        return std::string("no decision");
    };
    camera.frame();
    EXPECT_EQ(chosenOf(0), "volume") << "the stronger one is drawn";
    EXPECT_EQ(chosenOf(1), "none") << "what is left is too faint";
    shine(*other, 0.6f / 255.0f);
    camera.frame();
    EXPECT_EQ(chosenOf(0), "none");
    EXPECT_EQ(chosenOf(1), "none");
}

TEST(Auto, ComparesTheCandidatesOfAStillSceneOnce) {
    for (const std::vector<test::Mesh>& casters : {std::vector{cube, beside}, std::vector{cube, below}}) {
        Trial trial(casters);
        Camera camera(trial.scene.root, view());
        for (int i = 0; i < 100; ++i) camera.viewer().frame();
        EXPECT_EQ(trial.decision().decisions, 1u);
        EXPECT_EQ(trial.decision().changes, 0u);
    }
}

// The first frame cannot know. Where things stand still a map is drawn once, where they move once a frame.
TEST(Auto, KnowsInTheThirdFrameWhatMovesFromTheStart) {
    BlendTrial trial({balls(8), below});
    Camera camera(trial.scene.root, view());
    std::vector<std::string> chosen;
    for (int i = 0; i < 3; ++i) {
        trial.scene.light->getLight()->setPosition(osg::Vec4(1.0f, 0.4f + 0.01f * float(i), 1.2f, 0.0f));
        camera.frame();
        chosen.push_back(trial.chosen());
    }
    const ShadowDecision last = trial.decision();
    double cheapest = last.chosen.moving;
    for (const gnomon::ShadowCandidate& each : last.candidates) {
        if (!each.obstacle.empty() || each.error > 1.0) continue;
        cheapest = std::min(cheapest, each.moving);
        if (each.spec == chosen[0]) EXPECT_GT(each.moving, 1.5 * last.chosen.moving) << "right at once by chance";
    }
    EXPECT_NE(chosen[0], chosen[2]);
    EXPECT_EQ(last.chosen.time, last.chosen.moving);
    EXPECT_LE(last.chosen.moving, 1.25 * cheapest);
    EXPECT_EQ(last.decisions, 2u);
}

TEST(Auto, ChangesNothingForASingleFrameOfMotion) {
    BlendTrial trial({balls(8), below});
    Camera camera(trial.scene.root, view());
    const auto draw = [&](int frames) {
        for (int i = 0; i < frames; ++i) camera.frame();
        return trial.chosen();
    };
    const std::string still = draw(70); // the next comparison may come at once
    trial.scene.light->getLight()->setPosition(osg::Vec4(1.0f, 0.41f, 1.2f, 0.0f));
    EXPECT_EQ(draw(60), still);
    EXPECT_EQ(trial.decision().changes, 0u);
    for (int i = 0; i < 60; ++i) {
        trial.scene.light->getLight()->setPosition(osg::Vec4(1.0f, 0.42f + 0.01f * float(i), 1.2f, 0.0f));
        camera.frame();
    }
    EXPECT_NE(trial.chosen(), still) << "by now it is known that the light moves on";
}

// The first decision may have taken long, and then nothing is compared again for up to 64 frames.
TEST(Auto, KnowsInTheNinthFrameOfMotionThatARestIsOver) {
    BlendTrial trial({balls(8), below});
    Camera camera(trial.scene.root, view());
    for (int i = 0; i < 5; ++i) camera.frame();
    const std::string still = trial.chosen();
    EXPECT_EQ(trial.decision().decisions, 1u);
    for (int i = 1; i <= 9; ++i) {
        EXPECT_EQ(trial.chosen(), still);
        trial.scene.light->getLight()->setPosition(osg::Vec4(1.0f, 0.4f + 0.01f * float(i), 1.2f, 0.0f));
        camera.frame();
    }
    EXPECT_NE(trial.chosen(), still);
    EXPECT_EQ(trial.decision().decisions, 2u);
}

TEST(Auto, ComparesAnewInTheNextFrameWhereSomethingElseIsAskedFor) {
    Trial trial({cube, below});
    Camera camera(trial.scene.root, view());
    const std::vector<std::pair<const char*, std::function<void()>>> changes = {
        {"receiver", [&] { trial.technique->setReceiver({test::find(*trial.scene.root, "ground")}); }},
        {"another receiver", [&] { trial.technique->setReceiver({trial.scene.content}); }},
        {"its mask",
         [&] {
             trial.technique->setReceiver({trial.scene.content, 1u});
         }},
        {"composite", [&] { trial.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND); }},
        {"error", [&] { trial.technique->setError(3.0); }},
        {"nothing", [] {}}};
    for (int i = 0; i < 3; ++i) camera.viewer().frame(); // by the second it is known who draws
    for (const auto& [what, change] : changes) {
        const unsigned before = trial.decision().decisions;
        change();
        for (int i = 0; i < 3; ++i) camera.viewer().frame();
        EXPECT_EQ(trial.decision().decisions, before + (std::string(what) == "nothing" ? 0u : 1u)) << what;
    }
}

TEST(AutoOptions, HaveAnErrorThatIsClampedAndZeroedWhereItIsNone) {
    const osg::ref_ptr<AutoShadowTechnique> technique = new AutoShadowTechnique;
    technique->setError(1e9);
    EXPECT_EQ(technique->getError(), gnomon::AutoShadowOptions::mostError);
    technique->setError(std::nan(""));
    EXPECT_EQ(technique->getError(), 0.0);
}
