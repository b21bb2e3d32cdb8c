// SPDX-License-Identifier: MIT
// Traced shadows against the truth image; several lights, composites, receivers, live changes.
// Traced shadows in framebuffer objects with several samples, whose depth has to be resolved before it can be read.
#include "IntoTexture.h"
#include "TracedCases.h"

#include <gnomon/TracedShadowTechnique.h>

#include <gtest/gtest.h>
#include <osg/ContextData>
#include <osg/GLExtensions>
#include <osg/MatrixTransform>

#include <cmath>
#include <iostream>
#include <limits>

using namespace test;

namespace {

DrawnInto drawnByRays(const TracedCase& given) { return {given, fourSamples(), new gnomon::TracedShadowTechnique}; }

/// A pixel's shadow is that of one of its samples, wherever in the pixel that lies: so a pixel may be wrong if an edge
/// runs through it. An edge that runs between the truth's 16 rays and the pixel's border makes 1 in 10,000.
void expectOneOfTheSamples(const TracedCase& given, const Target& target) {
    SCOPED_TRACE(given.name);
    DrawnInto traced(given, target, new gnomon::TracedShadowTechnique);
    const TruthComparison found = compareWithRays(traced, given, target);
    std::cout << given.name << ": " << found << "\n";
    EXPECT_EQ(found.neither, 0);
    EXPECT_LE(found.certain, found.pixels / 10000);
    EXPECT_GT(found.shadowed, 2000);
    EXPECT_EQ(traced.technique->diagnose(), std::vector<std::string>());
    EXPECT_EQ(traced.into->complaints->all(), std::vector<std::string>());
}

/// Framebuffers and renderbuffers that a viewer's context holds.
int objectsIn(IntoTexture& into) {
    GLboolean (*isFramebuffer)(GLuint) = nullptr;
    GLboolean (*isRenderbuffer)(GLuint) = nullptr;
    osg::setGLExtensionFuncPtr(isFramebuffer, "glIsFramebuffer");
    osg::setGLExtensionFuncPtr(isRenderbuffer, "glIsRenderbuffer");
    osg::GraphicsContext& context = *into.camera->context().graphicsContext();
    context.makeCurrent();
    osg::flushAllDeletedGLObjects(context.getState()->getContextID());
    int count = 0;
    for (GLuint name = 1; name < 200; ++name) count += (isFramebuffer(name) != 0) + (isRenderbuffer(name) != 0);
    context.releaseContext();
    return count;
}

void release(DrawnInto& drawn) {
    osg::GraphicsContext& context = *drawn.into->camera->context().graphicsContext();
    context.makeCurrent();
    drawn.scene.root->releaseGLObjects(context.getState());
    context.releaseContext();
}

TEST(TracedBuffers, ShowWithFourSamplesWhatOneOfThemSays) {
    expectOneOfTheSamples(labEight(), fourSamples());
    expectOneOfTheSamples(townOfHouses(), fourSamples());
    expectOneOfTheSamples(room(), fourSamples(depth32));
}

TEST(TracedBuffers, ShowFlatGroundsFreeOfAcne) {
    for (const double elevation : {2.0, 20.0, 80.0})
        for (const TracedCase& given : {flatGround(8.0, 3.0, elevation, 1.0, 100.0),
                                        flatGround(8.0, 0.1, elevation, 0.1, 100.0), // along the ground
                                        flatGround(8.0, 0.5, elevation, 4.0, 20.0, 200)})
            EXPECT_EQ(drawnByRays(given).frame().different(DrawnInto(given, fourSamples(), nullptr).frame()), 0)
                << elevation;
}

TEST(TracedBuffers, ThatCannotBeResolvedAreDiagnosedAndShowNoShadow) {
    DrawnInto traced = drawnByRays(labEight());
    auto& extensions = *traced.into->camera->context().graphicsContext()->getState()->get<osg::GLExtensions>();
    const auto blit = extensions.glBlitFramebuffer;
    extensions.glBlitFramebuffer = nullptr; // OSG cannot either: the window stays empty
    traced.frame();
    extensions.glBlitFramebuffer = blit; // the next context of this number has the same extensions
    ASSERT_EQ(traced.technique->diagnose().size(), 1u);
    EXPECT_NE(
        traced.technique->diagnose()[0].find("the depth of this multisampled framebuffer object cannot be resolved"),
        std::string::npos);
    EXPECT_EQ(traced.into->complaints->all(), std::vector<std::string>());
}

TEST(TracedBuffers, AreResolvedIntoALargerOneWhenShadowsGrowOnTheScreen) {
    TracedCase given = labEight();
    DrawnInto grown = drawnByRays(given), large = drawnByRays(given);
    const osg::Matrixd near = given.view.view;
    grown.into->into->setViewMatrix(near * osg::Matrixd::translate(-25.0, -25.0, -70.0)); // to the corner, and small
    grown.frame();
    grown.into->into->setViewMatrix(near);
    EXPECT_EQ(grown.frame().different(large.frame()), 0);
    EXPECT_EQ(grown.into->complaints->all(), std::vector<std::string>());
}

TEST(TracedBuffers, LeaveNothingBehindInOpenGL) {
    const TracedCase given = labEight();
    DrawnInto plain(given, fourSamples(), nullptr), traced = drawnByRays(given);
    plain.frame();
    const Picture first = traced.frame();
    const int without = objectsIn(*plain.into), with = objectsIn(*traced.into);
    EXPECT_EQ(with, without + 1) << "a renderbuffer";
    for (int i = 0; i < 10; ++i) traced.frame();
    EXPECT_EQ(objectsIn(*traced.into), with);
    release(traced);
    EXPECT_EQ(objectsIn(*traced.into), without);
    EXPECT_EQ(traced.frame().different(first), 0) << "made anew";
    traced.scene.group->removeChild(traced.technique);
    traced.frame(); // the last view of it goes with the next frame
    traced.technique = nullptr;
    traced.frame();
    EXPECT_EQ(objectsIn(*traced.into), without);
}

CaseTrial draw(const TracedCase& given) { return {new gnomon::TracedShadowTechnique, given}; }

TEST(Traced, IsAsGoodAsOneRayAPixelCanBe) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) {
        const CaseTrial result = draw(given);
        std::cout << given.name << ": " << result.comparison << "\n";
        EXPECT_TRUE(result.comparison.good()) << given.name << ": " << result.comparison;
        EXPECT_GT(result.comparison.shadowed, 2000) << given.name;
        EXPECT_GT(result.comparison.edges, 300) << given.name;
        EXPECT_LT(result.comparison.shadowed, result.comparison.pixels) << given.name;
        EXPECT_EQ(result.causes, std::vector<std::string>());
    }
}

