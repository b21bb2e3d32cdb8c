// SPDX-License-Identifier: MIT
// State and views that would lead the compositor's own drawing astray.
#include <support/DiscShadow.h>
#include <support/GlDebug.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/DisplaySettings>
#include <osg/Geometry>
#include <osg/LogicOp>
#include <osg/Point>

using namespace test;

namespace {

const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 200, 150);
constexpr auto blend = gnomon::ShadowCasterGroup::BLEND;

Scene boxScene() { return groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})}); }

osg::StateSet& groundState(Scene& scene) { return *find(*scene.root, "ground")->getOrCreateStateSet(); }

osg::ref_ptr<DiscShadow> disc(double inner, double outer) {
    osg::ref_ptr<DiscShadow> result = new DiscShadow({100.0, 75.0}, inner, outer);
    result->size.set(view.width, view.height);
    return result;
}

/// What a nested camera lays over the view: seen through a lens of its own, by its depths nearer than all of the view.
osg::ref_ptr<osg::Camera> overlay(osg::Node* content) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::NESTED_RENDER);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setViewMatrixAsLookAt({0.0, 0.0, 50.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    camera->setProjectionMatrixAsOrtho(-4.0, 12.0, -6.0, 6.0, 1.0, 100.0);
    camera->addChild(content);
    return camera;
}

int changed(const Picture& a, const Picture& b) { return a.different(b); }

} // namespace

TEST(HostileState, ABlendEquationThatIsNotUsedDoesNotBendTheFactor) {
    Scene plain = boxScene(), bent = boxScene();
    groundState(bent).setAttribute(new osg::BlendEquation(osg::BlendEquation::RGBA_MAX)); // GL_BLEND stays off
    for (Scene* scene : {&plain, &bent}) {
        scene->addShadow(planar(find(*scene->root, "ground")));
        scene->group->setComposite(blend);
    }
    EXPECT_EQ(changed(render(bent.root, view), render(plain.root, view)), 0);
}

TEST(HostileState, AReceiverWithALogicOpIsBlendedToo) {
    for (const bool named : {false, true}) {
        Scene scene = boxScene();
        groundState(scene).setAttributeAndModes(new osg::LogicOp(osg::LogicOp::COPY));
        const Picture lit = render(scene.root, view);
        scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
        scene.group->setComposite(blend);
        EXPECT_GT(changed(render(scene.root, view), lit), 500) << "named " << named;
    }
}

// The second eye draws its channels over those of the first, and must not wipe them out.
TEST(HostileState, ABlendingReceiverIsTheSameInAnaglyphStereoWithoutSeparation) {
    const auto shoot = [](bool stereo) {
        Scene scene = boxScene();
        groundState(scene).setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE));
        scene.addShadow(planar());
        Camera camera(scene.root, view);
        osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
        settings->setStereo(stereo);
        settings->setStereoMode(osg::DisplaySettings::ANAGLYPHIC);
        settings->setEyeSeparation(0.0f);
        camera.viewer().getCamera()->setDisplaySettings(settings);
        camera.viewer().getCamera()->setClearColor(
            {0.0f, 0.0f, 0.0f, 1.0f}); // what the clear of one eye adds is nothing
        return camera.frame();
    };
    EXPECT_EQ(changed(shoot(true), shoot(false)), 0);
}

TEST(HostileState, WidePointsBesideTheShadowAreDrawnAgainWhereTheyReachIn) {
    Scene scene = boxScene();
    osg::ref_ptr<osg::Vec3Array> spot = new osg::Vec3Array(1);
    spot->front().set(-2.35f, 1.41f, 0.3f); // ten pixels to the left of the marks' bounds, and 30 pixels wide each way
    osg::ref_ptr<osg::Geometry> point = new osg::Geometry;
    point->setVertexArray(spot);
    osg::ref_ptr<osg::Vec4Array> red = new osg::Vec4Array(1);
    red->front().set(1.0f, 0.0f, 0.0f, 1.0f);
    point->setColorArray(red, osg::Array::BIND_OVERALL);
    point->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, 1));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(point);
    geode->getOrCreateStateSet()->setAttribute(new osg::Point(60.0f));
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF); // or it would look like the ground
    scene.content->addChild(geode);
    scene.addShadow(disc(30.0, 30.0));
    const Picture filtered = render(scene.root, view);
    const Picture whole = render(test::unfiltered(scene.root), view);
    EXPECT_EQ(changed(filtered, whole), 0);
}

