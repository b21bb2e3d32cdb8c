// SPDX-License-Identifier: MIT
// Receivers that OpenGL's lights do not light, and receivers that blend.
#include <support/Causes.h>
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Program>
#include <osg/VertexProgram>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace test;

namespace {

const View slanted = perspective({-10.0, -14.0, 12.0}, {0.0, 0.0, 0.0});
const std::vector<Mesh> twoCasters = {house({-2.0, 1.0}, {2.0, 2.0, 2.0}, 30.0), sphere({3.0, 2.0, 3.0}, 1.0, 24)};

osg::ref_ptr<osg::Program> program(const char* vertex, const char* fragment) {
    osg::ref_ptr<osg::Program> result = new osg::Program;
    result->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    result->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return result;
}

using Change = std::function<void(osg::StateSet&)>;

void unlit(osg::StateSet& state) { state.setMode(GL_LIGHTING, osg::StateAttribute::OFF); }

void constantProgram(osg::StateSet& state) {
    state.setAttribute(program("void main() { gl_Position = ftransform(); }",
                               "void main() { gl_FragColor = vec4(0.8, 0.6, 0.4, 1.0); }"));
}

void litProgram(osg::StateSet& state) {
    state.setAttribute(program("varying vec4 color;\n"
                               "void main() { gl_Position = ftransform();\n"
                               "  vec3 n = normalize(gl_NormalMatrix * gl_Normal);\n"
                               "  float c = max(dot(n, normalize(gl_LightSource[0].position.xyz)), 0.0);\n"
                               "  color = 0.3 * vec4(1.0) + c * gl_LightSource[0].diffuse; }",
                               "varying vec4 color; void main() { gl_FragColor = color; }"));
}

void positionProgram(osg::StateSet& state) {
    state.setAttribute(program("varying float c;\n"
                               "void main() { gl_Position = ftransform();\n"
                               "  vec3 n = normalize(gl_NormalMatrix * gl_Normal);\n"
                               "  c = max(dot(n, normalize(gl_LightSource[0].position.xyz)), 0.0); }",
                               "varying float c; void main() { gl_FragColor = vec4(0.3 + 0.6 * c); }"));
}

/// The material's diffuse colour, but not the light's.
void materialProgram(osg::StateSet& state) {
    state.setAttribute(program("varying float c; varying vec4 diffuseColor;\n"
                               "void main() { gl_Position = ftransform();\n"
                               "  vec3 n = normalize(gl_NormalMatrix * gl_Normal);\n"
                               "  c = max(dot(n, normalize(gl_LightSource [0] . position.xyz)), 0.0);\n"
                               "  diffuseColor = gl_FrontMaterial.diffuse; }",
                               "varying float c; varying vec4 diffuseColor;\n"
                               "void main() { gl_FragColor = (0.3 + 0.6 * c) * diffuseColor; }"));
}

/// Colour: 0.6, or the light's diffuse and 0.2.
void assembly(osg::StateSet& state, const std::string& colour) {
    osg::ref_ptr<osg::VertexProgram> program = new osg::VertexProgram;
    program->setVertexProgram("!!ARBvp1.0\n"
                              "OPTION ARB_position_invariant;\n"
                              "PARAM grey = { 0.2, 0.2, 0.2, 1.0 };\n" +
                              colour + "END\n");
    state.setAttributeAndModes(program);
}

void unlitAssembly(osg::StateSet& state) { assembly(state, "MUL result.color, grey, 3.0;\n"); }

void litAssembly(osg::StateSet& state) { assembly(state, "ADD result.color, grey, state.light[0].diffuse;\n"); }

/// Depth alone, before what stands there already: a catcher of shadows.
void colorless(osg::StateSet& state) {
    state.setAttributeAndModes(new osg::ColorMask(false, false, false, false));
    state.setRenderBinDetails(-5, "RenderBin");
}

void blending(osg::StateSet& state) {
    state.setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE));
}

struct Case {
    std::string name;
    Change change;
    bool named;
    bool relit; ///< false: the receiver takes a factor instead
};

std::ostream& operator<<(std::ostream& out, const Case& given) { return out << given.name; }

Scene build(const Case& given) {
    Scene scene = groundScene(twoCasters);
    given.change(*find(*scene.root, "ground")->getOrCreateStateSet());
    return scene;
}

