// SPDX-License-Identifier: MIT
// OpenGL's state after the compositor is that of a frame without it: what is drawn next finds what it would have found.
#include "GlComplaints.h"
#include "GlSnapshot.h"
#include "TwoGrounds.h"

#include <osg/AlphaFunc>
#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/LineWidth>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/Scissor>
#include <osg/ShadeModel>
#include <osg/Stencil>
#include <osg/Texture2D>

#include <tuple>

using namespace test;

namespace {

using gnomon::ShadowCasterGroup;

osg::ref_ptr<osg::Texture2D> texture() {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(4, 4, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < image->getTotalSizeInBytes(); ++i) image->data()[i] = static_cast<unsigned char>(37 * i);
    return new osg::Texture2D(image);
}

/// Attributes of what the compositor sets itself, not switched on.
void offButGiven(osg::StateSet& set) {
    osg::ref_ptr<osg::Stencil> stencil = new osg::Stencil;
    stencil->setFunction(osg::Stencil::LESS, 3, 0x55);
    stencil->setOperation(osg::Stencil::KEEP, osg::Stencil::INCR, osg::Stencil::DECR);
    stencil->setWriteMask(0x33);
    set.setAttribute(stencil);
    set.setAttribute(new osg::BlendColor({0.1f, 0.2f, 0.3f, 0.4f}));
    set.setAttribute(new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::SRC_COLOR));
    set.setAttribute(new osg::Scissor(5, 6, 100, 90));
}

/// State that leaves a leaf plain, so that the short way stays open.
void plain(osg::StateSet& set) {
    set.setTextureAttributeAndModes(0, texture());
    set.setTextureAttributeAndModes(2, texture());
    set.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    set.setAttribute(new osg::FrontFace(osg::FrontFace::COUNTER_CLOCKWISE));
    set.setAttribute(new osg::PolygonMode);
    set.setAttribute(new osg::ShadeModel(osg::ShadeModel::SMOOTH));
    set.setAttribute(new osg::LineWidth(2.0f));
    set.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.01f));
    offButGiven(set);
}

/// State for which all must be drawn again.
void rich(osg::StateSet& set) {
    plain(set);
    set.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.1, 0.9));
    set.setAttribute(new osg::ColorMask(true, true, false, true));
    set.setAttributeAndModes(new osg::PolygonOffset(0.5f, 1.0f));
    set.setAttributeAndModes(new osg::Scissor(3, 4, 200, 150));
}

void withAProgram(osg::StateSet& set) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX,
                                       "void main() { gl_Position = ftransform(); vec3 n = gl_NormalMatrix * gl_Normal;"
                                       "gl_FrontColor = 0.3 + gl_LightSource[0].diffuse * max(0.0, n.z); }"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "void main() { gl_FragColor = gl_Color; }"));
    set.setAttribute(program);
}

osg::ref_ptr<GlProbe> addProbe(osg::Group& parent, osg::StateSet* set, int bin) {
    osg::ref_ptr<osg::Group> above = new osg::Group;
    const osg::ref_ptr<GlProbe> probe = new GlProbe;
    above->getOrCreateStateSet()->setRenderBinDetails(bin, "RenderBin");
    above->addChild(probe);
    probe->setStateSet(set);
    parent.addChild(above);
    return probe;
}

/// Leaves that blend, clear in their lower half, over both grounds.
osg::ref_ptr<osg::Geode> sheet() {
    const osg::ref_ptr<osg::Geode> sheet = node(quad({-8.0, -8.0, 0.3}, {16.0, 0, 0}, {0, 16.0, 0}), "sheet");
    osg::Geometry& geometry = *sheet->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (const osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray()))
        colors->push_back({1.0f, 1.0f, 1.0f, vertex.y() > 0.0f ? 1.0f : 0.0f});
    geometry.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    sheet->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    sheet->getStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    sheet->getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return sheet;
}

/// What leaves in bins after the compositor's find, with the grounds' state set and with none, and who comes after the
/// frame: in frames 1 and 3.
std::vector<GlSnapshot> seen(const TwoGrounds& place, void (*state)(osg::StateSet&), const Change& addShadow) {
    Scene scene = place.build();
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    state(*set);
    for (const char* name : {"left", "right"}) find(*scene.root, name)->setStateSet(set);
    addShadow(scene);
    const auto same = addProbe(*scene.root, set, 11), bare = addProbe(*scene.root, nullptr, 9),
               later = addProbe(*scene.root, set, 12);
    Camera camera(scene.root, place.view);
    const osg::ref_ptr<GlProbeCallback> end = new GlProbeCallback;
    camera.viewer().getCamera()->setFinalDrawCallback(end);
    const GlComplaints complaints(camera);
    std::vector<GlSnapshot> result;
    for (int frame = 1; frame <= 3; ++frame) {
        camera.frame();
        if (frame != 2) result.insert(result.end(), {same->seen(), bare->seen(), later->seen(), end->seen()});
    }
    EXPECT_EQ(complaints.all(), std::vector<std::string>());
    return result;
}

