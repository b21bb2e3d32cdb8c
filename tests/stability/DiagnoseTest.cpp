// SPDX-License-Identifier: MIT
// Every cause that diagnose() can give, provoked, and gone when its remedy is applied.
#include "Trial.h"

#include <gnomon/group/ShadowBin.h>
#include <osg/Fog>
#include <osg/LightModel>
#include <osg/Notify>

#include <limits>

using namespace test;

namespace {

using gnomon::PlanarShadowNode;
using Causes = std::vector<std::string>;

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
const osg::Vec4d groundPlane(0.0, 0.0, 1.0, 0.0);

/// A box on a ground with a technique named "floor", seen from above.
struct Site {
    Site() {
        scene.addShadow(technique);
        technique->setName("floor");
    }
    void reserve(unsigned stencilBits) { test::reserving(scene.root, stencilBits); }
    /// What the technique says after one more frame.
    Causes causes() {
        if (!camera) camera = std::make_unique<Camera>(scene.root, view, options);
        camera->frame();
        return technique->diagnose();
    }

    Scene scene = groundScene({box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0})});
    osg::ref_ptr<PlanarShadowNode> technique = planar();
    View view = fromAbove(4.0, 64);
    gnomon::HeadlessContext::Options options;
    std::unique_ptr<Camera> camera;
};

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isLower(char letter) { return letter >= 'a' && letter <= 'z'; }

/// Exactly one cause: "PlanarShadowNode 'floor': what is wrong. What to do.", with `what` in it and `remedy` at its end.
::testing::AssertionResult says(const Causes& causes, const std::string& what, const std::string& remedy) {
    if (causes.size() != 1) return ::testing::AssertionFailure() << causes.size() << " causes";
    const std::string& cause = causes.front();
    const std::string start = "PlanarShadowNode 'floor': ";
    const std::size_t wrong = cause.find(what), next = cause.find(". ");
    const bool right = cause.rfind(start, 0) == 0 && isLower(cause[start.size()]) && wrong < next &&
                       next < cause.size() - remedy.size() - 1 && endsWith(cause, remedy + ".");
    return right ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << cause;
}

/// Lights 1 to `count` - 1 beside light 0, on, from different sides.
void addLights(Scene& scene, int count) {
    for (int i = 1; i < count; ++i) {
        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        source->getLight()->setLightNum(i);
        source->getLight()->setPosition({static_cast<float>(i) - 2.5f, 1.0f, 1.0f, 0.0f});
        scene.root->addChild(source);
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0 + static_cast<GLenum>(i), osg::StateAttribute::ON);
    }
}

} // namespace

TEST(Diagnose, SaysNothingWhereAllIsWell) {
    Site site;
    for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(site.causes(), Causes());
    site.technique->setReceiver({find(*site.scene.root, "ground")});
    EXPECT_EQ(site.causes(), Causes());
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, NamesTheClassAloneWhereTheNodeHasNoName) {
    Site site;
    site.technique->setName("");
    site.technique->setPlanes({});
    ASSERT_EQ(site.causes().size(), 1u);
    EXPECT_EQ(site.technique->diagnose().front().rfind("PlanarShadowNode: no plane is set", 0), 0u);
}

TEST(Diagnose, TellsOfALightInThePlaneOrBehindItUntilItIsMovedBack) {
    Site site;
    const osg::Vec4 good = site.scene.light->getLight()->getPosition();
    for (const osg::Vec4& bad : {osg::Vec4(1, 0, 0, 0), osg::Vec4(1, 0, -1, 0), osg::Vec4(1, 0, -1, 1), osg::Vec4()}) {
        site.scene.light->getLight()->setPosition(bad);
        EXPECT_TRUE(says(site.causes(), "lies in the plane or behind it",
                         "Move the light to the side that the plane's normal points to"));
        site.scene.light->getLight()->setPosition(good);
        EXPECT_EQ(site.causes(), Causes());
    }
}

