// SPDX-License-Identifier: MIT
// What is drawn into: textures, framebuffers with and without stencil, alpha or several samples; and a stencil buffer
// that the application uses too.
#include "IntoTexture.h"
#include "TwoGrounds.h"
#include <support/Causes.h>

#include <osg/ClearNode>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Stencil>

#include <algorithm>
#include <memory>

using namespace test;

namespace {

enum Drawn { Lit, Dark, Shadowed };

/// Two grounds drawn into a framebuffer object.
struct Rtt {
    Rtt(const TwoGrounds& place, const Target& target, Drawn drawn, bool besideTheScene = false) {
        Scene scene = place.build();
        if (drawn == Dark) scene.takeLightAway();
        if (drawn == Shadowed) technique = place.addShadow(scene);
        into = std::make_unique<IntoTexture>(scene.root, place.view, target, besideTheScene);
        camera = into->camera.get();
        complaints = into->complaints.get();
    }

    osg::ref_ptr<gnomon::PlanarShadowNode> technique;
    std::unique_ptr<IntoTexture> into;
    Camera* camera = nullptr;
    GlComplaints* complaints = nullptr;
};

::testing::AssertionResult isExactInto(const TwoGrounds& place, const Target& target) {
    Rtt lit(place, target, Lit), dark(place, target, Dark), shadowed(place, target, Shadowed);
    const Picture litPicture = lit.camera->frame(), darkPicture = dark.camera->frame();
    const Frames actual = frames(*shadowed.camera);
    const Mask mask = place.mask();
    if (auto first = judge(actual.first, litPicture, darkPicture, mask); !first) return first << ", first frame";
    if (auto third = judge(actual.third, litPicture, darkPicture, mask); !third) return third << ", third frame";
    const std::vector<std::string> causes = causesButLitSurfaces(*shadowed.technique); // the right ground may be lit
    if (!causes.empty()) return ::testing::AssertionFailure() << causes[0];
    if (!shadowed.complaints->all().empty()) return ::testing::AssertionFailure() << shadowed.complaints->all()[0];
    return ::testing::AssertionSuccess();
}

/// Whether each channel of `actual` lies between those of the other two.
bool between(std::uint32_t actual, std::uint32_t a, std::uint32_t b) {
    bool result = true;
    for (int shift = 0; shift < 32; shift += 8) {
        const auto channel = [shift](std::uint32_t pixel) { return (pixel >> shift) & 0xffu; };
        const auto [low, high] = std::minmax({channel(a), channel(b)});
        result = result && channel(actual) >= low && channel(actual) <= high;
    }
    return result;
}

/// An edge between the rays of a pixel, of which (x, y) is the first of two by two, or near it: slivers fall between rays.
bool atEdge(const Mask& mask, int x, int y) {
    bool edge = false;
    for (int v = std::max(0, y - 1); v <= std::min(mask.height - 1, y + 2); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(mask.width - 1, x + 2); ++u) edge = edge || mask.atEdge(u, v);
    return edge;
}

class FillStencil : public osg::Camera::DrawCallback {
public:
    explicit FillStencil(unsigned value) : _value(static_cast<GLint>(value)) {}
    void operator()(osg::RenderInfo& renderInfo) const override {
        glDisable(GL_SCISSOR_TEST);
        renderInfo.getState()->haveAppliedMode(GL_SCISSOR_TEST, osg::StateAttribute::OFF);
        glStencilMask(~0u);
        glClearStencil(_value);
        glClear(GL_STENCIL_BUFFER_BIT);
        renderInfo.getState()->haveAppliedAttribute(osg::StateAttribute::STENCIL);
    }

private:
    const GLint _value;
};

class Buffers : public testing::TestWithParam<TwoGrounds> {};
INSTANTIATE_TEST_SUITE_P(Planar, Buffers, testing::ValuesIn(allTwoGrounds()),
                         [](const auto& place) { return nameOf(place.param); });

} // namespace

TEST_P(Buffers, TextureWithPackedDepthAndStencil) { EXPECT_TRUE(isExactInto(GetParam(), {})); }

TEST_P(Buffers, TextureWithoutAlpha) { EXPECT_TRUE(isExactInto(GetParam(), {GL_RGB8})); }

// The same nodes in two stages of one frame: on the left as the window shows them, on the right as the texture does.
TEST_P(Buffers, TextureAndWindowShowOneSceneAtOnce) {
    const TwoGrounds& place = GetParam();
    const int width = place.view.width, height = place.view.height;
    const auto picture = [&](Drawn drawn) {
        Rtt both(place, {}, drawn, true);
        return frames(*both.camera).third;
    };
    const Picture actual = picture(Shadowed), lit = picture(Lit), dark = picture(Dark);
    for (const int left : {0, width}) {
        const auto half = [=](const Picture& whole) { return cropped(whole, left, 0, width, height); };
        EXPECT_TRUE(judge(half(actual), half(lit), half(dark), place.mask())) << left;
    }
}

