// SPDX-License-Identifier: MIT
// What a technique says it did in a frame, and what OSG's statistics then hold.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowReport.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osg/Stats>

#include <algorithm>
#include <memory>

using gnomon::ShadowReport;
using test::Camera;
using test::Scene;

namespace {

const test::Mesh cube = test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});

test::View view() { return test::perspective({-7.0, -9.0, 7.0}, {0.0, 0.0, 0.0}, 160, 120); }

/// A cube under a transform on a ground, and a technique that has been asked before the first frame.
struct Trial {
    explicit Trial(gnomon::ShadowTechnique* given)
        : scene(test::groundScene({})), technique(given), mover(new osg::MatrixTransform) {
        mover->addChild(test::node(cube));
        mover->setDataVariance(osg::Object::DYNAMIC);
        scene.addShadow(given);
        scene.content->addChild(mover);
        technique->lastReport();
        camera = std::make_unique<Camera>(scene.root, view());
    }
    ShadowReport frame() {
        camera->frame();
        return technique->lastReport();
    }

    Scene scene;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    osg::ref_ptr<osg::MatrixTransform> mover;
    std::unique_ptr<Camera> camera;
};

/// Passes of the first frame, of two still ones, and of one after the cube has moved.
std::vector<unsigned> passesOf(gnomon::ShadowTechnique* technique) {
    Trial trial(technique);
    std::vector<unsigned> passes;
    for (int i = 0; i < 3; ++i) passes.push_back(trial.frame().passes);
    trial.mover->setMatrix(osg::Matrixd::translate(0.5, 0.0, 0.0));
    passes.push_back(trial.frame().passes);
    return passes;
}

double statistic(const osg::Stats& stats, unsigned frame, const std::string& name) {
    double value = -1.0;
    stats.getAttribute(frame, name, value);
    return value;
}

} // namespace

TEST(ShadowReport, CountsOnePassForAChangeAndNoneInAStillFrame) {
    const std::vector<unsigned> expected = {1, 0, 0, 1};
    EXPECT_EQ(passesOf(new gnomon::ShadowMapTechnique), expected);
    EXPECT_EQ(passesOf(new gnomon::ShadowVolumeTechnique), (std::vector<unsigned>{1, 0, 0, 2}))
        << "of what moves, and of what it leaves behind";
    EXPECT_EQ(passesOf(new gnomon::TracedShadowTechnique), expected);
    EXPECT_EQ(passesOf(test::planar()), (std::vector<unsigned>{0, 0, 0, 0}));
}

TEST(ShadowReport, HasNothingBeforeItIsAskedFor) {
    Scene scene = test::groundScene({cube});
    const osg::ref_ptr<gnomon::ShadowTechnique> technique = test::planar();
    scene.addShadow(technique);
    Camera camera(scene.root, view());
    camera.frame();
    ShadowReport report = technique->lastReport();
    EXPECT_EQ(report.frame, 0u);
    EXPECT_EQ(report.marks, 0u);
    EXPECT_EQ(report.cull, 0.0);
    camera.frame();
    report = technique->lastReport();
    EXPECT_EQ(report.frame, camera.viewer().getFrameStamp()->getFrameNumber());
    EXPECT_EQ(report.marks, 1u);
    EXPECT_GT(report.cull, 0.0);
    EXPECT_GT(report.draw, 0.0);
}

// The cube's shadow on the ground is the hull of its base and its roof, which the light at 45 degrees moves by 2 along x.
TEST(ShadowReport, ConfinesTheMarksToTheShadowOnTheScreen) {
    Trial trial(test::planar());
    const ShadowReport report = trial.frame();
    const osg::Matrixd clip =
        trial.camera->viewer().getCamera()->getViewMatrix() * trial.camera->viewer().getCamera()->getProjectionMatrix();
    osg::BoundingBoxd bounds;
    for (const double x : {-3.0, 1.0})
        for (const double y : {-1.0, 1.0}) bounds.expandBy(osg::Vec3d(x, y, 0.0) * clip);
    const double width = 80.0 * (bounds.xMax() - bounds.xMin()), height = 60.0 * (bounds.yMax() - bounds.yMin());
    EXPECT_GE(report.pixels, width * height * 0.999);
    EXPECT_LE(report.pixels, (width + 4.0) * (height + 4.0)) << "two pixels more to each side";
}

TEST(ShadowReport, CountsLightsAndWhatIsInSight) {
    Trial trial(new gnomon::ShadowMapTechnique);
    trial.frame();
    trial.scene.group->addLight(gnomon::ShadowLight{0, {1.0, 0.0, 1.0, 0.0}});
    trial.scene.group->addLight(gnomon::ShadowLight{1, {0.0, 1.0, 1.0, 0.0}});
    ShadowReport report = trial.frame();
    EXPECT_EQ(report.lights, 2u);
    EXPECT_EQ(report.marks, 2u);
    EXPECT_EQ(report.passes, 1u) << "of the light that came";
    trial.camera->setView(test::perspective({-7.0, -9.0, 7.0}, {-14.0, -18.0, 14.0}, 160, 120)); // at the sky
    report = trial.frame();
    EXPECT_EQ(report.marks, 0u);
    EXPECT_EQ(report.pixels, 0.0);
}

