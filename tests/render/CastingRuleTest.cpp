// SPDX-License-Identifier: MIT
// What has triangles, and casts nothing all the same: skies at the far plane, and what hides little of what is behind it.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CasterLayers.h>
#include <gtest/gtest.h>
#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Material>

#include <functional>
#include <limits>

using gnomon::ShadowCasterGroup;
using test::Picture;
using test::Scene;

namespace {

const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0);
const test::Mesh tower = test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
test::View fromTheSide() { return test::perspective({-6.0, -9.0, 6.0}, {0.0, 0.0, 0.0}, 160, 120); }

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

void blend(osg::StateSet& state) { state.setMode(GL_BLEND, osg::StateAttribute::ON); }

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
        for (const auto& piece : group->drawables()->list) triangles += piece->triangles;
        EXPECT_EQ(group->casters()->triangles(), triangles);
        return triangles;
    }
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
};

TEST(CastingRule, WhatHidesLessThanHalfOfWhatIsBehindItCastsNothing) {
    for (const Glass& glass : glasses) EXPECT_EQ(Shop(glass).casts(), glass.casts) << glass.name;
}

TEST(CastingRule, IsTheGroupsAndLive) {
    const Shop shop(glasses[1]);
    shop.group->setOpaqueFrom(0.25f);
    EXPECT_TRUE(shop.casts());
    shop.group->setOpaqueFrom(0.35f);
    EXPECT_FALSE(shop.casts());
    shop.group->setOpaqueFrom(std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(shop.group->getOpaqueFrom(), 0.35f);
    shop.group->setOpaqueFrom(-1.0f);
    EXPECT_EQ(shop.group->getOpaqueFrom(), 0.0f);
    EXPECT_TRUE(shop.casts());
}

} // namespace