TEST_P(Buffers, TextureWithoutStencilAndDepthsOfAnyFormat) {
    for (const GLenum depth : {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32})
        EXPECT_TRUE(isExactInto(GetParam(), {GL_RGBA8, osg::Camera::DEPTH_BUFFER, depth})) << depth;
    constexpr GLenum inFloat = 0x8CAC; // GL_DEPTH_COMPONENT32F
    EXPECT_TRUE(isExactInto(GetParam(), {GL_RGBA8, osg::Camera::DEPTH_BUFFER, inFloat}));
}

TEST_P(Buffers, FourSamplesSmoothTheShadowsEdges) {
    const Target target{GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, 4};
    Rtt lit(GetParam(), target, Lit), dark(GetParam(), target, Dark), shadowed(GetParam(), target, Shadowed);
    const Picture litPicture = lit.camera->frame(), darkPicture = dark.camera->frame(),
                  actual = frames(*shadowed.camera).third;
    TwoGrounds fine = GetParam(); // four rays a pixel, for the samples' sake
    fine.view.width *= 2;
    fine.view.height *= 2;
    const Mask mask = fine.mask();
    int wrong = 0, outside = 0, smooth = 0;
    for (int y = 0; y < actual.height; ++y)
        for (int x = 0; x < actual.width; ++x) {
            const std::uint32_t is = actual.at(x, y), l = litPicture.at(x, y), d = darkPicture.at(x, y);
            if (!atEdge(mask, 2 * x, 2 * y)) wrong += is != (mask.at(2 * x, 2 * y) == Seen::ShadowedReceiver ? d : l);
            outside += !between(is, l, d);
            smooth += is != l && is != d;
        }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(outside, 0);
    EXPECT_GT(smooth, 50);
    EXPECT_EQ(causesButLitSurfaces(*shadowed.technique), std::vector<std::string>());
    EXPECT_EQ(shadowed.complaints->all(), std::vector<std::string>());
}

// The colours from before the frame, which a receiver that blends must find again, cannot be read there.
TEST_P(Buffers, FourSamplesWhoseColorsAreNotClearedAndBlendedWithAreDarkenedAndSaidSo) {
    const Target target{GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, 4};
    Rtt shadowed(GetParam(), target, Shadowed);
    shadowed.into->into->setClearMask(GL_DEPTH_BUFFER_BIT);
    shadowed.into->into->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    shadowed.camera->frame();
    ASSERT_FALSE(causesButLitSurfaces(*shadowed.technique).empty());
    EXPECT_NE(causesButLitSurfaces(*shadowed.technique)[0].find("colours that the camera does not clear"),
              std::string::npos);
    EXPECT_EQ(shadowed.complaints->all(), std::vector<std::string>());
}

// The window shows what is decoded: light, of which the factor is one, whichever way the shadow is composed.
TEST_P(Buffers, EncodedColorsAreMultipliedAsLight) {
    constexpr GLenum encoded = 0x8C43, encodes = 0x8DB9; // GL_SRGB8_ALPHA8, GL_FRAMEBUFFER_SRGB
    Rtt lit(GetParam(), {encoded}, Lit), shadowed(GetParam(), {encoded}, Shadowed);
    for (Rtt* each : {&lit, &shadowed})
        each->into->into->getOrCreateStateSet()->setMode(encodes, osg::StateAttribute::ON);
    auto& group = dynamic_cast<gnomon::ShadowCasterGroup&>(*shadowed.technique->getParent(0));
    group.setComposite(gnomon::ShadowCasterGroup::BLEND);
    group.setDark(0.5f);
    const Picture is = frames(*shadowed.camera).third, was = frames(*lit.camera).third;
    const Mask mask = GetParam().mask();
    int wrong = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            for (int shift = 0; shift < 24 && !mask.atEdge(x, y); shift += 8) {
                const int one = (is.at(x, y) >> shift) & 0xff, whole = (was.at(x, y) >> shift) & 0xff;
                wrong += std::abs((mask.at(x, y) == Seen::ShadowedReceiver ? 2 : 1) * one - whole) > 4;
            }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(shadowed.complaints->all(), std::vector<std::string>());
}