/// What is not lit on flatGround().
int unlit(double half, double height, double elevation, double near, double far, int side = 1) {
    const TracedCase given = flatGround(half, height, elevation, near, far, side);
    Scene lit = given.build(), shadowed = given.build();
    shadowed.addShadow(new gnomon::TracedShadowTechnique);
    return render(shadowed.root, given.view).different(render(lit.root, given.view));
}

TEST(Traced, FlatGroundsAreFreeOfAcne) {
    for (double elevation : {2.0, 20.0, 80.0}) {
        EXPECT_EQ(unlit(8.0, 3.0, elevation, 1.0, 100.0), 0) << elevation;
        EXPECT_EQ(unlit(8.0, 0.1, elevation, 0.1, 100.0), 0) << elevation << ", along the ground";
        EXPECT_EQ(unlit(8.0, 60.0, elevation, 0.01, 100.0), 0)
            << elevation << ", with a depth buffer that is coarse there";
        EXPECT_EQ(unlit(8.0, 0.5, elevation, 4.0, 20.0, 200), 0)
            << elevation << ", with one that is fine, and small triangles";
        EXPECT_EQ(unlit(0.008, 0.003, elevation, 0.001, 0.1), 0) << elevation << ", in millimetres";
        EXPECT_EQ(unlit(500.0, 2.0, elevation, 0.5, 2000.0), 0) << elevation << ", to the horizon";
    }
}

TEST(Traced, NothingLeaksWhereABoxStandsOnTheGround) {
    TracedCase given = labEight();
    given.meshes = {square(8.0), box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0})};
    given.view = perspective({2.0, 9.0, 2.0}, {0.0, 1.0, 0.0}, 640, 480, 20.0);
    given.light = {0.3, -1.0, 0.8, 0.0};
    const CaseTrial result = draw(given);
    std::cout << "contact: " << result.comparison << "\n";
    EXPECT_TRUE(result.comparison.good()) << result.comparison;
    EXPECT_LE(result.comparison.certain, result.comparison.pixels / 10000);
}

