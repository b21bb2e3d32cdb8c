// SPDX-License-Identifier: MIT
// What is changed between two frames is seen in the next one, be it the 2nd, the 20th or the 500th.
#include "Trial.h"

#include <osg/MatrixTransform>

#include <functional>

using namespace test;

namespace {

const Mesh left = box({-2.0, -0.5, 0.0}, {-1.0, 0.5, 1.0}), right = box({1.0, -0.5, 0.0}, {2.0, 0.5, 1.0});

Trial casting(const std::vector<Mesh>& casters) {
    Trial trial;
    trial.casters = casters;
    trial.view = fromAbove(4.0, 64);
    return trial;
}

osg::Vec3Array& verticesOf(osg::Node& node) {
    return static_cast<osg::Vec3Array&>(*node.asGeode()->getDrawable(0)->asGeometry()->getVertexArray());
}

/// `change` just before a frame of a scene with the caster `left`: that frame shows the shadow of `casters`.
void expectSeenInFrame(int number, const std::function<void(Scene&)>& change, const std::vector<Mesh>& casters) {
    Scene scene = casting({left}).buildWithShadow();
    const View view = fromAbove(4.0, 64);
    Camera camera(scene.root, view);
    for (int frame = 1; frame < number - 1; ++frame) camera.viewer().frame();
    const Picture before = camera.frame();
    EXPECT_TRUE(shows(before, truthOf(casting({left}))));
    EXPECT_EQ(scene.group->revision(), 1u);
    change(scene);
    const Truth after = truthOf(casting(casters));
    EXPECT_FALSE(shows(before, after)); // the change is one that shows
    EXPECT_TRUE(shows(camera.frame(), after));
    EXPECT_EQ(scene.group->revision(), 2u);
    EXPECT_TRUE(shows(camera.frame(), after));
    EXPECT_EQ(scene.group->revision(), 2u);
}

/// Moves the caster from `left` to `right`.
void putATransformOver(Scene& scene) {
    osg::ref_ptr<osg::MatrixTransform> over = new osg::MatrixTransform(osg::Matrixd::translate(3.0, 0.0, 0.0));
    osg::ref_ptr<osg::Node> caster = find(*scene.root, "caster");
    scene.content->replaceChild(caster, over);
    over->addChild(caster);
}

osg::Geometry& geometryOf(osg::Node& node) { return *node.asGeode()->getDrawable(0)->asGeometry(); }

/// Draws, and hands out, one of two bodies within the bounds of both, as what poses itself does.
class Posing : public osg::Drawable {
public:
    Posing() { setUseDisplayList(false); }
    Posing(const Posing& other, const osg::CopyOp& copyOp) : osg::Drawable(other, copyOp), now(other.now) {}
    META_Object(test, Posing)

    void drawImplementation(osg::RenderInfo& info) const override { bodies[now]->drawImplementation(info); }
    bool supports(const osg::PrimitiveFunctor&) const override { return true; }
    void accept(osg::PrimitiveFunctor& functor) const override { bodies[now]->accept(functor); }
    osg::BoundingBox computeBoundingBox() const override {
        osg::BoundingBox all = bodies[0]->getBoundingBox();
        all.expandBy(bodies[1]->getBoundingBox());
        return all;
    }
    int now = 0;

private:
    const osg::ref_ptr<osg::Node> _nodes[2] = {node(left), node(right)};
    osg::Geometry* bodies[2] = {&geometryOf(*_nodes[0]), &geometryOf(*_nodes[1])};
};

GNOMON_BY_TECHNIQUE(Frame20);
GNOMON_BY_TECHNIQUE(Frame500);
GNOMON_BY_TECHNIQUE(MovedTransform);

} // namespace

TEST_P(Frame20, SeesAnArrayThatWasChangedAndDirtied) {
    expectSeenInFrame(20,
                      [](Scene& scene) {
                          osg::Vec3Array& vertices = verticesOf(*find(*scene.root, "caster"));
                          for (osg::Vec3& vertex : vertices) vertex.x() += 3.0f;
                          vertices.dirty();
                          find(*scene.root, "caster")->asGeode()->getDrawable(0)->dirtyGLObjects();
                      },
                      {right});
}

TEST_P(Frame20, SeesVerticesThatWereEditedAndTheirListReleased) {
    expectSeenInFrame(20,
                      [](Scene& scene) {
                          osg::Geometry& body = geometryOf(*find(*scene.root, "caster"));
                          for (osg::Vec3& vertex : static_cast<osg::Vec3Array&>(*body.getVertexArray()))
                              vertex.x() += 3.0f;
                          body.dirtyBound();
                          body.dirtyGLObjects();
                      },
                      {right});
}

TEST_P(Frame20, SeesWhatPosesItselfInsideItsBounds) {
    Scene scene = casting({}).buildWithShadow();
    const osg::ref_ptr<Posing> body = new Posing;
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(body);
    scene.content->addChild(geode);
    Camera camera(scene.root, fromAbove(4.0, 64));
    for (int frame = 1; frame < 20; ++frame) camera.viewer().frame();
    EXPECT_TRUE(shows(camera.frame(), truthOf(casting({left}))));
    body->now = 1;
    EXPECT_TRUE(shows(camera.frame(), truthOf(casting({right}))));
}

TEST_P(Frame20, SeesATransformPutOverACaster) { expectSeenInFrame(20, putATransformOver, {right}); }
TEST_P(Frame500, SeesATransformPutOverACaster) { expectSeenInFrame(500, putATransformOver, {right}); }