TEST(Diagnose, TellsOfNamedNodesThatNothingElseKept) {
    Site site;
    site.technique->setReceiver({node(square(1.0))});
    EXPECT_TRUE(says(site.causes(), "the node given to setReceiver() is gone", "and name it anew"));
    site.technique->setReceiver({});
    site.scene.group->setCasters({node(square(1.0))});
    EXPECT_TRUE(says(site.causes(), "the node given to setCasters()", "and name them anew"));
    site.scene.group->setCasters({});
    site.scene.group->addLight(osg::ref_ptr<osg::LightSource>(new osg::LightSource));
    EXPECT_TRUE(says(site.causes(), "a LightSource given to ShadowCasterGroup::addLight() is gone",
                     "and give it to the group anew"));
    site.scene.group->removeLights();
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, WarnsOnceOfEachCauseUntilAProgramAsks) {
    struct Listener : osg::NotifyHandler {
        void notify(osg::NotifySeverity severity, const char* message) override {
            if (severity == osg::WARN) said.emplace_back(message);
        }
        Causes said;
    };
    const osg::ref_ptr<osg::NotifyHandler> before = osg::getNotifyHandler();
    osg::ref_ptr<Listener> listener = new Listener;
    osg::setNotifyHandler(listener);
    {
        Site site;
        site.camera = std::make_unique<Camera>(site.scene.root, site.view, site.options);
        for (int frame = 0; frame < 3; ++frame) site.camera->frame();
        EXPECT_EQ(listener->said, Causes()) << "all is well";
        site.technique->setPlanes({});
        for (int frame = 0; frame < 3; ++frame) site.camera->frame();
        ASSERT_EQ(listener->said.size(), 1u);
        EXPECT_NE(listener->said[0].find("PlanarShadowNode 'floor': no plane is set"), std::string::npos);
        for (const float height : {-1.0f, -2.0f}) { // the same cause with other numbers
            site.technique->setPlanes({groundPlane});
            site.scene.light->getLight()->setPosition({1.0f, 0.0f, height, 0.0f});
            site.camera->frame();
        }
        EXPECT_EQ(listener->said.size(), 2u);
    }
    Site asked;
    EXPECT_EQ(asked.technique->diagnose(), Causes());
    asked.technique->setPlanes({});
    EXPECT_EQ(asked.causes().size(), 1u);
    EXPECT_EQ(listener->said.size(), 2u) << "who asks is not warned besides";
    osg::setNotifyHandler(before);
}

