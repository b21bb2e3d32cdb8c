// SPDX-License-Identifier: MIT
// Nothing to remember: any camera, any place in the graph, the first frame, with or without a viewer.
#include "Trial.h"
#include <support/Causes.h>

#include <osg/MatrixTransform>
#include <osg/Switch>
#include <osgUtil/SceneView>
#include <osgViewer/CompositeViewer>

#include <memory>

using namespace test;

namespace {

constexpr int size = 128;

Trial boxOnGround(const osg::Vec4d& light = {1.0, 0.5, 1.0, 0.0}) {
    Trial trial;
    trial.casters = {box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}), sphere({1.5, 1.0, 1.0}, 0.75, 16)};
    trial.light = light;
    trial.view = fromAbove(4.0, size);
    return trial;
}

View slanting() { return perspective({-6.0, -7.0, 5.0}, {0.0, 0.0, 0.0}, size, size); }

/// One cull and one draw without a viewer, an update traversal or a frame number.
class BareView {
public:
    BareView(osg::Node* root, const View& view) {
        _context.graphicsContext()->realize();
        _sceneView->setDefaults(osgUtil::SceneView::NO_SCENEVIEW_LIGHT);
        _sceneView->getGlobalStateSet()->setGlobalDefaults(); // the depth test among them, as every osgViewer has it
        _sceneView->setState(_context.graphicsContext()->getState());
        _sceneView->setViewport(0, 0, view.width, view.height);
        _sceneView->setViewMatrix(view.view);
        _sceneView->setProjectionMatrix(view.projection);
        _sceneView->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        _sceneView->setCullingMode(_sceneView->getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
        _sceneView->setClearColor({0.0f, 0.0f, 0.25f, 1.0f});
        _sceneView->setSceneData(root);
    }
    ~BareView() {
        _context.graphicsContext()->makeCurrent();
        _sceneView->releaseAllGLObjects();
        _context.graphicsContext()->releaseContext();
    }
    Picture draw() {
        _context.graphicsContext()->makeCurrent(); // other viewers of a test let go of theirs
        _sceneView->cull();
        _sceneView->draw();
        return pictureOf(_context);
    }

private:
    gnomon::HeadlessContext _context{size, size};
    osg::ref_ptr<osgUtil::SceneView> _sceneView = new osgUtil::SceneView;
};

void addView(osgViewer::CompositeViewer& viewer, const gnomon::HeadlessContext& context, osg::Node* root,
             const View& view, int left) {
    osg::ref_ptr<osgViewer::View> added = new osgViewer::View;
    added->setLightingMode(osg::View::NO_LIGHT);
    osg::Camera& camera = *added->getCamera();
    context.attach(camera, new osg::Viewport(left, 0, view.width, view.height));
    settle(camera, view);
    added->setSceneData(root);
    viewer.addView(added);
}

GNOMON_BY_TECHNIQUE(SceneView);
GNOMON_BY_TECHNIQUE(CompositeViewer);
GNOMON_BY_TECHNIQUE(NestedCamera);
GNOMON_BY_TECHNIQUE(Technique);
GNOMON_BY_TECHNIQUE(TwoGroups);

} // namespace

TEST_P(SceneView, WithoutAnUpdateAViewOrAFrameNumberShowsTheShadowAtOnce) {
    for (const View& view : {fromAbove(4.0, size), slanting()}) {
        Trial trial = boxOnGround();
        trial.view = view;
        const Scene scene = trial.buildWithShadow();
        BareView bare(scene.root, view);
        EXPECT_TRUE(shows(bare.draw(), truthOf(trial)));
        EXPECT_TRUE(shows(bare.draw(), truthOf(trial)));
    }
}

