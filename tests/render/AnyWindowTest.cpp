// SPDX-License-Identifier: MIT
// Framebuffers without stencil or alpha bits, or whose stencil is somebody else's: the picture of one that has them to
// spare, bit for bit.
#include "IntoTexture.h"

#include <gnomon/ViewFrame.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/WorkFramebuffer.h>
#include <support/Causes.h>
#include <support/Oracle.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/ColorMask>
#include <osg/ContextData>
#include <osg/Image>
#include <osg/Stencil>

#include <algorithm>

using namespace test;

namespace {

using gnomon::HeadlessContext;

const View slanted = perspective({-6.0, -9.0, 6.0}, {0.0, 0.5, 0.0}, 161, 121);
const std::vector<Mesh> casters = {house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0), sphere({-1.5, 1.5, 1.0}, 0.7, 10)};

Scene shadowed(const std::string& spec, int lights = 1) {
    Scene scene = groundScene(casters, 8.0, {1.0, 0.4, 1.2, 0.0});
    if (lights > 1) scene.addSecondLight();
    if (!spec.empty()) scene.addShadow(spec);
    return scene;
}

/// The third frame: all that is learnt from a frame before is known.
Picture third(Camera& camera) {
    camera.frame();
    camera.frame();
    return camera.frame();
}

Picture inWindow(osg::Node* root, int stencilBits, int depthBits = 24) {
    HeadlessContext::Options options;
    options.stencilBits = stencilBits;
    options.depthBits = depthBits;
    Camera camera(root, slanted, options);
    const GlComplaints complaints(camera);
    const Picture picture = third(camera);
    EXPECT_EQ(complaints.all(), std::vector<std::string>());
    return picture;
}

Picture inObject(osg::Node* root, const Target& target) {
    IntoTexture into(root, slanted, target);
    const Picture picture = third(*into.camera);
    EXPECT_EQ(into.complaints->all(), std::vector<std::string>());
    return picture;
}

Target without(unsigned samples, GLenum color = GL_RGBA8) {
    return {color, osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24, samples};
}

std::string nameOf(std::string spec) {
    const auto isWord = [](unsigned char c) { return std::isalnum(c) != 0; };
    std::replace_if(
        spec.begin(), spec.end(), [=](unsigned char c) { return !isWord(c); }, '_');
    return spec;
}

/// Causes of all techniques of a scene.
std::vector<std::string> causesOf(const Scene& scene) {
    std::vector<std::string> all;
    for (unsigned i = 0; i < scene.group->getNumChildren(); ++i)
        if (const auto* technique = dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(i)))
            for (const std::string& cause : causesButLitSurfaces(*technique))
                all.push_back(cause); // one casts on another
    return all;
}

class NoMarks : public gnomon::Mark {
public:
    std::string draw(gnomon::ScreenPass&) const override { return ""; }
};

/// Marks nothing, and counts how often it is asked to.
class CountingTechnique : public gnomon::ShadowTechnique {
public:
    META_Node(test, CountingTechnique)
    CountingTechnique() = default;
    CountingTechnique(const CountingTechnique& other, const osg::CopyOp& copyOp) : ShadowTechnique(other, copyOp) {}
    mutable int asked = 0;

protected:
    ~CountingTechnique() override = default;
    std::vector<osg::ref_ptr<gnomon::Mark>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                    const gnomon::Casters& casters) const override;
};

std::vector<osg::ref_ptr<gnomon::Mark>> CountingTechnique::prepare(const gnomon::ViewFrame&, const gnomon::ShadowLight&,
                                                                   const gnomon::Casters&) const {
    ++asked;
    return {new NoMarks};
}

/// A white fence behind the house, drawn late: half of it is clear, half of it lets a fifth of what is behind through.
osg::ref_ptr<osg::Geode> fence() {
    const osg::ref_ptr<osg::Geode> geode = node(quad({-3.0, 2.0, 0.0}, {6.0, 0.0, 0.0}, {0.0, 0.0, 2.0}), "fence");
    osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray()))
        places->push_back({vertex.x() * 2.0f, vertex.z()});
    geometry.setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (const unsigned x : {0u, 1u}) image->setColor({1.0f, 1.0f, 1.0f, x ? 0.8f : 0.0f}, x, 0);
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto filter : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(filter, osg::Texture::NEAREST);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    geode->getStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    geode->getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return geode;
}

/// Writes 5 into the stencil buffer where it is drawn, which no eye sees.
osg::ref_ptr<osg::Geode> stencilMarks() {
    osg::ref_ptr<osg::Geode> marks = node(square(2.0, 0.01));
    osg::ref_ptr<osg::Stencil> five = new osg::Stencil;
    five->setFunction(osg::Stencil::ALWAYS, 5, ~0u);
    five->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::REPLACE);
    marks->getOrCreateStateSet()->setAttributeAndModes(five);
    marks->getStateSet()->setAttributeAndModes(new osg::ColorMask(false, false, false, false));
    return marks;
}