TEST(Diagnose, TellsOfALightThatIsNotANumber) {
    Site site;
    site.scene.group->addLight({0, osg::Vec4d(noNumber, 0.0, 1.0, 0.0)});
    EXPECT_TRUE(says(site.causes(), "has a coordinate that is not finite", "Set the light's position"));
    site.scene.group->removeLights();
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAMissingPlane) {
    Site site;
    site.technique->setPlanes({});
    EXPECT_TRUE(says(site.causes(), "no plane is set", "Set one with addPlane()"));
    site.technique->addPlane(groundPlane);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAPlaneWithoutANormal) {
    Site site;
    for (const osg::Vec4d& bad :
         {osg::Vec4d(), osg::Vec4d(noNumber, 0.0, 1.0, 0.0), osg::Vec4d(0.0, 0.0, 1.0, noNumber)}) {
        site.technique->setPlanes({bad});
        EXPECT_TRUE(
            says(site.causes(), "is zero or not a number", "Give (a, b, c, d) of the plane a x + b y + c z + d = 0"));
    }
    site.technique->setPlanes({groundPlane});
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenNothingIsAboveThePlane) {
    Site site;
    site.technique->setPlanes({{0.0, 0.0, 1.0, -5.0}});
    EXPECT_TRUE(says(site.causes(), "no caster is above the plane (0 0 1 -5)",
                     "Check where the plane lies and which way its normal points"));
    site.technique->setPlanes({groundPlane});
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAViewFromBehindThePlane) {
    Site site;
    site.scene.root->getOrCreateStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    site.view = perspective({0.0, -5.0, -5.0}, {0.0, 0.0, 0.0}, 64, 64);
    EXPECT_TRUE(says(site.causes(), "the camera is behind the plane (0 0 1 0)", "reverse the plane's normal"));
    site.camera->setView(fromAbove(4.0, 64));
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAMissingGroup) {
    Site site;
    site.scene.group->removeChild(site.technique);
    site.scene.root->addChild(site.technique);
    EXPECT_TRUE(says(site.causes(), "there is no ShadowCasterGroup above this node",
                     "Make it a child of the group that holds the casters"));
    site.scene.root->removeChild(site.technique);
    site.scene.group->addChild(site.technique);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAGroupWithoutTriangles) {
    Site site;
    site.scene.group->setName("town");
    site.scene.group->setCasters({site.scene.light});
    EXPECT_TRUE(says(site.causes(), "nothing casts, because the ShadowCasterGroup 'town' holds no triangles",
                     "Add the scene to the group, or check its setCasters() (--casters)"));
    site.scene.group->setCasters({});
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfVerticesThatAreNotNumbers) {
    Site site;
    osg::ref_ptr<osg::Geode> broken = node({{1.0, 1.0, 1.0}, {2.0, 1.0, 1.0}, {1.0, 2.0, 1.0}}, "broken");
    auto* geometry = broken->getDrawable(0)->asGeometry();
    auto* vertices = static_cast<osg::Vec3Array*>(geometry->getVertexArray());
    (*vertices)[1].x() = std::numeric_limits<float>::quiet_NaN();
    site.scene.content->addChild(broken);
    EXPECT_TRUE(says(site.causes(), "invalid triangles are left out: 1, the first in 'broken'",
                     "Give every vertex finite coordinates and every index a vertex"));
    (*vertices)[1].x() = 2.0f;
    vertices->dirty();
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfALightSourceThatIsNotInTheView) {
    Site site;
    osg::ref_ptr<osg::LightSource> stray = new osg::LightSource;
    stray->setName("stray");
    site.scene.group->addLight(stray);
    EXPECT_TRUE(says(site.causes(), "the LightSource 'stray' is not in this view's scene graph",
                     "Add it to the scene, or give it another number"));
    site.scene.group->removeLights();
    site.scene.group->addLight(site.scene.light);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenNoLightIsOn) {
    Site site;
    site.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
    EXPECT_TRUE(says(site.causes(), "no light is on in this view",
                     "or set a light with ShadowCasterGroup::addLight() (--light)"));
    site.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAFramebufferWithoutStencilWhereOpenGLCannotCopyToAnother) {
    Site site;
    site.options.stencilBits = 0;
    EXPECT_EQ(site.causes(), Causes());
    const NoFramebufferCopies none(*site.camera);
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_TRUE(
            says(site.causes(), "this framebuffer has no stencil bits", "or give the camera a stencil attachment"));
}

TEST(Diagnose, TellsWhenEveryStencilBitIsReservedWhereOpenGLCannotCopyToAnother) {
    Site site;
    site.reserve(0xff);
    EXPECT_EQ(site.causes(), Causes()) << "it works in a framebuffer of its own";
    const NoFramebufferCopies none(*site.camera);
    EXPECT_TRUE(says(site.causes(), "every stencil bit is reserved",
                     "Leave at least one out of CompositorOptions::reservedStencilBits"));
    site.reserve(0);
    site.causes(); // which finds that it can draw again
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenASecondStencilBitIsWantedWhereOpenGLCannotCopyToAnother) {
    Site site;
    osg::ref_ptr<PlanarShadowNode> beside = planar();
    beside->setName("floor");
    site.scene.group->insertChild(0, beside);
    site.reserve(0xfe);
    EXPECT_EQ(site.causes(), Causes()) << "it works in a framebuffer of its own";
    const NoFramebufferCopies none(*site.camera);
    EXPECT_TRUE(says(site.causes(), "needs two stencil bits",
                     "Leave at least two out of CompositorOptions::reservedStencilBits"));
    EXPECT_EQ(beside->diagnose(), Causes());
    site.reserve(0);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfALightWithoutAStencilBitWhereOpenGLCannotCopyToAnother) {
    Site site;
    addLights(site.scene, 2);
    site.reserve(0xfc);
    EXPECT_EQ(site.causes(), Causes()) << "it works in a framebuffer of its own";
    const NoFramebufferCopies none(*site.camera);
    EXPECT_TRUE(says(site.causes(), "light 1 casts no shadow, because too few stencil bits are left",
                     "or set BLEND (composite=blend), which takes any number of lights"));
}