TEST(ShadowReport, TellsWhatWasChosenAndWhyAShadowIsMissing) {
    Trial trial(new gnomon::AutoShadowTechnique);
    const ShadowReport report = trial.frame();
    ASSERT_EQ(report.decisions.size(), 1u);
    EXPECT_EQ(report.decisions.front().chosen.spec, "volume");
    EXPECT_EQ(report.technique, "AutoShadowTechnique");
    EXPECT_EQ(report.causes, std::vector<std::string>());
    trial.scene.group->removeChild(trial.scene.content);
    EXPECT_EQ(trial.frame().causes.size(), 1u);
}

// Of the technique that is drawn, and of those that were.
TEST(ShadowReport, CountsThePassesOfWhatAutoHasChosen) {
    Trial trial(new gnomon::AutoShadowTechnique);
    trial.scene.content->addChild(test::node(test::box({-3.0, -1.5, 0.0}, {-2.0, 0.5, 0.5}))); // in the cube's shadow
    EXPECT_EQ(trial.frame().passes, 1u) << trial.technique->lastDecision().at(0).text();
    EXPECT_EQ(trial.frame().passes, 0u);
}

TEST(ShadowReport, AreThoseOfAllTechniquesOfAScene) {
    Trial trial(test::planar());
    trial.scene.group->addChild(new gnomon::ShadowMapTechnique);
    trial.scene.group->getChild(trial.scene.group->getNumChildren() - 1)->setNodeMask(0);
    gnomon::shadowReports(*trial.scene.root);
    trial.camera->frame();
    const std::vector<ShadowReport> reports = gnomon::shadowReports(*trial.scene.root);
    ASSERT_EQ(reports.size(), 2u);
    const auto frameOf = [&](const std::string& name) {
        const auto isIt = [&](const ShadowReport& report) { return report.technique == name; };
        return std::find_if(reports.begin(), reports.end(), isIt)->frame;
    };
    EXPECT_GT(frameOf("PlanarShadowNode"), 0u);
    EXPECT_EQ(frameOf("ShadowMapTechnique"), 0u) << "it is switched off";
}

TEST(ShadowReport, IsALineToRead) {
    ShadowReport report;
    report.technique = "PlanarShadowNode 'floor'";
    report.lights = 1;
    report.cull = 0.25;
    EXPECT_EQ(report.text(), "PlanarShadowNode 'floor': 1 light, 0 marks, 0 passes, cull 0.25 ms, draw 0 ms");
    report.marks = 2;
    report.pixels = 1234567.0;
    report.draw = 352.6;
    EXPECT_NE(report.text().find("2 marks within 1234567 pixels"), std::string::npos) << report.text();
    EXPECT_NE(report.text().find("draw 353 ms"), std::string::npos) << report.text();
}

TEST(ShadowStats, StandInThoseOfTheViewWhileTheCameraCollects) {
    Scene scene = test::groundScene({cube});
    scene.addShadow(test::planar());
    Camera camera(scene.root, view());
    const auto frame = [&] {
        camera.frame();
        return camera.viewer().getFrameStamp()->getFrameNumber();
    };
    const osg::Stats& viewers = *camera.viewer().getViewerStats();
    osg::Stats& cameras = *camera.viewer().getCamera()->getStats();
    EXPECT_EQ(statistic(viewers, frame(), "Shadow cull time taken"), -1.0) << "nobody asks";
    cameras.collectStats("rendering", true);
    const unsigned number = frame();
    const osg::Timer& timer =
        *osg::Timer::instance(); // without a window, OSG's own times count from the machine's start
    const double start = timer.delta_s(0, timer.getStartTick());
    EXPECT_EQ(statistic(viewers, number, "Shadow marks"), 1.0);
    for (const std::string what : {"cull", "draw"}) {
        const std::string name = "Shadow " + what + " ",
                          all = (what == "cull" ? "Cull" : "Draw") + std::string(" traversal ");
        const double begin = statistic(viewers, number, name + "begin time");
        const double end = statistic(viewers, number, name + "end time");
        EXPECT_NEAR(statistic(viewers, number, name + "time taken"), end - begin, 1e-9);
        EXPECT_GT(begin, statistic(cameras, number, all + "begin time") - start) << what << " lies within OSG's own";
        EXPECT_GT(end, begin);
        EXPECT_LT(end, statistic(cameras, number, all + "end time") - start) << what;
        EXPECT_EQ(statistic(cameras, number, name + "begin time"), begin);
    }
    cameras.collectStats("rendering", false);
    cameras.collectStats("gnomon", true);
    EXPECT_EQ(statistic(viewers, frame(), "Shadow marks"), 1.0);
}
