// SPDX-License-Identifier: MIT
// Every cause that diagnose() can give, provoked, and gone when its remedy is applied.
#include "Trial.h"

#include <gnomon/ShadowBin.h>
#include <osg/LightModel>

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

/// Exactly one sentence: it begins with the node, says `what` and ends with `remedy`.
::testing::AssertionResult says(const Causes& causes, const std::string& what, const std::string& remedy) {
    if (causes.size() != 1) return ::testing::AssertionFailure() << causes.size() << " causes";
    const std::string& cause = causes.front();
    const bool right = cause.rfind("PlanarShadowNode 'floor' ", 0) == 0 && cause.find(what) != std::string::npos &&
                       endsWith(cause, remedy + ".") && cause.find(". ") == std::string::npos;
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
    EXPECT_EQ(site.technique->diagnose().front().rfind("PlanarShadowNode has no plane", 0), 0u);
}

TEST(Diagnose, TellsOfALightInThePlaneOrBehindItUntilItIsMovedBack) {
    Site site;
    const osg::Vec4 good = site.scene.light->getLight()->getPosition();
    for (const osg::Vec4& bad : {osg::Vec4(1, 0, 0, 0), osg::Vec4(1, 0, -1, 0), osg::Vec4(1, 0, -1, 1), osg::Vec4()}) {
        site.scene.light->getLight()->setPosition(bad);
        EXPECT_TRUE(says(site.causes(), "which is in its plane or behind it",
                         "move the light to the side that the plane's normal points to"));
        site.scene.light->getLight()->setPosition(good);
        EXPECT_EQ(site.causes(), Causes());
    }
}

TEST(Diagnose, TellsOfALightThatIsNotANumber) {
    Site site;
    site.scene.group->addLight({0, osg::Vec4d(noNumber, 0.0, 1.0, 0.0)});
    EXPECT_TRUE(says(site.causes(), "which is not a finite number", "set the light's position"));
    site.scene.group->removeLights();
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAMissingPlane) {
    Site site;
    site.technique->setPlanes({});
    EXPECT_TRUE(says(site.causes(), "has no plane to cast on", "give it one with addPlane()"));
    site.technique->addPlane(groundPlane);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAPlaneWithoutANormal) {
    Site site;
    for (const osg::Vec4d& bad :
         {osg::Vec4d(), osg::Vec4d(noNumber, 0.0, 1.0, 0.0), osg::Vec4d(0.0, 0.0, 1.0, noNumber)}) {
        site.technique->setPlanes({bad});
        EXPECT_TRUE(says(site.causes(), "whose normal is zero or not a number",
                         "give (a, b, c, d) of a x + b y + c z + d = 0"));
    }
    site.technique->setPlanes({groundPlane});
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenNothingIsAboveThePlane) {
    Site site;
    site.technique->setPlanes({{0.0, 0.0, 1.0, -5.0}});
    EXPECT_TRUE(says(site.causes(), "has nothing above its plane (0 0 1 -5)",
                     "look at the plane's place and the side its normal points to"));
    site.technique->setPlanes({groundPlane});
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAViewFromBehindThePlane) {
    Site site;
    site.scene.root->getOrCreateStateSet()->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    site.view = perspective({0.0, -5.0, -5.0}, {0.0, 0.0, 0.0}, 64, 64);
    EXPECT_TRUE(says(site.causes(), "is seen from behind its plane (0 0 1 0)", "turn the plane's normal round"));
    site.camera->setView(fromAbove(4.0, 64));
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAMissingGroup) {
    Site site;
    site.scene.group->removeChild(site.technique);
    site.scene.root->addChild(site.technique);
    EXPECT_TRUE(says(site.causes(), "has no ShadowCasterGroup above it",
                     "make it a child of the group that holds the casters"));
    site.scene.root->removeChild(site.technique);
    site.scene.group->addChild(site.technique);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAGroupWithoutTriangles) {
    Site site;
    site.scene.group->setName("town");
    site.scene.group->setCasters({site.scene.light});
    EXPECT_TRUE(says(site.causes(), "has nothing to cast: its group 'town' holds no triangles",
                     "add the scene to it, or look at its setCasters()"));
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
    EXPECT_TRUE(says(site.causes(), "leaves out 1 triangles, the first of them in 'broken'",
                     "give every vertex finite coordinates and every index a vertex"));
    (*vertices)[1].x() = 2.0f;
    vertices->dirty();
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfALightSourceThatIsNotInTheView) {
    Site site;
    osg::ref_ptr<osg::LightSource> stray = new osg::LightSource;
    stray->setName("stray");
    site.scene.group->addLight(stray);
    EXPECT_TRUE(says(site.causes(), "waits for the LightSource 'stray'", "add it to the scene"));
    site.scene.group->removeLights();
    site.scene.group->addLight(site.scene.light);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenNoLightIsOn) {
    Site site;
    site.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF);
    EXPECT_TRUE(
        says(site.causes(), "finds no light that is on in this view", "or set one with ShadowCasterGroup::addLight"));
    site.scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfAFramebufferWithoutStencil) {
    Site site;
    site.options.stencilBits = 0;
    EXPECT_TRUE(says(site.causes(), "finds no stencil bits in this framebuffer: ask for 8",
                     "or by a stencil attachment of the camera"));
    site.camera = std::make_unique<Camera>(site.scene.root, site.view);
    site.causes(); // its first frame has the same number as that of the other viewer: both are views of one frame
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenEveryStencilBitIsReserved) {
    Site site;
    site.reserve(0xff);
    EXPECT_TRUE(
        says(site.causes(), "finds every stencil bit reserved", "leave one to CompositorOptions::reservedStencilBits"));
    site.reserve(0);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsWhenASecondStencilBitIsWanted) {
    Site site;
    osg::ref_ptr<PlanarShadowNode> beside = planar();
    beside->setName("floor");
    site.scene.group->insertChild(0, beside);
    site.reserve(0xfe);
    EXPECT_TRUE(
        says(site.causes(), "needs a second stencil bit", "leave two to CompositorOptions::reservedStencilBits"));
    EXPECT_EQ(beside->diagnose(), Causes());
    site.reserve(0);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, TellsOfLightsBeyondTheThreeThatCanBeRelit) {
    Site site;
    addLights(site.scene, 4);
    EXPECT_TRUE(
        says(site.causes(), "leaves light 3 unshadowed: at most 3 lights can be relit here", "blend takes any number"));
    site.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    EXPECT_EQ(site.causes(), Causes());
}

TEST(Diagnose, GivesEachCauseOnceHoweverManyLightsAndPlanesItHas) {
    Site site;
    addLights(site.scene, 3);
    site.technique->setPlanes({{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}});
    EXPECT_TRUE(says(site.causes(), "whose normal is zero", "= 0"));
    site.technique->setPlanes({{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}});
    EXPECT_EQ(site.causes().size(), 2u);
}
