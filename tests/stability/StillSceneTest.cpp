// SPDX-License-Identifier: MIT
// A scene that stands still, copies of it, and what its frames leave behind in OpenGL and in memory.
#include "Trial.h"

#include <malloc.h>

#include <algorithm>
#include <cstring>
#include <memory>

using namespace test;

namespace {

Trial standing() {
    Trial trial;
    trial.casters = {box({-2.0, -0.5, 0.0}, {-1.0, 0.5, 1.0}), sphere({1.0, 1.0, 0.5}, 0.75, 16)};
    trial.view = perspective({-6.0, -7.0, 5.0}, {0.0, 0.0, 0.0}, 96, 96);
    return trial;
}

/// Bytes in use in this program, whoever asked for them: new, malloc, Mesa. Memory that a sanitizer hands out is not
/// among them.
std::size_t bytesInUse() { return mallinfo2().uordblks; }

/// Draws one frame and hands out what OpenGL reports of it, errors that OSG would fetch included.
GLenum errorAfterFrame(Camera& camera) {
    osg::GraphicsContext& context = *camera.context().graphicsContext();
    context.getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS);
    camera.frame();
    context.makeCurrent();
    const GLenum error = glGetError();
    context.releaseContext();
    return error;
}

bool isZero(const osg::Image& image) {
    const unsigned char* end = image.data() + image.getTotalSizeInBytes();
    return std::all_of(image.data(), end, [](unsigned char byte) { return byte == 0; });
}

/// Each way through the compositor: relit or blended, with and without a named receiver.
template <class Check>
void forEachWay(const Check& check) {
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND})
        for (const bool named : {false, true}) {
            SCOPED_TRACE(testing::Message() << (composite == gnomon::ShadowCasterGroup::BLEND ? "blended" : "relit")
                                            << (named ? ", receiver named" : ""));
            Scene scene = standing().build();
            scene.addShadow(castingTechnique(named ? find(*scene.root, "ground") : nullptr));
            scene.group->setComposite(composite);
            check(scene);
        }
}

GNOMON_BY_TECHNIQUE(StillScene);
GNOMON_BY_SMOOTH_TECHNIQUE(Frames);
GNOMON_BY_SMOOTH_TECHNIQUE(SecondViewer);
GNOMON_BY_SMOOTH_TECHNIQUE(ReleasedGLObjects);
GNOMON_BY_SMOOTH_TECHNIQUE(LostContext);
GNOMON_BY_SMOOTH_TECHNIQUE(DeepCopy);
GNOMON_BY_SMOOTH_TECHNIQUE(ShallowCopy);

} // namespace

TEST_P(StillScene, ExtractsNothingAndKeepsNoMemoryInThreeHundredFrames) {
    forEachWay([](Scene& scene) {
        Camera camera(scene.root, standing().view);
        const auto frames = [&camera](int count) {
            for (int i = 0; i < count; ++i) camera.viewer().frame();
        };
        frames(50);
        const std::size_t before = bytesInUse();
        frames(300);
        const std::size_t after = bytesInUse();
        EXPECT_EQ(scene.group->revision(), 1u);
        // A page for what the driver's own threads hold at the moment of asking; one pointer kept a frame takes two, for
        // no allocation has less than 32 bytes.
        EXPECT_LE(after, before + 4096);
    });
}

TEST_P(Frames, LeaveNoErrorInOpenGL) {
    forEachWay([](Scene& scene) {
        Camera camera(scene.root, standing().view);
        for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(errorAfterFrame(camera), GLenum(GL_NO_ERROR));
    });
}

TEST_P(Frames, LeaveTheStencilBufferZero) {
    forEachWay([](Scene& scene) {
        Camera camera(scene.root, standing().view);
        for (int frame = 0; frame < 3; ++frame) {
            camera.frame();
            EXPECT_TRUE(isZero(*camera.context().stencil()));
        }
    });
}

TEST_P(Frames, LeaveTheDepthOfTheSceneWithoutShadows) {
    const Scene plain = standing().build();
    Camera without(plain.root, standing().view);
    without.frame();
    const osg::ref_ptr<osg::Image> expected = without.context().depth();
    forEachWay([&expected](Scene& scene) {
        Camera camera(scene.root, standing().view);
        camera.frame();
        const osg::ref_ptr<osg::Image> depth = camera.context().depth();
        EXPECT_EQ(std::memcmp(depth->data(), expected->data(), expected->getTotalSizeInBytes()), 0);
    });
}

