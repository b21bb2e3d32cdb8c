// SPDX-License-Identifier: MIT
// Causes that take long to find are looked for in the first two frames, and then in the frame after somebody has asked.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowReport.h>
#include <gnomon/ShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Notify>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace test;

namespace {

using Causes = std::vector<std::string>;

const Mesh tower = box({-0.5, -0.5, 0.0}, {0.5, 0.5, 2.0});
const View fromTheSide = perspective({-6.0, -9.0, 6.0}, {0.0, 0.0, 0.0}, 64, 48);

/// Counts how often its triangles are read, which takes long.
class CountedDome : public osg::Geometry {
public:
    CountedDome() {
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (const glm::dvec3& corner : insideOut(sphere({0.0, 0.0, 0.0}, 40.0, 16)))
            vertices->push_back(osg::Vec3d(corner.x, corner.y, corner.z));
        setVertexArray(vertices);
        addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(vertices->size())));
    }
    using osg::Geometry::accept;
    void accept(osg::PrimitiveFunctor& functor) const override {
        ++reads;
        osg::Geometry::accept(functor);
    }
    void accept(osg::PrimitiveIndexFunctor& functor) const override {
        ++reads;
        osg::Geometry::accept(functor);
    }
    mutable int reads = 0;
};

/// Draws nothing and keeps nothing, so that the kit alone reads the casters.
class Idle : public gnomon::ShadowTechnique {
public:
    std::vector<osg::ref_ptr<gnomon::Mark>> prepare(const gnomon::ViewFrame&, const gnomon::ShadowLight&,
                                                    const gnomon::Casters&) const override {
        return {};
    }
};

/// Counts how often it is asked which surfaces it shadows.
class CountedPlane : public gnomon::PlanarShadowNode {
public:
    CountedPlane() : gnomon::PlanarShadowNode(osg::Vec4d(0.0, 0.0, 1.0, 0.0)) {}
    bool shadowsSurface(const gnomon::ViewFrame& view, const osgUtil::RenderLeaf& leaf) const override {
        ++questions;
        return gnomon::PlanarShadowNode::shadowsSurface(view, leaf);
    }
    mutable int questions = 0;
};

/// A tower that moves, on its ground, under a camera that moves; a dome may stand about all.
struct Trial {
    explicit Trial(gnomon::ShadowTechnique* with) : scene(groundScene({})), technique(with) {
        mover->addChild(node(tower));
        scene.content->addChild(mover);
        domeNode->setName("dome");
        domeNode->addDrawable(dome);
        scene.addShadow(technique);
        camera = std::make_unique<Camera>(scene.root, fromTheSide);
    }
    /// Everything moves, and in each 10th frame a post comes.
    void frame() {
        const double angle = 0.01 * ++frames;
        camera->setView(perspective({-6.0 * std::cos(angle), -9.0, 6.0}, {0.0, 0.0, 0.0}, 64, 48));
        mover->setMatrix(osg::Matrixd::translate(angle, 0.0, 0.0));
        if (frames % 10 == 0)
            scene.content->addChild(node(box({-1.0, 0.1 * frames, 0.0}, {-0.9, 0.1 * frames + 0.1, 1.0})));
        camera->frame();
    }
    void draw(int count) {
        for (int i = 0; i < count; ++i) frame();
    }
    Causes reported() const { return technique->lastReport().causes; }

    Scene scene;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    osg::ref_ptr<CountedDome> dome = new CountedDome;
    osg::ref_ptr<osg::Geode> domeNode = new osg::Geode;
    std::unique_ptr<Camera> camera;
    int frames = 0;
};

bool namesDome(const Causes& causes) {
    for (const std::string& cause : causes)
        if (cause.find("is in the shadow of 'dome', which stands around it") != std::string::npos) return true;
    return false;
}

const Causes nothing;

} // namespace

TEST(SlowCauses, AreLookedForInTheFirstTwoFramesAndInTheOneAfterEachQuestion) {
    Trial trial(new Idle);
    trial.scene.content->addChild(trial.domeNode);
    trial.frame();
    const int first = trial.dome->reads;
    trial.frame();
    EXPECT_EQ(trial.dome->reads, first + 1) << "a tree in the second frame, too";
    trial.draw(200);
    EXPECT_EQ(trial.dome->reads, first + 1) << "with all that moved, and 20 casters that came";
    EXPECT_TRUE(namesDome(trial.technique->diagnose()));
    EXPECT_TRUE(namesDome(trial.technique->diagnose()));
    EXPECT_EQ(trial.dome->reads, first + 1) << "a question alone reads nothing";
    trial.draw(2);
    EXPECT_EQ(trial.dome->reads, first + 2) << "one frame looks";
}

TEST(SlowCauses, OfSurfacesAreLookedForInTheSameFrames) {
    const osg::ref_ptr<CountedPlane> plane = new CountedPlane;
    Trial trial(plane);
    trial.draw(2);
    const int first = plane->questions;
    EXPECT_GT(first, 0);
    trial.draw(200);
    EXPECT_EQ(plane->questions, first);
    plane->diagnose();
    trial.frame();
    EXPECT_GT(plane->questions, first);
}

TEST(SlowCauses, ThatWereFoundLastStayUntilAFrameLooksAgain) {
    Trial trial(new Idle);
    trial.draw(20);
    EXPECT_EQ(trial.technique->diagnose(), nothing);
    trial.scene.content->addChild(trial.domeNode);
    trial.frame();
    EXPECT_TRUE(namesDome(trial.reported())) << "the frame after a question looks";
    trial.scene.content->removeChild(trial.domeNode);
    trial.frame();
    EXPECT_TRUE(namesDome(trial.reported())) << "a report is no question";
    trial.frame();
    EXPECT_TRUE(namesDome(trial.technique->diagnose()));
    trial.frame();
    EXPECT_EQ(trial.technique->diagnose(), nothing);
}

TEST(SlowCauses, AreNotRepeatedWhereNothingCasts) {
    Trial trial(new Idle);
    trial.scene.content->addChild(trial.domeNode);
    trial.draw(2);
    trial.scene.group->setCasters({nullptr, 0u});
    trial.frame();
    const Causes causes = trial.technique->diagnose();
    ASSERT_EQ(causes.size(), 1u);
    EXPECT_NE(causes[0].find("nothing casts"), std::string::npos) << causes[0];
}

TEST(SlowCauses, AreWarnedOfOnceInTheFirstFramesWhereNobodyAsks) {
    struct Listener : osg::NotifyHandler {
        void notify(osg::NotifySeverity severity, const char* message) override {
            if (severity == osg::WARN) said.emplace_back(message);
        }
        Causes said;
    };
    const osg::ref_ptr<osg::NotifyHandler> before = osg::getNotifyHandler();
    const osg::ref_ptr<Listener> listener = new Listener;
    osg::setNotifyHandler(listener);
    Trial trial(new Idle);
    trial.scene.content->addChild(trial.domeNode);
    trial.draw(20);
    osg::setNotifyHandler(before);
    ASSERT_EQ(listener->said.size(), 1u);
    EXPECT_TRUE(namesDome(listener->said));
}