Picture halved(Picture picture) {
    for (std::uint32_t& pixel : picture.pixels) {
        std::uint32_t result = pixel & 0xff000000u;
        for (int shift = 0; shift < 24; shift += 8) result |= (((pixel >> shift) & 0xffu) / 2u) << shift;
        pixel = result;
    }
    return picture;
}

/// Pixels whose channels differ by more than one: half of an odd byte may be rounded up or down.
int farFrom(const Picture& a, const Picture& b, const Mask& mask) {
    int result = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            if (mask.atEdge(x, y)) continue;
            for (int shift = 0; shift < 32; shift += 8) {
                const int p = (a.at(x, y) >> shift) & 0xff, q = (b.at(x, y) >> shift) & 0xff;
                if (std::abs(p - q) > 1) {
                    ++result;
                    break;
                }
            }
        }
    return result;
}

class Receivers : public testing::TestWithParam<Case> {};

} // namespace

TEST_P(Receivers, TakeTheShadowTheyCanAndSayIfItIsNotExact) {
    const Case& given = GetParam();
    Scene lit = build(given), gone = build(given), shadowed = build(given);
    gone.takeLightAway();
    const auto technique = planar(given.named ? find(*shadowed.root, "ground") : nullptr);
    shadowed.addShadow(technique);
    const Picture litPicture = render(lit.root, slanted);
    const Picture dark = given.relit ? render(gone.root, slanted) : halved(litPicture);
    const Mask mask = castRays(square(8.0), twoCasters, {1.0, 0.0, 1.0, 0.0}, slanted);
    Picture expected = litPicture;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        if (mask.pixels[i] == Seen::ShadowedReceiver) expected.pixels[i] = dark.pixels[i];
    EXPECT_GT(expected.different(litPicture), 1000) << "the case shows no shadow to judge";
    const Picture actual = render(shadowed.root, slanted);
    EXPECT_EQ(farFrom(actual, expected, mask), 0);
    const std::vector<std::string> causes = causesButLitSurfaces(*technique); // the ball's grazes the foot of the house
    ASSERT_EQ(causes.size(), given.relit ? 0u : 1u);
    if (!causes.empty()) {
        EXPECT_NE(causes[0].find("'ground'"), std::string::npos) << causes[0];
    }
}

INSTANTIATE_TEST_SUITE_P(
    Planar, Receivers,
    testing::Values(Case{"Unlit", unlit, true, false}, Case{"UnlitUnnamed", unlit, false, false},
                    Case{"Colorless", colorless, true, false}, Case{"ColorlessUnnamed", colorless, false, false},
                    Case{"ConstantProgram", constantProgram, true, false},
                    Case{"ConstantProgramUnnamed", constantProgram, false, false},
                    Case{"PositionProgram", positionProgram, true, false},
                    Case{"PositionProgramUnnamed", positionProgram, false, false},
                    Case{"MaterialProgram", materialProgram, true, false},
                    Case{"UnlitAssembly", unlitAssembly, true, false}, Case{"LitAssembly", litAssembly, true, true},
                    Case{"LitProgram", litProgram, true, true}, Case{"LitProgramUnnamed", litProgram, false, true},
                    Case{"Blending", blending, true, true}, Case{"BlendingUnnamed", blending, false, true}),
    [](const auto& given) { return given.param.name; });

namespace {

/// Catchers over catchers: the phantoms of real things, before the picture of a camera.
Scene phantoms() {
    Scene scene = groundScene(twoCasters);
    colorless(*scene.content->getOrCreateStateSet());
    return scene;
}

void expectNoStencil(Camera& camera) {
    const osg::ref_ptr<const osg::Image> bits = camera.context().stencil();
    const unsigned char* const end = bits->data() + bits->getTotalSizeInBytes();
    EXPECT_TRUE(std::all_of(bits->data(), end, [](unsigned char value) { return value == 0; }));
}

const View small = perspective({-10.0, -14.0, 12.0}, {0.0, 0.0, 0.0}, 120, 90);

} // namespace