TEST(PlanarInASceneView, WithoutAFrameNumberForgetsCausesThatAreGone) {
    const Trial trial = boxOnGround();
    Scene scene = trial.build();
    osg::ref_ptr<gnomon::PlanarShadowNode> technique = new gnomon::PlanarShadowNode;
    scene.addShadow(technique);
    BareView bare(scene.root, trial.view);
    bare.draw();
    EXPECT_EQ(technique->diagnose().size(), 1u);
    technique->addPlane({0.0, 0.0, 1.0, 0.0});
    EXPECT_TRUE(shows(bare.draw(), truthOf(trial)));
    EXPECT_EQ(causesButLitSurfaces(*technique), std::vector<std::string>()) << "the ball's shadow falls on the box";
}

TEST(PlanarInTwoViewers, ThatCountAlikeForgetsTheOthersCauses) {
    const Trial trial = boxOnGround();
    Scene scene = trial.build();
    osg::ref_ptr<gnomon::PlanarShadowNode> technique = new gnomon::PlanarShadowNode;
    scene.addShadow(technique);
    auto first = std::make_unique<Camera>(scene.root, trial.view),
         second = std::make_unique<Camera>(scene.root, trial.view);
    const auto causes = [&](Camera& camera) {
        camera.frame();
        return causesButLitSurfaces(*technique).size(); // the ball's shadow falls on the box
    };
    EXPECT_EQ(causes(*first), 1u);
    technique->addPlane({0.0, 0.0, 1.0, 0.0});
    EXPECT_EQ(causes(*second), 0u);
    ASSERT_EQ(first->viewer().getFrameStamp()->getFrameNumber(), second->viewer().getFrameStamp()->getFrameNumber());
    technique->setPlanes({});
    EXPECT_EQ(causes(*second), 1u);
    technique->addPlane({0.0, 0.0, 1.0, 0.0});
    EXPECT_EQ(causes(*first), 0u);
}

/// The second view sees the plane from behind, the first one does not.
TEST(PlanarInTwoViews, TellsTheCausesOfBoth) {
    const Trial trial = boxOnGround();
    Scene scene = trial.build();
    const osg::ref_ptr<gnomon::PlanarShadowNode> technique = planar();
    scene.addShadow(technique);
    for (const bool behindFirst : {true, false}) {
        const gnomon::HeadlessContext context(2 * size, size);
        osgViewer::CompositeViewer viewer;
        viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        const View behind = perspective({0.0, -5.0, -5.0}, {0.0, 0.0, 0.0}, size, size);
        addView(viewer, context, scene.root, behindFirst ? behind : trial.view, 0);
        addView(viewer, context, scene.root, behindFirst ? trial.view : behind, size);
        for (int frame = 0; frame < 2; ++frame) {
            viewer.frame();
            EXPECT_EQ(causesButLitSurfaces(*technique).size(), 1u);
        }
    }
}

TEST_P(CompositeViewer, ShowsAnOrthographicAndAPerspectiveViewInItsFirstFrame) {
    for (const osg::Vec4d& light : {osg::Vec4d(1.0, 0.5, 1.0, 0.0), osg::Vec4d(3.0, 1.0, 4.0, 1.0)}) {
        SCOPED_TRACE(light.w());
        Trial above = boxOnGround(light), slant = boxOnGround(light);
        slant.view = slanting();
        const Scene scene = above.buildWithShadow();
        const gnomon::HeadlessContext context(2 * size, size);
        osgViewer::CompositeViewer viewer;
        viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        addView(viewer, context, scene.root, above.view, 0);
        addView(viewer, context, scene.root, slant.view, size);
        for (int frame = 0; frame < 2; ++frame) {
            viewer.frame();
            EXPECT_TRUE(shows(pictureOf(context, 0, size), truthOf(above)));
            EXPECT_TRUE(shows(pictureOf(context, size, size), truthOf(slant)));
        }
    }
}

