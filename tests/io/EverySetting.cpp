// SPDX-License-Identifier: MIT
#include "EverySetting.h"

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <support/Scene.h>

namespace test {
namespace {

const gnomon::CompositorOptions options{0x80, false};

osg::ref_ptr<gnomon::PlanarShadowNode> planarOf(const gnomon::Selection& receiver) {
    osg::ref_ptr<gnomon::PlanarShadowNode> result = new gnomon::PlanarShadowNode;
    result->setReceiver(receiver);
    result->setPlanes({{0.0, 0.0, 1.0, 0.0}, {0.1, -1.0 / 3.0, 1e-300, 4234567.123456789}});
    result->setStencilCure(false);
    result->setOffsetCure(false);
    result->setClipCure(false);
    return result;
}

osg::ref_ptr<gnomon::ShadowMapTechnique> mapOf() {
    osg::ref_ptr<gnomon::ShadowMapTechnique> result = new gnomon::ShadowMapTechnique;
    result->setSize(20);
    result->setFilter(gnomon::ShadowMapTechnique::FINE);
    result->setCascades(3);
    result->setEdges(gnomon::ShadowMapTechnique::SOFT);
    result->setSunAngle(0.1);
    result->setLampSize(1.0 / 3.0);
    result->setRadius(2.0 / 3.0);
    result->setView(gnomon::ShadowMapTechnique::TEXELS);
    result->setProgramUnit(5);
    return result;
}

osg::ref_ptr<gnomon::TerrainShadowGeode> terrainOf() {
    osg::ref_ptr<gnomon::TerrainShadowGeode> result = new gnomon::TerrainShadowGeode;
    result->setMethod(gnomon::TerrainShadowGeode::BOX);
    return result;
}

osg::ref_ptr<gnomon::PlanarReflectionNode> mirrorOf(const gnomon::Selection& surface) {
    osg::ref_ptr<gnomon::PlanarReflectionNode> result = new gnomon::PlanarReflectionNode;
    result->setSurface(surface);
    result->setPlane({0.1, 0.2, 1.0, -1.0 / 3.0});
    result->setReflectance({0.1f, 0.2f, 1.0f / 3.0f});
    result->setStencilCure(false);
    result->setCompositorOptions(options);
    return result;
}

osg::ref_ptr<gnomon::HaloNode> haloOf() {
    osg::ref_ptr<gnomon::HaloNode> result = new gnomon::HaloNode;
    result->setShape(gnomon::HaloNode::PIXELS);
    result->setScale(1.0 + 1.0 / 3.0);
    result->setWidth(5);
    result->setColor({0.1f, 0.2f, 1.0f / 3.0f, 1e-7f});
    result->setStencilCure(false);
    result->setCompositorOptions(options);
    result->setUpdateCallback(new gnomon::HaloPulse(0.1));
    return result;
}

} // namespace

osg::ref_ptr<osg::Group> everySetting() {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
    sun->setLight(new osg::Light(3));
    root->addChild(sun);
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    root->addChild(group);
    for (const char* name : {"floor", "wall", "tree", "house"}) group->addChild(node(square(1.0), name));
    const gnomon::Selection ground{group->getChild(0), 0xf0u, {group->getChild(1)}};

    group->setCasters({group->getChild(2), 0x7fffffffu, {group->getChild(3)}});
    group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    group->setDark(0.1f);
    group->setOpaqueFrom(1.0f / 3.0f);
    group->setLightSources({sun});
    group->setLights({{2, {0.1, -1.0 / 3.0, 4234567.123456789, 1.0}, {0.1, 0.2, -1.0}, 100.0 / 3.0}});
    group->setLightUniforms({{1, "sun colour \"quoted\""}});
    group->setCompositorOptions(options);

    group->addChild(planarOf(ground));
    group->addChild(mapOf());
    group->addChild(terrainOf());
    osg::ref_ptr<gnomon::ShadowVolumeTechnique> volume = new gnomon::ShadowVolumeTechnique;
    volume->setView(gnomon::ShadowVolumeTechnique::VOLUMES);
    group->addChild(volume);
    osg::ref_ptr<gnomon::TracedShadowTechnique> traced = new gnomon::TracedShadowTechnique;
    traced->setReceiver(ground);
    group->addChild(traced);
    osg::ref_ptr<gnomon::AutoShadowTechnique> choice = new gnomon::AutoShadowTechnique;
    choice->setError(1.0 / 3.0);
    choice->setTime(0.7);
    group->addChild(choice);
    group->addChild(mirrorOf(ground));
    group->addChild(haloOf());
    return root;
}

} // namespace test
