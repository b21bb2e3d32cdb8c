// SPDX-License-Identifier: MIT
// What is drawn casts, and what is not drawn does not: by each state that takes something away.
#include "Tower.h"

#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/PolygonMode>
#include <osg/PolygonStipple>
#include <osg/Scissor>
#include <osg/Stencil>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

using gnomon::ShadowCasterGroup;
using test::fromTheSide;
using test::Picture;
using test::Scene;
using test::sun;
using test::tower;

namespace {

/// As OpenSceneGraph's examples draw one: unlit, before all else, at the far plane.
osg::ref_ptr<osg::Node> skyDome() {
    const osg::ref_ptr<osg::Node> dome = test::node(test::insideOut(test::sphere({0.0, 0.0, 0.0}, 40.0, 16)), "dome");
    osg::StateSet* state = dome->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 1.0, 1.0));
    state->setRenderBinDetails(-1, "RenderBin");
    return dome;
}

template <class Technique>
Picture under(const std::function<void(Scene&)>& addDome) {
    Scene scene = test::groundScene({tower}, 8.0, sun);
    scene.addShadow(new Technique);
    addDome(scene);
    return test::render(scene.root, fromTheSide());
}

template <class Technique>
void castsNoDome() {
    const Picture outside = under<Technique>([](Scene& scene) { scene.root->addChild(skyDome()); });
    const Picture inside = under<Technique>([](Scene& scene) { scene.content->addChild(skyDome()); });
    EXPECT_GT(outside.count(test::shadowedGround), 0);
    EXPECT_EQ(inside.different(outside), 0);
}

TEST(CastingRule, ASkyAtTheFarPlaneCastsNothing) {
    castsNoDome<gnomon::TracedShadowTechnique>();
    castsNoDome<gnomon::ShadowMapTechnique>();
}

/// What of a state decides, and whether a drawable with it casts from an alpha of 0.5 on.
struct Glass {
    const char* name;
    std::function<void(osg::Geometry&, osg::StateSet&)> set;
    bool casts;
};

void setMaterial(osg::StateSet& state, float alpha, osg::Material::ColorMode mode = osg::Material::OFF) {
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAlpha(osg::Material::FRONT_AND_BACK, alpha);
    material->setColorMode(mode);
    state.setAttributeAndModes(material);
}

void setColor(osg::Geometry& geometry, float alpha) {
    const osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array;
    color->push_back({1.0f, 1.0f, 1.0f, alpha});
    geometry.setColorArray(color, osg::Array::BIND_OVERALL);
}

/// As many corners of each of the tower's triangles as a number says have one alpha, all others another.
void setColors(osg::Geometry& geometry, int corners, float alpha, float other) {
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (unsigned i = 0; i < geometry.getVertexArray()->getNumElements(); ++i)
        colors->push_back({1.0f, 1.0f, 1.0f, int(i % 3) < corners ? alpha : other});
    geometry.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
}

void blend(osg::StateSet& state) { state.setMode(GL_BLEND, osg::StateAttribute::ON); }

using Side = osg::PolygonMode::Face;
using Fill = osg::PolygonMode::Mode;

osg::ref_ptr<osg::PolygonMode> polygonMode(Side side, Fill mode) { return new osg::PolygonMode(side, mode); }

/// Of 1024 bits, those of some of the 32 rows.
osg::ref_ptr<osg::PolygonStipple> stipple(int rows) {
    GLubyte mask[128] = {};
    std::fill(mask, mask + 4 * rows, GLubyte(0xff));
    return new osg::PolygonStipple(mask);
}

osg::ref_ptr<osg::Depth> unwritten() { return new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false); }