TEST(Diagnose, TellsOfLightsBeyondTheThreeThatCanBeRelit) {
    Site site;
    addLights(site.scene, 4);
    EXPECT_TRUE(says(site.causes(), "light 3 casts no shadow, because at most 3 lights can be relit",
                     "Set BLEND (composite=blend), which takes any number of lights"));
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfANamedLightThatIsOff) {
    Site site;
    osg::StateSet& state = *site.scene.root->getOrCreateStateSet();
    site.scene.group->addLight({1, {1.0, 0.5, 2.0, 0.0}});
    const auto isOff = [&] {
        return says(site.causes(), "light 1 was named by addLight(), but GL_LIGHT1 is off in this view",
                    "Switch that mode on above the scene");
    };
    EXPECT_TRUE(isOff());
    state.setMode(GL_LIGHT1, osg::StateAttribute::ON);
    EXPECT_EQ(site.causes(), Causes());
    state.removeMode(GL_LIGHT1);
    site.scene.group->addLightUniform({1, "sunColor"});
    EXPECT_EQ(site.causes(), Causes()) << "a program may light";
    site.scene.group->setLightUniforms({});
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_EQ(site.causes(), Causes()) << "a factor is taken whatever shines";
}

TEST(Diagnose, SaysNothingOfPlanesBesideOneThatHasAShadow) {
    Site site;
    site.technique->addPlane({0.0, 0.0, -1.0, -0.1}); // the underside of a slab
    EXPECT_EQ(site.causes(), Causes());
    site.technique->setPlanes({{0.0, 0.0, -1.0, -0.1}});
    EXPECT_TRUE(says(site.causes(), "no caster is above the plane", "which way its normal points"));
}

TEST(Diagnose, TellsWhenEachLightIsBlack) {
    Site site;
    addLights(site.scene, 2);
    osg::Light& sun = *site.scene.light->getLight();
    const osg::Vec4 black(0.0f, 0.0f, 0.0f, 1.0f), white(1.0f, 1.0f, 1.0f, 1.0f);
    sun.setDiffuse(black);
    sun.setSpecular(black);
    EXPECT_EQ(site.causes(), Causes()) << "the other light shines";
    const auto isBlack = [&] {
        return says(site.causes(), "each light in this view is black", "Give it a diffuse or specular colour");
    };
    site.scene.group->addLight(site.scene.light);
    EXPECT_TRUE(isBlack());
    site.scene.group->addLightUniform({0, "sunColor"}); // a program may have a colour of its own
    EXPECT_EQ(site.causes(), Causes());
    site.scene.group->setLightUniforms({});
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_EQ(site.causes(), Causes());
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::RELIGHT);
    sun.setSpecular(white);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfFogThatBlendDarkens) {
    Site site;
    site.scene.root->getOrCreateStateSet()->setAttributeAndModes(new osg::Fog);
    EXPECT_EQ(site.causes(), Causes());
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_TRUE(says(site.causes(), "fog is on, and BLEND darkens it",
                     "Set RELIGHT (composite=relight), or switch GL_FOG off"));
    site.scene.root->getStateSet()->removeAttribute(osg::StateAttribute::FOG);
    site.scene.root->getStateSet()->removeMode(GL_FOG);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, GivesEachCauseOnceHoweverManyLightsAndPlanesItHas) {
    Site site;
    addLights(site.scene, 3);
    site.technique->setPlanes({{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}});
    EXPECT_TRUE(says(site.causes(), "is zero or not a number", "= 0"));
    site.technique->setPlanes({{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}});
    EXPECT_EQ(site.causes().size(), 2u);
}