// Whatever lies behind what: the clear colour is multiplied by 0.5, once.
TEST(Catchers, OfAllTechniquesTakeTheFactorOnceAndAreNamedWhereLightIsTaken) {
    for (const std::string spec : {"planar", "planar:receiver=ground", "hull", "map", "volume", "traced", "auto"})
        for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
            Scene lit = phantoms(), scene = phantoms();
            const Picture expected = halved(render(lit.root, small));
            scene.addShadow(spec);
            scene.group->setComposite(composite);
            Camera camera(scene.root, small);
            const Picture actual = camera.frame();
            expectNoStencil(camera);
            int shadowed = 0, other = 0;
            for (const std::uint32_t pixel : actual.pixels) {
                shadowed += pixel == expected.pixels[0];
                other += pixel != expected.pixels[0] && pixel != 0xff400000u;
            }
            EXPECT_GT(shadowed, 100) << spec << composite;
            EXPECT_EQ(other, 0) << spec << composite;
            const auto* technique = dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(1));
            const std::vector<std::string> causes = causesButLitSurfaces(*technique);
            const bool named = composite == gnomon::ShadowCasterGroup::RELIGHT;
            EXPECT_EQ(causes.size() > 0, named) << spec << composite;
            if (named && !causes.empty()) EXPECT_NE(causes[0].find("writes no colour"), std::string::npos) << causes[0];
        }
}

// Smooth edges leave every share between the factor and all.
TEST(Catchers, TakeTheShareOfSmoothEdges) {
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
        Scene scene = phantoms();
        scene.addShadow("map:edges=smooth");
        scene.group->setComposite(composite);
        Camera camera(scene.root, small);
        int darkest = 0, between = 0, darker = 0;
        for (const std::uint32_t pixel : camera.frame().pixels) {
            const int blue = pixel >> 16 & 0xff;
            darkest += blue == 0x20;
            between += blue > 0x20 && blue < 0x40;
            darker += blue < 0x20;
        }
        EXPECT_GT(darkest, 100);
        EXPECT_GT(between, 20);
        EXPECT_EQ(darker, 0);
        expectNoStencil(camera);
    }
}

TEST(Catchers, APassOfDepthsBeforeThatOfColorsIsNone) {
    for (const std::string spec : {"map", "map:edges=smooth"}) {
        const auto build = [](bool depthsFirst) {
            Scene scene = groundScene(twoCasters);
            if (!depthsFirst) return scene;
            const osg::ref_ptr<osg::Group> depths = new osg::Group, all = new osg::Group;
            for (unsigned i = 0; i < scene.content->getNumChildren(); ++i) {
                depths->addChild(scene.content->getChild(i));
                all->addChild(scene.content->getChild(i));
            }
            scene.content->removeChildren(0, scene.content->getNumChildren());
            scene.content->addChild(depths);
            scene.content->addChild(all);
            colorless(*depths->getOrCreateStateSet());
            unlit(*depths->getOrCreateStateSet());
            all->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL));
            return scene;
        };
        Scene plain = build(false), twice = build(true);
        plain.addShadow(spec);
        twice.addShadow(spec);
        EXPECT_EQ(render(twice.root, small).different(render(plain.root, small)), 0) << spec;
        const auto* technique = dynamic_cast<gnomon::ShadowTechnique*>(twice.group->getChild(1));
        EXPECT_EQ(causesButLitSurfaces(*technique), std::vector<std::string>()) << spec;
    }
}

// A forest of unlit trees is one cause.
TEST(NotRelit, OneOfThoseThatShareAStateIsNamedAndOneOfEachState) {
    Scene scene = groundScene(twoCasters);
    std::vector<osg::ref_ptr<osg::StateSet>> states{new osg::StateSet, new osg::StateSet};
    for (const auto& state : states) unlit(*state);
    for (unsigned i = 0; i < 6; ++i) {
        const osg::ref_ptr<osg::Geometry> panel = osg::createTexturedQuadGeometry(
            osg::Vec3(float(i) - 6.0f, -3.0f, 0.5f), osg::Vec3(0.9f, 0.0f, 0.0f), osg::Vec3(0.0f, 6.0f, 0.0f));
        panel->setName("panel " + std::string(1, char('a' + i)));
        panel->setStateSet(states[i / 3]);
        scene.content->addChild(panel);
    }
    const osg::ref_ptr<gnomon::ShadowTechnique> technique = new gnomon::ShadowMapTechnique;
    scene.addShadow(technique);
    render(scene.root, slanted);
    std::string named;
    for (const std::string& cause : causesButLitSurfaces(*technique)) {
        const std::size_t at = cause.find("'panel ");
        ASSERT_NE(at, std::string::npos) << cause;
        named += cause[at + 7];
    }
    ASSERT_EQ(named.size(), 2u) << named;
    EXPECT_NE(named[0] < 'd', named[1] < 'd') << named;
}