const Glass glasses[] = {
    {"not blended", [](auto&, auto& state) { setMaterial(state, 0.3f); }, true},
    {"a material of 0.3", [](auto&, auto& state) { blend(state), setMaterial(state, 0.3f); }, false},
    {"a material of 0.6", [](auto&, auto& state) { blend(state), setMaterial(state, 0.6f); }, true},
    {"a material of 0.6, but a colour of 0.3 that counts for it",
     [](auto& geometry, auto& state) {
         blend(state), setColor(geometry, 0.3f);
         setMaterial(state, 0.6f, osg::Material::AMBIENT_AND_DIFFUSE);
     },
     false},
    {"unlit, with a colour of 0.3",
     [](auto& geometry, auto& state) {
         blend(state), setColor(geometry, 0.3f);
         state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
     },
     false},
    {"additive", [](auto&, auto& state) { state.setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE)); },
     false},
    {"a blend colour of 0.2",
     [](auto&, auto& state) {
         state.setAttributeAndModes(new osg::BlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA));
         state.setAttributeAndModes(new osg::BlendColor({0.0f, 0.0f, 0.0f, 0.2f}));
     },
     false},
    {"a program",
     [](auto&, auto& state) {
         blend(state), setMaterial(state, 0.3f);
         const osg::ref_ptr<osg::Program> program = new osg::Program;
         program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "void main() {}"));
         state.setAttributeAndModes(program);
     },
     true},
    {"vertices of 0.1",
     [](auto& geometry, auto& state) {
         blend(state), setColors(geometry, 3, 0.1f, 0.0f);
         setMaterial(state, 0.6f, osg::Material::AMBIENT_AND_DIFFUSE);
     },
     false},
    {"vertices of 0.1 and 0.9 in a triangle",
     [](auto& geometry, auto& state) {
         blend(state), setColors(geometry, 2, 0.1f, 0.9f);
         state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
     },
     true},
    {"vertices of 0.1 that do not count, for it is lit by a material",
     [](auto& geometry, auto& state) { blend(state), setColors(geometry, 3, 0.1f, 0.0f), setMaterial(state, 0.6f); },
     true},
    {"an alpha test that a colour of 0.3 fails",
     [](auto& geometry, auto& state) {
         setColor(geometry, 0.3f);
         state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.4f));
     },
     false},
    {"an alpha test that all fail",
     [](auto&, auto& state) { state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::NEVER, 0.0f)); }, false},
    {"both faces culled",
     [](auto&, auto& state) { state.setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT_AND_BACK)); }, false},
    {"both faces culled, but culling is off",
     [](auto&, auto& state) { state.setAttribute(new osg::CullFace(osg::CullFace::FRONT_AND_BACK)); }, true},
    {"one face culled", [](auto&, auto& state) { state.setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT)); },
     true},
    {"lines", [](auto&, auto& state) { state.setAttribute(polygonMode(Side::FRONT_AND_BACK, Fill::LINE)); }, false},
    {"points", [](auto&, auto& state) { state.setAttribute(polygonMode(Side::FRONT_AND_BACK, Fill::POINT)); }, false},
    {"lines at the back", [](auto&, auto& state) { state.setAttribute(polygonMode(Side::BACK, Fill::LINE)); }, true},
    {"lines in front, and the back culled",
     [](auto&, auto& state) {
         state.setAttribute(polygonMode(Side::FRONT, Fill::LINE));
         state.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
     },
     false},
    {"depths that never pass", [](auto&, auto& state) { state.setAttribute(new osg::Depth(osg::Depth::NEVER)); },
     false},
    {"depths that would never pass, but nobody looks",
     [](auto&, auto& state) {
         state.setAttribute(new osg::Depth(osg::Depth::NEVER));
         state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
     },
     true},
    {"masked colours and depth",
     [](auto&, auto& state) {
         state.setAttribute(new osg::ColorMask(false, false, false, false));
         state.setAttribute(unwritten());
     },
     false},
    {"masked colours: it hides what is behind it",
     [](auto&, auto& state) { state.setAttribute(new osg::ColorMask(false, false, false, false)); }, true},
    {"masked depth", [](auto&, auto& state) { state.setAttribute(unwritten()); }, true},
    {"a stencil test that all fail",
     [](auto&, auto& state) {
         const osg::ref_ptr<osg::Stencil> stencil = new osg::Stencil;
         stencil->setFunction(osg::Stencil::NEVER);
         state.setAttributeAndModes(stencil);
     },
     false},
    {"a stipple of a quarter", [](auto&, auto& state) { state.setAttributeAndModes(stipple(8)); }, false},
    {"a stipple of a half", [](auto&, auto& state) { state.setAttributeAndModes(stipple(16)); }, true},
    {"a stipple of a quarter that is off", [](auto&, auto& state) { state.setAttribute(stipple(8)); }, true},
    {"an empty scissor box", [](auto&, auto& state) { state.setAttributeAndModes(new osg::Scissor(10, 10, 0, 50)); },
     false},
    {"a scissor box, which is the camera's, not the light's",
     [](auto&, auto& state) { state.setAttributeAndModes(new osg::Scissor(0, 0, 1, 1)); }, true},
};

