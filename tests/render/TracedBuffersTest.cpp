// SPDX-License-Identifier: MIT
// Traced shadows in framebuffer objects with several samples, whose depth has to be resolved before it can be read.
#include "DrawnInto.h"

#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/ContextData>
#include <osg/GLExtensions>

#include <iostream>

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

} // namespace