/// Then OpenGL keeps what the compositor left, for osg::State has nothing to set.
void nothing(osg::StateSet&) {}

struct Kind {
    const char* name;
    void (*set)(osg::StateSet&);
};

class GlState : public testing::TestWithParam<std::tuple<TwoGrounds, ShadowCasterGroup::Composite>> {};
INSTANTIATE_TEST_SUITE_P(Planar, GlState,
                         testing::Combine(testing::ValuesIn(allTwoGrounds()),
                                          testing::Values(ShadowCasterGroup::RELIGHT, ShadowCasterGroup::BLEND)),
                         [](const auto& given) {
                             return nameOf(std::get<0>(given.param)) + (std::get<1>(given.param) ? "Blend" : "Relight");
                         });

} // namespace

TEST(GlComplaints, HearAnErrorWithItsText) {
    struct Wrong : GlProbe {
        void drawImplementation(osg::RenderInfo&) const override { glEnable(GL_TRIANGLES); }
    };
    const osg::ref_ptr<Wrong> wrong = new Wrong;
    Camera camera(wrong, fromAbove(1.0, 16));
    const GlComplaints complaints(camera);
    EXPECT_EQ(complaints.all().size(), 0u);
    camera.frame();
    ASSERT_EQ(complaints.all().size(), 2u); // the text and the number
    EXPECT_NE(complaints.all()[0].find("glEnable"), std::string::npos);
}

TEST_P(GlState, IsThatOfAFrameWithoutGnomon) {
    const TwoGrounds& place = std::get<0>(GetParam());
    const auto addShadow = [&](Scene& scene) {
        place.addShadow(scene);
        scene.group->setComposite(std::get<1>(GetParam()));
    };
    for (const Kind& kind : {Kind{"plain", plain}, {"rich", rich}, {"program", withAProgram}, {"nothing", nothing}}) {
        const std::vector<GlSnapshot> expected = seen(place, kind.set, [](Scene&) {}),
                                      actual = seen(place, kind.set, addShadow);
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(difference(expected[i], actual[i]), "") << kind.name << ", snapshot " << i;
    }
}

TEST(GlStateAfterSmoothEdges, IsThatOfAFrameWithoutGnomon) {
    const TwoGrounds place;
    for (const Kind& kind : {Kind{"rich", rich}, {"nothing", nothing}}) {
        const std::vector<GlSnapshot> expected = seen(place, kind.set, [](Scene&) {});
        for (const std::string spec :
             {"planar:edges=smooth,receiver=grounds", "planar:edges=smooth,receiver=grounds,composite=blend",
              "hull:edges=smooth,receiver=grounds", "volume:edges=smooth", "volume:edges=smooth,composite=blend",
              "traced:edges=smooth"}) {
            const std::vector<GlSnapshot> actual = seen(place, kind.set, [&](Scene& scene) { scene.addShadow(spec); });
            for (std::size_t i = 0; i < expected.size(); ++i)
                EXPECT_EQ(difference(expected[i], actual[i]), "") << kind.name << ", " << spec << ", snapshot " << i;
        }
    }
}

TEST(GlStateAfterLeavesThatBlend, IsThatOfAFrameWithoutGnomon) {
    const TwoGrounds place;
    for (const Kind& kind : {Kind{"plain", plain}, {"rich", rich}, {"program", withAProgram}, {"nothing", nothing}}) {
        const std::vector<GlSnapshot> expected =
            seen(place, kind.set, [](Scene& scene) { scene.root->addChild(sheet()); });
        for (const std::string spec : {"map", "map:composite=blend", "volume", "traced:edges=smooth"}) {
            const std::vector<GlSnapshot> actual = seen(place, kind.set, [&](Scene& scene) {
                scene.addShadow(spec);
                scene.root->addChild(sheet());
            });
            for (std::size_t i = 0; i < expected.size(); ++i)
                EXPECT_EQ(difference(expected[i], actual[i]), "") << kind.name << ", " << spec << ", snapshot " << i;
        }
    }
}