/// A group with a solid box, and one of glass.
struct Shop {
    explicit Shop(const Glass& glass) {
        group->addChild(test::node(tower));
        const osg::ref_ptr<osg::Node> node = test::node(tower);
        glass.set(*node->asGroup()->getChild(0)->asDrawable()->asGeometry(), *node->getOrCreateStateSet());
        group->addChild(node);
    }
    bool casts() const { return trianglesOf() == 2 * tower.size() / 3; }
    /// The same by both ways to the casters.
    std::size_t trianglesOf() const {
        std::size_t triangles = 0;
        const auto casters = group->casters();
        for (const auto& piece : casters->list) triangles += piece->triangles;
        EXPECT_EQ(casters->layers().triangles(), triangles);
        return triangles;
    }
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
};

TEST(CastingRule, WhatHidesLessThanHalfOfWhatIsBehindItCastsNothingWhereThatIsAsked) {
    for (const Glass& glass : glasses) {
        const Shop shop(glass);
        shop.group->setOpaqueFrom(0.5f);
        EXPECT_EQ(shop.casts(), glass.casts) << glass.name;
    }
}

/// Two texels, each over half of the tower's corners, or over all where they are the same.
void setTexels(osg::Geometry& geometry, osg::StateSet& state, float one, float other) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, one), 0u, 0u);
    image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, other), 1u, 0u);
    const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (unsigned i = 0; i < geometry.getVertexArray()->getNumElements(); ++i)
        places->push_back({float(i % 2), float(i % 3) / 2.0f});
    geometry.setTexCoordArray(0, places);
    state.setTextureAttributeAndModes(0, new osg::Texture2D(image));
}

const Glass evenGlasses[] = {
    {"a material of 0.99", [](auto&, auto& state) { blend(state), setMaterial(state, 0.99f); }, false},
    {"a material of 1", [](auto&, auto& state) { blend(state), setMaterial(state, 1.0f); }, true},
    {"not blended", [](auto&, auto& state) { setMaterial(state, 0.7f); }, true},
    {"a colour of 0.7", [](auto& geometry, auto& state) { blend(state), setColor(geometry, 0.7f); }, false},
    {"a colour of 0.7 that passes an alpha test",
     [](auto& geometry, auto& state) {
         blend(state), setColor(geometry, 0.7f);
         state.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.4f));
     },
     false},
    {"a blend colour of 0.9",
     [](auto&, auto& state) {
         state.setAttributeAndModes(new osg::BlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA));
         state.setAttributeAndModes(new osg::BlendColor({0.0f, 0.0f, 0.0f, 0.9f}));
     },
     false},
    {"vertices of 0.7", [](auto& geometry, auto& state) { blend(state), setColors(geometry, 3, 0.7f, 0.0f); }, false},
    {"vertices of 0.7 and 0.8", [](auto& geometry, auto& state) { blend(state), setColors(geometry, 2, 0.7f, 0.8f); },
     true},
    {"texels of 0.7", [](auto& geometry, auto& state) { blend(state), setTexels(geometry, state, 0.7f, 0.7f); }, false},
    {"texels of 0.7 and 1", [](auto& geometry, auto& state) { blend(state), setTexels(geometry, state, 0.7f, 1.0f); },
     true},
    {"texels of 1 on a colour of 0.7",
     [](auto& geometry, auto& state) {
         blend(state), setColor(geometry, 0.7f);
         setTexels(geometry, state, 1.0f, 1.0f);
     },
     false},
};

TEST(CastingRule, WhatBlendsByOneAlphaBelowOneLetsLightThroughUnlessANumberIsGiven) {
    for (const Glass& glass : evenGlasses) {
        const Shop shop(glass);
        EXPECT_EQ(shop.casts(), glass.casts) << glass.name;
        shop.group->setOpaqueFrom(0.6f);
        EXPECT_TRUE(shop.casts()) << glass.name;
        shop.group->setOpaqueFrom(-1.0f);
        EXPECT_EQ(shop.casts(), glass.casts) << glass.name;
    }
}