TEST_P(SecondViewer, OfTheSameSceneShowsTheSameBits) {
    forEachWay([](Scene& scene) {
        Camera first(scene.root, standing().view);
        const Picture expected = first.frame();
        Camera second(scene.root, standing().view);
        EXPECT_TRUE(same(second.frame(), expected));
        EXPECT_TRUE(same(first.frame(), expected));
        EXPECT_TRUE(same(second.frame(), expected));
    });
}

TEST_P(ReleasedGLObjects, AreMadeAnewInTheNextFrame) {
    forEachWay([](Scene& scene) {
        Camera camera(scene.root, standing().view);
        const Picture expected = camera.frame();
        for (int again = 0; again < 2; ++again) {
            osg::GraphicsContext& context = *camera.context().graphicsContext();
            context.makeCurrent();
            scene.root->releaseGLObjects(context.getState());
            context.releaseContext();
            EXPECT_TRUE(same(camera.frame(), expected));
        }
    });
}

// OSG gives the number of a context that is gone to the next one, of which OpenGL's names mean other things.
TEST_P(LostContext, IsFollowedByOneThatShowsTheSameBits) {
    forEachWay([](Scene& scene) {
        const auto picture = [&scene] {
            Camera camera(scene.root, standing().view);
            camera.frame();
            return camera.frame();
        };
        const Picture expected = picture();
        for (int again = 0; again < 2; ++again) EXPECT_TRUE(same(picture(), expected));
    });
}

/// Closes a viewer's context when it can no longer be made current: nothing of it can be deleted.
TEST_P(LostContext, ThatCannotBeMadeCurrentAnyMoreIsFollowedByOneThatShowsTheSameBits) {
    forEachWay([](Scene& scene) {
        auto lost = std::make_unique<Camera>(scene.root, standing().view);
        const Picture expected = lost->frame();
        lost->context().graphicsContext()->close(false);
        lost = nullptr;
        Camera next(scene.root, standing().view);
        for (int frame = 0; frame < 2; ++frame) EXPECT_TRUE(same(next.frame(), expected));
    });
}

TEST_P(DeepCopy, OfTheSceneShowsTheSameBits) {
    forEachWay([](Scene& scene) {
        const Picture expected = render(scene.root, standing().view);
        osg::ref_ptr<osg::Group> copy = osg::clone(scene.root.get(), osg::CopyOp::DEEP_COPY_ALL);
        EXPECT_TRUE(same(render(copy, standing().view), expected));
        scene.group->removeChildren(0, scene.group->getNumChildren()); // the copy has all that is its own
        EXPECT_TRUE(same(render(copy, standing().view), expected));
    });
}

TEST_P(DeepCopy, OfTheGroupAloneShowsTheSameBits) {
    forEachWay([](Scene& scene) {
        const Picture expected = render(scene.root, standing().view);
        osg::ref_ptr<gnomon::ShadowCasterGroup> copy = osg::clone(scene.group.get(), osg::CopyOp::DEEP_COPY_ALL);
        scene.root->replaceChild(scene.group, copy);
        EXPECT_TRUE(same(render(scene.root, standing().view), expected));
    });
}

TEST_P(DeepCopy, CastsFromItsOwnSelectionAndItsOwnLight) {
    Scene scene = standing().buildWithShadow();
    scene.root->removeChild(scene.light);
    scene.content->addChild(scene.light);
    scene.group->setCasters({find(*scene.root, "caster")});
    scene.group->addLight(scene.light);
    const Picture expected = render(scene.root, standing().view);
    EXPECT_GT(expected.count(shadowedGround), 50);
    osg::ref_ptr<osg::Group> copy = osg::clone(scene.root.get(), osg::CopyOp::DEEP_COPY_ALL);
    EXPECT_TRUE(same(render(copy, standing().view), expected));
}

TEST_P(ShallowCopy, OfTheGroupShowsTheSameBits) {
    forEachWay([](Scene& scene) {
        const Picture expected = render(scene.root, standing().view);
        osg::ref_ptr<gnomon::ShadowCasterGroup> copy = osg::clone(scene.group.get(), osg::CopyOp::SHALLOW_COPY);
        scene.root->replaceChild(scene.group, copy);
        EXPECT_TRUE(same(render(scene.root, standing().view), expected));
    });
}