TEST_P(NestedCamera, ShowsTheShadowWhereverItsLightStands) {
    const Trial trial = boxOnGround();
    for (const auto order : {osg::Camera::NESTED_RENDER, osg::Camera::POST_RENDER})
        for (const bool lightInside : {true, false}) {
            SCOPED_TRACE(testing::Message() << "order " << order << (lightInside ? " light inside" : " light outside"));
            const Scene scene = trial.buildWithShadow();
            osg::ref_ptr<osg::Camera> camera = new osg::Camera;
            camera->setRenderOrder(order);
            camera->setReferenceFrame(osg::Transform::RELATIVE_RF);
            camera->setClearMask(order == osg::Camera::POST_RENDER ? GL_DEPTH_BUFFER_BIT : 0);
            scene.root->replaceChild(scene.group, camera);
            camera->addChild(scene.group);
            if (lightInside) {
                scene.root->removeChild(scene.light);
                camera->addChild(scene.light);
            }
            EXPECT_TRUE(shows(render(scene.root, trial.view), truthOf(trial)));
        }
}

TEST_P(NestedCamera, OfItsOwnFrameShowsTheShadow) {
    const Trial trial = boxOnGround();
    const Scene scene = trial.buildWithShadow();
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setViewport(0, 0, size, size);
    settle(*camera, trial.view);
    camera->setRenderOrder(osg::Camera::POST_RENDER);
    camera->addChild(scene.root);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(camera);
    EXPECT_TRUE(shows(render(root, slanting()), truthOf(trial)));
}

TEST_P(Technique, UnderASwitchCastsWhileItIsOn) {
    const Trial trial = boxOnGround();
    const Truth truth = truthOf(trial);
    Scene scene = trial.buildWithShadow();
    osg::ref_ptr<osg::Switch> onOff = new osg::Switch;
    osg::ref_ptr<osg::Node> technique = scene.group->getChild(1);
    scene.group->replaceChild(technique, onOff);
    onOff->addChild(technique, false);
    Camera camera(scene.root, trial.view);
    EXPECT_TRUE(same(camera.frame(), truth.lit));
    onOff->setAllChildrenOn();
    EXPECT_TRUE(shows(camera.frame(), truth));
    onOff->setAllChildrenOff();
    EXPECT_TRUE(same(camera.frame(), truth.lit));
}

TEST(PlanarTechnique, UnderATransformCastsOnTheTransformedPlane) {
    Trial trial = boxOnGround();
    for (Mesh& caster : trial.casters) caster = moved(caster, {0.0, 0.0, 0.75});
    const auto raised = [&trial](bool withShadow) {
        Scene scene = test::scene(trial.light);
        scene.content->addChild(node(square(8.0, 0.75)));
        for (const Mesh& caster : trial.casters) scene.content->addChild(node(caster));
        if (!withShadow) return scene;
        scene.addShadow(planar());
        osg::ref_ptr<osg::Node> technique = scene.group->getChild(1);
        osg::ref_ptr<osg::MatrixTransform> up =
            new osg::MatrixTransform(osg::Matrixd::scale(3.0, 3.0, 0.5) * osg::Matrixd::translate(1.0, 2.0, 0.75));
        scene.group->replaceChild(technique, up);
        up->addChild(technique);
        return scene;
    };
    Scene dark = raised(false), shadowed = raised(true);
    dark.takeLightAway();
    for (const View& view : {fromAbove(4.0, size), slanting()}) {
        const Truth truth{render(raised(false).root, view), render(dark.root, view),
                          castRays(square(8.0, 0.75), trial.casters, trial.light, view)};
        EXPECT_GT(truth.shadowPixels(), 200);
        shadowed.group->setComposite(gnomon::ShadowCasterGroup::RELIGHT);
        EXPECT_TRUE(isRight(shadowed, view, truth));
    }
}

TEST_P(TwoGroups, InOneSceneCastBoth) {
    const Trial trial = boxOnGround();
    Scene scene = test::scene(trial.light);
    scene.content->addChild(node(square(trial.half), "ground"));
    for (const Mesh& caster : trial.casters) {
        osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
        group->addChild(node(caster));
        group->addChild(castingTechnique(find(*scene.root, "ground")));
        scene.content->addChild(group);
    }
    EXPECT_TRUE(shows(render(scene.root, trial.view), truthOf(trial)));
}