// A quad in a higher bin that draws only where all stencil bits are zero.
TEST_P(Buffers, StencilOfALaterBinFindsZeros) {
    Trial trial;
    trial.change = [](Scene& scene) {
        const osg::ref_ptr<osg::Geode> glaze = node(square(6.0, 0.01));
        osg::StateSet* set = glaze->getOrCreateStateSet();
        osg::ref_ptr<osg::Stencil> zero = new osg::Stencil;
        zero->setFunction(osg::Stencil::EQUAL, 0, ~0u);
        set->setAttributeAndModes(zero);
        set->setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0.0, 1.0, false));
        set->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        set->setRenderBinDetails(12, "RenderBin");
        scene.root->addChild(glaze);
    };
    Scene scene = GetParam().build();
    trial.change(scene);
    GetParam().addShadow(scene);
    Camera camera(scene.root, GetParam().view);
    const Frames actual = frames(camera), expected = unshadowed(GetParam(), trial, false);
    EXPECT_EQ(actual.first.different(expected.first), 0);
    EXPECT_EQ(actual.third.different(expected.third), 0);
}

// Before each frame the application fills the stencil buffer, its own bits and ours.
TEST_P(Buffers, ReservedBitsKeepWhatTheApplicationWroteThereAndOursNeedNotBeZero) {
    const Frames lit = unshadowed(GetParam(), {}, false), dark = unshadowed(GetParam(), {}, true);
    for (const unsigned reserved : {0x00u, 0x0fu, 0xf0u})
        for (const unsigned filled : {0xffu, 0xaau}) {
            SCOPED_TRACE(testing::Message() << "reserved " << reserved << ", filled with " << filled);
            Scene scene = GetParam().build();
            const auto technique = GetParam().addShadow(scene);
            Camera camera(test::reserving(scene.root, reserved), GetParam().view);
            camera.viewer().getCamera()->setPreDrawCallback(new FillStencil(filled));
            const Frames actual = frames(camera);
            EXPECT_TRUE(judge(actual.first, lit.first, dark.first, GetParam().mask()));
            EXPECT_TRUE(judge(actual.third, lit.third, dark.third, GetParam().mask()));
            const osg::ref_ptr<osg::Image> stencil = camera.context().stencil();
            const auto end = stencil->data() + stencil->getTotalSizeInBytes();
            EXPECT_TRUE(
                std::all_of(stencil->data(), end, [=](auto v) { return (v & reserved) == (filled & reserved); }));
            EXPECT_EQ(causesButLitSurfaces(*technique), std::vector<std::string>());
        }
}

// The camera clears to a value of the application's, so that the stage cannot clear for us.
TEST_P(Buffers, StencilClearedToAnotherValue) {
    Trial trial;
    trial.set = [](Camera& camera) {
        camera.viewer().getCamera()->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        camera.viewer().getCamera()->setClearStencil(0xff);
    };
    Scene scene = GetParam().build();
    GetParam().addShadow(scene);
    Camera camera(scene.root, GetParam().view);
    trial.set(camera);
    const Frames actual = frames(camera), lit = unshadowed(GetParam(), trial, false),
                 dark = unshadowed(GetParam(), trial, true);
    EXPECT_TRUE(judge(actual.first, lit.first, dark.first, GetParam().mask()));
    EXPECT_TRUE(judge(actual.third, lit.third, dark.third, GetParam().mask()));
}

// It sets the stage's clear mask anew during the cull, after the group; what a later bin leaves in the stencil buffer stays
// for the next frame.
TEST_P(Buffers, ClearNodeAfterTheGroup) {
    Trial trial;
    trial.change = [](Scene& scene) {
        const osg::ref_ptr<osg::ClearNode> clear = new osg::ClearNode;
        clear->setClearColor({0.0f, 0.0f, 0.25f, 1.0f});
        scene.root->addChild(clear);
        const osg::ref_ptr<osg::Geode> marks = node(square(6.0, 0.01));
        osg::StateSet* set = marks->getOrCreateStateSet();
        osg::ref_ptr<osg::Stencil> ones = new osg::Stencil;
        ones->setFunction(osg::Stencil::ALWAYS, 0xff, ~0u);
        ones->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::REPLACE);
        set->setAttributeAndModes(ones);
        set->setAttributeAndModes(new osg::ColorMask(false, false, false, false));
        set->setRenderBinDetails(12, "RenderBin");
        scene.root->addChild(marks);
    };
    const Frames lit = unshadowed(GetParam(), trial, false), dark = unshadowed(GetParam(), trial, true);
    Scene scene = GetParam().build();
    GetParam().addShadow(scene);
    trial.change(scene); // after the group
    Camera camera(scene.root, GetParam().view);
    const Frames actual = frames(camera);
    EXPECT_TRUE(judge(actual.first, lit.first, dark.first, GetParam().mask()));
    EXPECT_TRUE(judge(actual.third, lit.third, dark.third, GetParam().mask()));
}