/// Of this scene alone box has a cause in any window: it casts bounding boxes, which differ from these casters.
void expectNoCausesButThoseOfBox(const std::string& spec, const Scene& scene, const Scene& withStencil) {
    EXPECT_EQ(causesOf(scene), causesOf(withStencil));
    if (spec != "box") EXPECT_EQ(causesOf(scene), std::vector<std::string>());
}

class AnyWindowBy : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(AnyWindow, AnyWindowBy,
                         testing::Values("planar", "planar:composite=blend", "box", "hull", "hull:composite=blend",
                                         "traced", "traced:composite=blend", "map", "map:composite=blend",
                                         "map:receiver=ground", "map:edges=smooth", "map:edges=smooth,composite=blend",
                                         "map:edges=soft,sun-angle=4", "volume", "volume:composite=blend",
                                         "planar:edges=smooth,composite=blend", "planar:edges=smooth",
                                         "hull:edges=smooth", "hull:edges=smooth,composite=blend",
                                         "volume:edges=smooth", "volume:edges=smooth,receiver=ground",
                                         "traced:edges=smooth"),
                         [](const auto& spec) { return nameOf(spec.param); });

} // namespace

TEST_P(AnyWindowBy, WithoutStencilShowsTheSameBits) {
    for (const int lights : {1, 2}) {
        const Scene withStencil = shadowed(GetParam(), lights);
        const Picture with = inWindow(withStencil.root, 8);
        EXPECT_GT(with.different(inWindow(shadowed("", lights).root, 8)), 300);
        const Scene scene = shadowed(GetParam(), lights);
        EXPECT_EQ(inWindow(scene.root, 0).different(with), 0) << lights;
        expectNoCausesButThoseOfBox(GetParam(), scene, withStencil);
    }
}

/// As osgViewer leaves viewports after a resize. OpenGL has none of the fractions: osg::Viewport::apply() drops them.
TEST_P(AnyWindowBy, WhoseViewportHasFractionsShowsTheBitsOfTheWholeOne) {
    const auto drawn = [](const std::string& spec, const osg::ref_ptr<osg::Viewport>& viewport) {
        Camera camera(shadowed(spec).root, slanted);
        camera.viewer().getCamera()->setViewport(viewport);
        return third(camera);
    };
    const auto whole = [] { return new osg::Viewport(23, 11, 130, 97); };
    const Picture with = drawn(GetParam(), whole());
    EXPECT_GT(with.different(drawn("", whole())), 200);
    EXPECT_EQ(drawn(GetParam(), new osg::Viewport(23.97, 11.94, 130.91, 97.83)).different(with), 0);
}

TEST_P(AnyWindowBy, AnObjectWithoutStencilAndOneWithoutAlphaShowTheSameBits) {
    for (const unsigned samples : {0u, 4u}) {
        const Scene withStencil = shadowed(GetParam());
        const Picture with = inObject(
            withStencil.root, {GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, samples});
        EXPECT_GT(with.different(inObject(shadowed("").root, without(samples))), 300);
        const Scene scene = shadowed(GetParam());
        EXPECT_EQ(inObject(scene.root, without(samples)).different(with), 0) << samples;
        EXPECT_EQ(inObject(shadowed(GetParam()).root, without(samples, GL_RGB8)).different(with), 0) << samples;
        expectNoCausesButThoseOfBox(GetParam(), scene, withStencil);
    }
}

/// Of several samples the frame's colours cannot be saved: such leaves take the factor there, and the technique says so.
TEST(AnyWindow, LeavesThatBlendShowTheSameShadowsInAll) {
    const View view = perspective({-6.0, 14.0, 6.0}, {0.0, 0.5, 0.0}, 161, 121); // the fence before the house
    const auto build = [](const std::string& spec, int lights) {
        Scene scene = shadowed(spec, lights);
        scene.content->addChild(fence());
        return scene;
    };
    for (const char* spec : {"map", "map:composite=blend", "traced", "volume"})
        for (const int lights : {1, 2}) {
            const Scene scene = build(spec, lights), lit = build("", lights);
            Camera camera(scene.root, view), litCamera(lit.root, view);
            const GlComplaints complaints(camera);
            const Picture with = third(camera);
            EXPECT_EQ(complaints.all(), std::vector<std::string>());
            EXPECT_GT(with.different(third(litCamera)), 150);
            HeadlessContext::Options bare;
            bare.stencilBits = 0;
            Camera bareCamera(build(spec, lights).root, view, bare);
            EXPECT_EQ(third(bareCamera).different(with), 0) << spec << lights;
            IntoTexture object(build(spec, lights).root, view, without(0)),
                packed(build(spec, lights).root, view, withDepth(depth24));
            EXPECT_EQ(third(*object.camera).different(third(*packed.camera)), 0) << spec << lights;
            EXPECT_LE(third(*object.camera).different(with), 15) << spec << lights << ": edges, as a map draws them";
            const Scene sampled = build(spec, lights), litSampled = build("", lights);
            IntoTexture samples(sampled.root, view, without(4)), none(litSampled.root, view, without(4));
            EXPECT_GT(third(*samples.camera).different(third(*none.camera)), 150) << spec << lights;
            EXPECT_EQ(samples.complaints->all(), std::vector<std::string>());
            const std::vector<std::string> said = causesOf(sampled);
            const auto tells = [](const std::string& cause) {
                return cause.find("in a multisampled framebuffer object") != std::string::npos;
            };
            const bool blends = std::string(spec).find("blend") != std::string::npos;
            EXPECT_EQ(std::any_of(said.begin(), said.end(), tells), !blends) << spec << lights;
        }
}