TEST(Traced, FindsTheProjectionThatIsDrawnUnderAutomaticNearAndFar) {
    const TracedCase given = labEight();
    Scene lit = given.build(), dark = given.build(), shadowed = given.build();
    dark.takeLightAway();
    shadowed.addShadow(new gnomon::TracedShadowTechnique);
    const auto picture = [&](Scene& scene) {
        Camera camera(scene.root, given.view);
        camera.viewer().getCamera()->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
        return camera.frame();
    };
    const TruthComparison comparison = compare(picture(shadowed), picture(lit), picture(dark), given.truth());
    EXPECT_TRUE(comparison.good()) << comparison;
}

TEST(Traced, TakesEachOfSeveralLightsFromWhereItDoesNotReach) {
    const TracedCase given = labEight();
    const osg::Vec4d second(-1.0, -0.5, 0.9, 0.0);
    const auto picture = [&](bool traced, bool firstOff, bool secondOff) {
        Scene scene = given.build();
        osg::ref_ptr<osg::LightSource> more = new osg::LightSource;
        more->getLight()->setLightNum(1);
        more->getLight()->setPosition(osg::Vec4(second));
        more->getLight()->setAmbient({0.0f, 0.0f, 0.0f, 1.0f});
        more->getLight()->setDiffuse(secondOff ? osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f) : osg::Vec4(0.1f, 0.2f, 0.3f, 1.0f));
        more->getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        scene.root->addChild(more);
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        if (firstOff) scene.takeLightAway();
        if (traced) scene.addShadow(new gnomon::TracedShadowTechnique);
        return render(scene.root, given.view);
    };
    const Picture combination[2][2] = {{picture(false, false, false), picture(false, false, true)},
                                       {picture(false, true, false), picture(false, true, true)}};
    const Picture traced = picture(true, false, false);
    const gnomon::TruthImage a = given.truth(), b = truthOf(given.meshes, second, given.view);
    int wrong = 0, both = 0;
    for (std::size_t i = 0; i < traced.pixels.size(); ++i) {
        if (a.pixels[i].isEdge() || b.pixels[i].isEdge() || !a.pixels[i].seen()) continue;
        wrong += traced.pixels[i] != combination[!a.pixels[i].litCentre][!b.pixels[i].litCentre].pixels[i];
        both +=
            !a.pixels[i].litCentre && !b.pixels[i].litCentre && a.pixels[i].facing > 0.0 && b.pixels[i].facing > 0.0;
    }
    EXPECT_GT(both, 100);
    EXPECT_LE(wrong, 640 * 480 / 2000) << "silhouettes, where the rasteriser decides";
}

TEST(Traced, BuildsOnceARevisionHoweverManyFramesAndLights) {
    const TracedCase given = labEight();
    Scene scene = given.build();
    const osg::ref_ptr<gnomon::TracedShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
    mover->addChild(node(box({3.0, 3.0, 1.0}, {4.0, 4.0, 2.0})));
    scene.content->addChild(mover);
    scene.addShadow(technique);
    scene.group->addLight({0, given.light});
    scene.group->addLight({1, {0.0, 0.5, 1.0, 0.0}});
    Camera camera(scene.root, given.view);
    const Picture first = camera.frame();
    EXPECT_EQ(camera.frame().different(first), 0);
    EXPECT_EQ(technique->builds(), 1u);
    mover->setMatrix(osg::Matrixd::translate(0.0, -2.0, 0.0));
    EXPECT_GT(camera.frame().different(first), 100);
    EXPECT_EQ(technique->builds(), 2u);
}

TEST(Traced, ALightThatIsNowhereIsDiagnosed) {
    const TracedCase given = labEight();
    for (const osg::Vec4d& light :
         {osg::Vec4d(0.0, 0.0, 0.0, 0.0), osg::Vec4d(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0, 1.0)}) {
        Scene scene = given.build(), lit = given.build();
        const osg::ref_ptr<gnomon::TracedShadowTechnique> technique = new gnomon::TracedShadowTechnique;
        scene.addShadow(technique);
        scene.group->addLight({0, light});
        EXPECT_EQ(render(scene.root, given.view).different(render(lit.root, given.view)), 0);
        ASSERT_EQ(technique->diagnose().size(), 1u);
        EXPECT_NE(technique->diagnose()[0].find("no finite position or direction"), std::string::npos)
            << technique->diagnose()[0];
    }
}

TEST(Traced, ShadowsOutOfSightCostNothingAndSayNothing) {
    TracedCase given = labEight();
    given.view = perspective({0.0, -40.0, 5.0}, {0.0, -80.0, 5.0}, 64, 48);
    Scene scene = given.build();
    const osg::ref_ptr<gnomon::TracedShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    scene.addShadow(technique);
    scene.group->addLight({0, given.light});
    render(scene.root, given.view);
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
}

} // namespace