TEST(CastingRule, ALakeThatCastsLeavesItsBedAsALakeThatDoesNot) {
    const test::View above = fromTheSide();
    for (const std::string spec :
         {"map", "volume", "traced", "auto", "planar:receiver=ground", "hull:receiver=ground"}) {
        Picture pictures[2];
        for (const bool casting : {false, true}) {
            Scene scene = test::groundScene({tower}, 8.0, sun);
            const osg::ref_ptr<osg::Geode> water = test::node(test::square(20.0, 2.5), "water");
            setColor(*water->getDrawable(0)->asGeometry(), 0.7f);
            setMaterial(*water->getOrCreateStateSet(), 1.0f, osg::Material::AMBIENT_AND_DIFFUSE);
            blend(*water->getOrCreateStateSet());
            water->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
            (casting ? scene.content : scene.root)->addChild(water);
            scene.addShadow(spec);
            pictures[casting] = test::render(scene.root, above);
        }
        EXPECT_EQ(pictures[true].different(pictures[false]), 0) << spec;
    }
}

TEST(CastingRule, IsTheGroupsAndLive) {
    const Shop shop(glasses[1]);
    shop.group->setOpaqueFrom(0.25f);
    EXPECT_TRUE(shop.casts());
    shop.group->setOpaqueFrom(0.35f);
    EXPECT_FALSE(shop.casts());
    shop.group->setOpaqueFrom(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(shop.group->getOpaqueFrom(), 0.35f);
    shop.group->setOpaqueFrom(0.0f);
    EXPECT_TRUE(shop.casts());
}

TEST(CastingRule, IsThatOfACopyToo) {
    Shop shop(glasses[1]);
    for (const auto& [opaqueFrom, casts] : {std::pair(0.25f, true), {0.35f, false}}) {
        shop.group->setOpaqueFrom(opaqueFrom);
        const osg::ref_ptr<ShadowCasterGroup> original = shop.group;
        shop.group = osg::clone(original.get(), osg::CopyOp::DEEP_COPY_ALL);
        EXPECT_EQ(shop.casts(), casts) << opaqueFrom;
        shop.group = original;
    }
}

const char* const specs[] = {"map", "volume", "traced", "planar:receiver=ground", "hull:receiver=ground"};

/// A fence over the ground whose texture has, in four columns, these alphas.
osg::ref_ptr<osg::Geometry> fence(const std::vector<float>& alphas) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < 4; ++i) image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, alphas[i]), i, 0u);
    const osg::ref_ptr<osg::Geometry> result =
        osg::createTexturedQuadGeometry({-2.0f, -1.0f, 1.5f}, {4.0f, 0.0f, 0.0f}, {0.0f, 2.0f, 0.0f});
    result->setName("fence");
    osg::StateSet& state = *result->getOrCreateStateSet();
    state.setTextureAttributeAndModes(0, new osg::Texture2D(image));
    state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    blend(state);
    return result;
}

/// What a technique says of a fence's clear parts.
std::string saidOf(osg::Geometry* geometry, const std::string& spec) {
    Scene scene = test::groundScene({tower}, 8.0, sun);
    scene.content->addChild(geometry);
    scene.addShadow(spec);
    test::Camera camera(scene.root, fromTheSide());
    camera.frame();
    const auto& technique = static_cast<const gnomon::ShadowTechnique&>(*scene.group->getChild(1));
    for (const std::string& cause : technique.diagnose())
        if (cause.find("clear") != std::string::npos) return cause;
    return "";
}