TEST(AnyWindow, WithStencilMakesNoBuffersAndCopiesNothing) {
    for (const int bits : {8, 0}) {
        HeadlessContext::Options options;
        options.stencilBits = bits;
        Camera camera(shadowed("planar").root, slanted, options);
        third(camera);
        const unsigned context = camera.context().graphicsContext()->getState()->getContextID();
        EXPECT_EQ(osg::get<gnomon::WorkBuffers>(context)->empty(), bits == 8);
    }
}

/// Where the height of a window is not known, its rows cannot be told from the top, and depths are drawn once more.
TEST(AnyWindow, OfAnUnknownHeightShowsTheSameShadows) {
    for (const char* spec : {"planar", "planar:composite=blend", "map:edges=smooth", "traced:receiver=ground"}) {
        const Picture with = inWindow(shadowed(spec).root, 8);
        HeadlessContext::Options options;
        options.stencilBits = 0;
        const Scene scene = shadowed(spec);
        Camera camera(scene.root, slanted, options);
        const_cast<osg::GraphicsContext::Traits*>(camera.context().graphicsContext()->getTraits())->height = 1;
        EXPECT_LT(third(camera).different(with), 20) << spec << ": edges alone may be rounded otherwise";
        EXPECT_EQ(causesOf(scene), std::vector<std::string>());
    }
}

TEST(AnyWindow, TheMarksOfAProgramStay) {
    const auto stencilOf = [](const std::string& spec) {
        const Scene scene = shadowed(spec);
        scene.root->addChild(stencilMarks());
        Camera camera(scene.root, slanted);
        third(camera);
        const osg::ref_ptr<osg::Image> bits = camera.context().stencil();
        return std::vector<unsigned char>(bits->data(), bits->data() + bits->getTotalSizeInBytes());
    };
    const std::vector<unsigned char> without = stencilOf("");
    EXPECT_GT(std::count(without.begin(), without.end(), 5), 500);
    for (const char* spec : {"planar", "planar:composite=blend", "map", "hull"})
        EXPECT_EQ(stencilOf(spec), without) << spec;
}

/// Of several samples no depths are handed over: they are drawn again, and with them what its own test hides.
TEST(AnyWindow, SaysThatWhatAStencilTestHidesTakesShadowsAwayWhereDepthsAreDrawnAgain) {
    for (const auto function : {osg::Stencil::ALWAYS, osg::Stencil::EQUAL}) {
        const Scene scene = shadowed("planar:composite=blend");
        const osg::ref_ptr<osg::Geode> above = node(square(4.0, 2.5));
        const osg::ref_ptr<osg::Stencil> test = new osg::Stencil;
        test->setFunction(function, 1, 1u);
        above->getOrCreateStateSet()->setAttributeAndModes(test);
        scene.root->addChild(above);
        IntoTexture into(scene.root, slanted,
                         {GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, 4});
        third(*into.camera);
        int told = 0;
        for (const std::string& cause : causesOf(scene))
            told += cause.find("OpenGL hands over no depths") != cause.npos;
        EXPECT_EQ(told, function == osg::Stencil::ALWAYS ? 0 : 1);
    }
}

TEST(AnyWindow, WhatCannotBeDrawnIsPreparedOnceAndAgainWhenItCan) {
    Scene scene = groundScene(casters);
    const osg::ref_ptr<CountingTechnique> technique = new CountingTechnique;
    scene.addShadow(technique);
    Camera camera(scene.root, slanted);
    osg::Camera& view = *camera.viewer().getCamera();
    view.setClearDepth(0.5);
    for (int frame = 0; frame < 4; ++frame) {
        camera.frame();
        EXPECT_EQ(technique->asked, 1);
        ASSERT_EQ(technique->diagnose().size(), 1u);
        EXPECT_NE(technique->diagnose()[0].find("cleared to less than 1"), std::string::npos);
    }
    view.setClearDepth(1.0);
    camera.frame(); // finds that it can
    camera.frame();
    EXPECT_EQ(technique->asked, 2);
    EXPECT_TRUE(technique->diagnose().empty());
}