TEST(HostileState, DepthThatIsClearedToLessThanOneIsRefusedWithTheReason) {
    Scene scene = boxScene();
    const auto technique = planar();
    Camera plain(scene.root, view);
    plain.viewer().getCamera()->setClearDepth(0.9);
    const Picture lit = plain.frame();
    scene.addShadow(technique);
    EXPECT_EQ(changed(plain.frame(), lit), 0);
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("cleared to less than 1"), std::string::npos);
}

TEST(HostileState, ALightSourceOfANumberThatOpenGLLacksIsNamed) {
    Scene scene = boxScene();
    osg::ref_ptr<osg::LightSource> odd = new osg::LightSource;
    odd->getLight()->setLightNum(40);
    scene.root->addChild(odd);
    const auto technique = planar();
    scene.addShadow(technique);
    scene.group->addLight(odd);
    Camera camera(scene.root, view);
    // OpenSceneGraph itself asks OpenGL for that light, and would tell of the error.
    camera.context().graphicsContext()->getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS);
    stopListeningToGl(*camera.context().graphicsContext());
    camera.frame();
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("OpenGL's lights are 0 to 7"), std::string::npos);
}

// The view's shadow, that of the overlay, and both: none takes the other away.
TEST(TwoLenses, ShadowsOfBothAreBlended) {
    const auto build = [](bool inView, bool inOverlay) {
        Scene below = boxScene(), above = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})}, 3.0);
        if (inView) below.addShadow(planar());
        if (inOverlay) above.addShadow(planar());
        for (Scene* scene : {&below, &above}) {
            if (!scene->group) continue;
            scene->group->setComposite(blend);
            scene->group->addLight({0, osg::Vec4d(1.0, 0.0, 1.0, 0.0)}); // both scenes bring a light of this number
        }
        const osg::ref_ptr<osg::Camera> corner = overlay(above.root);
        corner->setProjectionMatrixAsOrtho(-3.0, 21.0, -3.0, 15.0, 1.0, 100.0); // clear of the view's own shadow
        below.root->addChild(corner);
        return below.root;
    };
    const Picture none = render(build(false, false), view);
    const int first = changed(render(build(true, false), view), none);
    const int second = changed(render(build(false, true), view), none);
    EXPECT_GT(first, 100);
    EXPECT_GT(second, 100);
    EXPECT_EQ(changed(render(build(true, true), view), none), first + second);
}

TEST(TwoLenses, SoftEdgesOfTheViewLeaveWhatIsLaidOverIt) {
    for (const bool twoLights : {false, true}) {
        Scene scene = boxScene();
        osg::ref_ptr<osg::LightSource> second = new osg::LightSource;
        second->getLight()->setLightNum(1);
        second->getLight()->setPosition({-1.0f, 0.0f, 1.0f, 0.0f});
        second->getLight()->setDiffuse({0.2f, 0.2f, 0.2f, 1.0f});
        scene.root->addChild(second);
        if (twoLights) scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        osg::ref_ptr<osg::Geode> cover = node(square(2.0), "cover");
        scene.root->addChild(overlay(cover));
        const Picture lit = render(scene.root, view);
        cover->setNodeMask(0);
        const Picture bare = render(scene.root, view);
        cover->setNodeMask(~0u);
        scene.addShadow(disc(30.0, 60.0));
        const Picture shadowed = render(scene.root, view);
        int covered = 0, wrong = 0;
        for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
            if (lit.pixels[i] == bare.pixels[i]) continue;
            ++covered;
            wrong += shadowed.pixels[i] != lit.pixels[i];
        }
        EXPECT_GT(covered, 1000);
        EXPECT_EQ(wrong, 0) << "two lights " << twoLights;
    }
}