/// Light is not the camera. The body itself is out of sight, so that the ground alone tells.
TEST(CastingRule, AFaceThatIsCulledForTheEyeBlocksTheLightFromBothSides) {
    const test::Mesh body = test::box({8.0, -1.0, 8.0}, {10.0, 1.0, 10.0});
    for (const std::string spec : {"planar", "map", "volume", "traced", "hull:receiver=ground", "auto"})
        for (const bool open : {false, true})
            for (const bool turned : {false, true}) {
                const auto picture = [&](std::optional<osg::CullFace::Mode> mode) {
                    test::Mesh mesh = open ? test::square(1.0, 9.0) : body;
                    if (open)
                        for (glm::dvec3& corner : mesh) corner.x += 9.0;
                    Scene scene = test::groundScene({turned ? test::insideOut(mesh) : mesh});
                    if (mode)
                        test::find(*scene.root, "caster")
                            ->getOrCreateStateSet()
                            ->setAttributeAndModes(new osg::CullFace(*mode));
                    scene.addShadow(spec);
                    return test::render(scene.root, test::fromAbove(4.0, 128));
                };
                const Picture expected = picture(std::nullopt);
                EXPECT_GT(expected.count(test::shadowedGround), 900) << spec << open << turned;
                for (const auto mode : {osg::CullFace::BACK, osg::CullFace::FRONT})
                    EXPECT_EQ(picture(mode).different(expected), 0) << spec << open << turned << mode;
                EXPECT_EQ(picture(osg::CullFace::FRONT_AND_BACK).count(test::shadowedGround), 0) << spec << open;
            }
}

TEST(CastingRule, WhatIsClearInPartIsNamedWhereItCastsAsASolid) {
    for (const std::string spec : specs) {
        const std::string said = saidOf(fence({1.0f, 0.2f, 0.3f, 0.9f}), spec);
        if (spec == "map" || spec == "traced")
            EXPECT_EQ(said, "") << spec;
        else
            EXPECT_NE(said.find("casters with clear parts cast as if they were solid: 1, the first in 'fence'"),
                      std::string::npos)
                << spec;
        EXPECT_EQ(saidOf(fence({1.0f, 0.8f, 0.9f, 0.6f}), spec), "") << spec;
        EXPECT_EQ(saidOf(fence({0.1f, 0.2f, 0.3f, 0.4f}), spec), "") << spec;
    }
}

TEST(CastingRule, AutoTakesAMapForWhatIsClearInPart) {
    for (const bool inPart : {false, true}) {
        Scene scene = test::groundScene({tower}, 8.0, sun);
        scene.content->addChild(fence({1.0f, inPart ? 0.2f : 0.7f, 1.0f, 1.0f}));
        scene.addShadow("auto");
        test::Camera camera(scene.root, fromTheSide());
        camera.frame();
        const auto& technique = static_cast<const gnomon::ShadowTechnique&>(*scene.group->getChild(1));
        const bool hasMap = technique.lastDecision().front().chosen.spec.find("map") != std::string::npos;
        EXPECT_EQ(hasMap, inPart);
        for (const std::string& cause : technique.diagnose()) // but that it receives nothing where it blends
            EXPECT_EQ(cause.find("clear parts"), std::string::npos) << cause;
    }
}

/// As a model of Inventor's draws its mesh: a sheet, and its edges a bit above it.
TEST(CastingRule, LinesOverASheetDoNotShadowIt) {
    test::Mesh sheet;
    const auto height = [](int i, int j) { return 0.8 + 0.5 * std::sin(1.3 * i) * std::cos(0.9 * j); };
    const auto corner = [&](int i, int j) { return glm::dvec3(i, j, height(i, j)); };
    for (int i = -3; i < 3; ++i)
        for (int j = -3; j < 3; ++j)
            for (const glm::dvec3& place : {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j),
                                            corner(i + 1, j + 1), corner(i, j + 1)})
                sheet.push_back(place);
    for (const std::string spec : {"map", "traced", "volume"}) {
        Picture pictures[2];
        for (const bool among : {false, true}) {
            Scene scene = test::groundScene({sheet}, 8.0, sun);
            scene.addShadow(spec);
            const osg::ref_ptr<osg::Node> wires = test::node(test::moved(sheet, {0.0, 0.0, 0.01}));
            wires->getOrCreateStateSet()->setAttribute(polygonMode(Side::FRONT_AND_BACK, Fill::LINE));
            (among ? scene.content : scene.root)->addChild(wires);
            pictures[among] = test::render(scene.root, fromTheSide());
        }
        EXPECT_EQ(pictures[0].different(pictures[1]), 0) << spec;
        EXPECT_GT(pictures[0].count(test::shadowedGround), 50) << spec;
    }
}

} // namespace