TEST_P(Frame20, SeesANewChild) {
    expectSeenInFrame(20, [](Scene& scene) { scene.content->addChild(node(right)); }, {left, right});
}

TEST_P(Frame20, SeesThatAChildIsGone) {
    expectSeenInFrame(20, [](Scene& scene) { scene.content->removeChild(find(*scene.root, "caster")); }, {});
}

TEST_P(Frame20, SeesAMaskThatHidesACaster) {
    expectSeenInFrame(20, [](Scene& scene) { find(*scene.root, "caster")->setNodeMask(0); }, {});
}

TEST_P(MovedTransform, IsFollowedInEveryFrame) {
    Scene scene = casting({}).buildWithShadow();
    osg::ref_ptr<osg::MatrixTransform> over = new osg::MatrixTransform;
    over->addChild(node(left));
    scene.content->addChild(over);
    Camera camera(scene.root, fromAbove(4.0, 64));
    for (int frame = 1; frame <= 5; ++frame) {
        over->setMatrix(osg::Matrixd::translate(0.5 * frame, 0.0, 0.0));
        EXPECT_TRUE(shows(camera.frame(), truthOf(casting({moved(left, {0.5 * frame, 0.0, 0.0})}))));
    }
    EXPECT_EQ(scene.group->revision(), 5u);
}

TEST(Setting, OfTheCompositeAndItsFactorTakesEffectInTheNextFrame) {
    const Trial trial = casting({left});
    const Truth truth = truthOf(trial);
    Scene scene = trial.buildWithShadow();
    Camera camera(scene.root, trial.view);
    EXPECT_TRUE(shows(camera.frame(), truth));
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    for (const float dark : {0.0f, 0.5f, 1.0f}) {
        scene.group->setDark(dark);
        const auto expected = static_cast<unsigned>(dark * litGround);
        EXPECT_EQ(camera.frame().count(expected), // 228, 114 and 0 are exact; with 1 all the ground is as lit
                  dark == 1.0f ? truth.lit.count(litGround) : truth.shadowPixels());
    }
    scene.group->setComposite(gnomon::ShadowCasterGroup::RELIGHT);
    EXPECT_TRUE(shows(camera.frame(), truth));
}

TEST(Setting, OfThePlanesTakesEffectInTheNextFrame) {
    const Trial trial = casting({left});
    const Truth truth = truthOf(trial);
    Scene scene = trial.build();
    osg::ref_ptr<gnomon::PlanarShadowNode> technique = new gnomon::PlanarShadowNode;
    scene.addShadow(technique);
    Camera camera(scene.root, trial.view);
    EXPECT_TRUE(same(camera.frame(), truth.lit));
    technique->addPlane({0.0, 0.0, 1.0, 0.0});
    EXPECT_TRUE(shows(camera.frame(), truth));
    technique->setPlanes({{0.0, 0.0, 1.0, -0.5}}); // half as high as the box, where nothing receives
    EXPECT_TRUE(same(camera.frame(), truth.lit));
    technique->setPlanes({{0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 1.0, -0.5}});
    EXPECT_TRUE(shows(camera.frame(), truth));
}

TEST(Setting, OfTheCastersTakesEffectInTheNextFrame) {
    const Trial both = casting({left, right});
    Scene scene = both.buildWithShadow();
    Camera camera(scene.root, both.view);
    const Truth truth = truthOf(both);
    EXPECT_TRUE(shows(camera.frame(), truth));
    scene.group->setCasters({find(*scene.root, "caster")});
    Truth one = truth;
    one.mask = castRays(square(8.0), {left}, both.light, both.view);
    for (std::size_t i = 0; i < one.mask.pixels.size(); ++i) // seen as before, though it casts nothing now
        if (truth.mask.pixels[i] == Seen::Caster) one.mask.pixels[i] = Seen::Caster;
    EXPECT_TRUE(shows(camera.frame(), one));
    scene.group->setCasters({nullptr, 0u});
    EXPECT_TRUE(same(camera.frame(), one.lit));
    scene.group->setCasters({});
    EXPECT_TRUE(shows(camera.frame(), truth));
}

TEST(Setting, OfTheReceiverTakesEffectInTheNextFrame) {
    const Trial trial = casting({left});
    const Truth truth = truthOf(trial);
    Scene scene = trial.build();
    const osg::ref_ptr<gnomon::PlanarShadowNode> technique = planar();
    scene.addShadow(technique);
    Camera camera(scene.root, trial.view);
    EXPECT_TRUE(shows(camera.frame(), truth));
    technique->setReceiver({find(*scene.root, "caster")});
    EXPECT_TRUE(same(camera.frame(), truth.lit));
    technique->setReceiver({find(*scene.root, "ground")});
    EXPECT_TRUE(shows(camera.frame(), truth));
    technique->setReceiver({});
    EXPECT_TRUE(shows(camera.frame(), truth));
}

TEST(Setting, OfTheLightTakesEffectInTheNextFrame) {
    const Trial trial = casting({left});
    Trial lamp = trial;
    lamp.light = {0.0, 1.0, 3.0, 1.0};
    Scene scene = trial.buildWithShadow();
    Camera camera(scene.root, trial.view);
    EXPECT_TRUE(shows(camera.frame(), truthOf(trial)));
    scene.light->getLight()->setPosition(osg::Vec4(lamp.light));
    EXPECT_TRUE(shows(camera.frame(), truthOf(lamp)));
    scene.light->getLight()->setPosition(osg::Vec4(trial.light));
    EXPECT_TRUE(shows(camera.frame(), truthOf(trial)));
}
