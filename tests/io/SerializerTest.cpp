// SPDX-License-Identifier: MIT
// Scene files keep every property, to the bit.
#include "SceneFile.h"

#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <cmath>
#include <limits>
#include <osg/DisplaySettings>
#include <osg/observer_ptr>

namespace {

using gnomon::PlanarShadowNode;
using gnomon::Selection;
using gnomon::ShadowCasterGroup;
using gnomon::ShadowLight;
using gnomon::ShadowMapTechnique;
using test::childOf;
using test::SceneFile;

/// KeyNumbers that six digits, or a reader that rounds carelessly, would change.
const std::vector<osg::Vec4d> delicate = {
    {0.1, -1.0 / 3.0, 4234567.123456789, 1e-300},
    {-std::nextafter(1.0, 2.0), std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), -0.0},
    {6378137.0000000009, 123456789012345678.0, 5e-324, 2.2250738585072011e-308},
};

/// True if both have the same bits, which tells 0 from -0.
bool sameBits(const osg::Vec4d& a, const osg::Vec4d& b) {
    for (int i = 0; i < 4; ++i)
        if (a[i] != b[i] || std::signbit(a[i]) != std::signbit(b[i])) return false;
    return true;
}

INSTANTIATE_TEST_SUITE_P(EveryKind, SceneFile, testing::Values("osgt", "osgb", "osgx"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(SceneFile, KeepsEveryBitOfThePlanes) {
    for (std::size_t count = 0; count <= delicate.size(); ++count) {
        osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
        node->setPlanes({delicate.begin(), delicate.begin() + std::ptrdiff_t(count)});
        const auto copy = test::throughFile(*node, kind());
        ASSERT_TRUE(copy);
        ASSERT_EQ(copy->getPlanes().size(), count);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_TRUE(sameBits(copy->getPlanes()[i], delicate[i])) << test::written(*node, "osgt");
    }
}

TEST_P(SceneFile, KeepsPlanesThatAreNotFinite) {
    osg::ref_ptr<PlanarShadowNode> node =
        new PlanarShadowNode(osg::Vec4d(NAN, INFINITY, -INFINITY, 1.0)); // kept as given, as addPlane() says
    const auto copy = test::throughFile(*node, kind());
    ASSERT_TRUE(copy);
    ASSERT_EQ(copy->getPlanes().size(), 1u);
    EXPECT_TRUE(std::isnan(copy->getPlanes()[0][0]));
    EXPECT_EQ(copy->getPlanes()[0][1], INFINITY);
    EXPECT_EQ(copy->getPlanes()[0][2], -INFINITY);
}

TEST_P(SceneFile, KeepsUniformsOfLights) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    const std::vector<gnomon::LightUniform> uniforms = {{7, "sun colour \"quoted\""}, {0, "sun.diffuse"}};
    group->setLightUniforms(uniforms);
    const auto copy = test::throughFile(*group, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getLightUniforms(), uniforms);
}

TEST_P(SceneFile, KeepsWhatTheCompositorMayUse) {
    const gnomon::CompositorOptions options{0xa5, false};
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setCompositorOptions(options);
    const auto copy = test::throughFile(*group, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getCompositorOptions(), options);
    osg::ref_ptr<gnomon::HaloNode> halo = new gnomon::HaloNode;
    halo->setCompositorOptions(options);
    const auto ring = test::throughFile(*halo, kind());
    ASSERT_TRUE(ring);
    EXPECT_EQ(ring->getCompositorOptions(), options);
    osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
    mirror->setCompositorOptions(options);
    const auto image = test::throughFile(*mirror, kind());
    ASSERT_TRUE(image);
    EXPECT_EQ(image->getCompositorOptions(), options);
}

TEST_P(SceneFile, KeepsNumbersAndPlacesOfLights) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setLights({{7, delicate[0]}, {0, delicate[1]}, {3, delicate[2]}});
    const auto copy = test::throughFile(*group, kind());
    ASSERT_TRUE(copy);
    ASSERT_EQ(copy->getLights().size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(copy->getLights()[i].number, group->getLights()[i].number);
        EXPECT_TRUE(sameBits(copy->getLights()[i].inGroup, delicate[i]));
    }
}

TEST_P(SceneFile, KeepsTheConesOfSpotsBesideOtherLights) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    const osg::Vec3d direction(0.1, -1.0 / 3.0, 4234567.123456789);
    group->setLights({{1, {1, 2, 3, 0}}, {2, {4, 5, 6, 1}, direction, 100.0 / 3.0}, {3, {7, 8, 9, 1}}});
    const auto copy = test::throughFile(*group, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getLights(), group->getLights());
}

TEST_P(SceneFile, KeepsTheCompositeAndItsFactor) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setComposite(ShadowCasterGroup::BLEND);
    for (const float dark : {0.0f, 0.1f, 1.0f / 3.0f, std::nextafter(0.5f, 1.0f), 1e-30f, 1.0f}) {
        group->setDark(dark);
        group->setOpaqueFrom(dark);
        const auto copy = test::throughFile(*group, kind());
        ASSERT_TRUE(copy);
        EXPECT_EQ(copy->getComposite(), ShadowCasterGroup::BLEND);
        EXPECT_EQ(copy->getDark(), dark);
        EXPECT_EQ(copy->getOpaqueFrom(), dark);
    }
}

TEST_P(SceneFile, KeepsEachCureOfPlanarShadows) {
    for (int off = 0; off < 3; ++off) {
        osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
        node->setStencilCure(off != 0);
        node->setOffsetCure(off != 1);
        node->setClipCure(off != 2);
        const auto copy = test::throughFile(*node, kind());
        ASSERT_TRUE(copy);
        EXPECT_EQ(copy->getStencilCure(), off != 0);
        EXPECT_EQ(copy->getOffsetCure(), off != 1);
        EXPECT_EQ(copy->getClipCure(), off != 2);
    }
}

TEST_P(SceneFile, KeepsMirrorsAndTheirSurface) {
    osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
    mirror->addChild(test::node(test::square(1.0), "floor"));
    mirror->setSurface({mirror->getChild(0), 0xf0u});
    mirror->setPlane(delicate[0]);
    mirror->setReflectance({0.1f, 1.0f / 3.0f, std::nextafter(0.5f, 1.0f)});
    mirror->setStencilCure(false);
    const auto copy = test::throughFile(*mirror, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getSurface(), Selection({copy->getChild(0), 0xf0u}));
    EXPECT_TRUE(sameBits(copy->getPlane(), delicate[0]));
    EXPECT_EQ(copy->getReflectance(), mirror->getReflectance());
    EXPECT_FALSE(copy->getStencilCure());
    const osg::ref_ptr<gnomon::PlanarReflectionNode> fresh = new gnomon::PlanarReflectionNode;
    const auto plain = test::throughFile(*fresh, kind());
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->getSurface(), Selection());
    EXPECT_EQ(plain->getPlane(), fresh->getPlane());
    EXPECT_EQ(plain->getReflectance(), fresh->getReflectance());
    EXPECT_TRUE(plain->getStencilCure());
}

TEST_P(SceneFile, KeepsHalosAndTheirPulse) {
    osg::ref_ptr<gnomon::HaloNode> halo = new gnomon::HaloNode;
    for (const auto shape : {gnomon::HaloNode::WHOLE, gnomon::HaloNode::PARTS, gnomon::HaloNode::PIXELS}) {
        halo->setShape(shape);
        halo->setScale(1.0 + 1.0 / 3.0);
        halo->setWidth(5);
        halo->setColor({0.1f, 0.2f, 1.0f / 3.0f, 1e-7f});
        halo->setStencilCure(false);
        halo->setUpdateCallback(new gnomon::HaloPulse(0.1));
        const auto copy = test::throughFile(*halo, kind());
        ASSERT_TRUE(copy);
        EXPECT_EQ(copy->getShape(), shape);
        EXPECT_EQ(copy->getScale(), halo->getScale());
        EXPECT_EQ(copy->getWidth(), 5);
        EXPECT_EQ(copy->getColor(), halo->getColor());
        EXPECT_FALSE(copy->getStencilCure());
        const auto* pulse = dynamic_cast<const gnomon::HaloPulse*>(copy->getUpdateCallback());
        ASSERT_TRUE(pulse);
        EXPECT_EQ(pulse->getAmplitude(), 0.1);
    }
    const osg::ref_ptr<gnomon::HaloNode> fresh = new gnomon::HaloNode;
    const auto plain = test::throughFile(*fresh, kind());
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->getShape(), fresh->getShape());
    EXPECT_EQ(plain->getScale(), 1.0);
    EXPECT_EQ(plain->getWidth(), fresh->getWidth());
    EXPECT_EQ(plain->getColor(), fresh->getColor());
    EXPECT_TRUE(plain->getStencilCure());
}

TEST_P(SceneFile, KeepsMasksWithoutANode) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setCasters({nullptr, 0xdeadbeefu});
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    node->setReceiver({nullptr, 0u});
    group->addChild(node);
    const auto copy = test::throughFile(*group, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getCasters(), Selection({nullptr, 0xdeadbeefu}));
    EXPECT_EQ(childOf<PlanarShadowNode>(*copy, 0).getReceiver(), Selection({nullptr, 0u}));
}

TEST_P(SceneFile, SelectsTheSameNodesOfTheLoadedGraph) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    group->addChild(node); // written before what it refers to
    group->addChild(new osg::Group);
    osg::Group& scene = childOf<osg::Group>(*group, 1);
    scene.addChild(test::node(test::square(1.0), "floor"));
    scene.addChild(test::node(test::square(2.0), "tree"));
    node->setReceiver({scene.getChild(0), 0xffu});
    group->setCasters({scene.getChild(1), 0x7fffffffu});

    const auto copy = test::throughFile(*group, kind());
    ASSERT_TRUE(copy);
    ASSERT_EQ(copy->getNumChildren(), 2u);
    osg::Group& copied = childOf<osg::Group>(*copy, 1);
    ASSERT_EQ(copied.getNumChildren(), 2u);
    EXPECT_EQ(childOf<PlanarShadowNode>(*copy, 0).getReceiver(), Selection({copied.getChild(0), 0xffu}));
    EXPECT_EQ(copy->getCasters(), Selection({copied.getChild(1), 0x7fffffffu}));
    EXPECT_EQ(copied.getChild(0)->getNumParents(), 1u);
    EXPECT_EQ(copied.getChild(0)->getName(), "floor");
    EXPECT_EQ(copied.getChild(1)->asGroup()->getNumChildren(), 1u);
}

TEST_P(SceneFile, KeepsLightSourcesInsideAndOutsideTheGroup) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    osg::ref_ptr<osg::LightSource> inside = new osg::LightSource, outside = new osg::LightSource;
    inside->getLight()->setLightNum(5);
    outside->getLight()->setLightNum(6);
    group->addChild(inside);
    group->addLight(outside);
    group->addLight(inside);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(group);
    root->addChild(outside);

    const auto graph = test::throughFile(*root, kind());
    ASSERT_TRUE(graph);
    const osg::ref_ptr<ShadowCasterGroup> copy = &childOf<ShadowCasterGroup>(*graph, 0);
    ASSERT_EQ(copy->getLightSources().size(), 2u);
    EXPECT_EQ(copy->getLightSources()[0]->getLight()->getLightNum(), 6);
    EXPECT_EQ(copy->getLightSources()[0], graph->getChild(1));
    EXPECT_EQ(copy->getLightSources()[1], copy->getChild(0));
    EXPECT_EQ(copy->getLightSources()[1]->getLight()->getLightNum(), 5);
}

TEST_P(SceneFile, KeepsWhatTheBaseClassesHave) {
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    node->setName("floor's shadow");
    node->setNodeMask(0x10u);
    node->addDrawable(new osg::Geometry);
    const auto copy = test::throughFile(*node, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getName(), "floor's shadow");
    EXPECT_EQ(copy->getNodeMask(), 0x10u);
    EXPECT_EQ(copy->getNumDrawables(), 1u);
    EXPECT_FALSE(copy->getCullingActive());
}

TEST_P(SceneFile, IsFreedThoughItNamesWhatIsAboveTheGroup) {
    osg::observer_ptr<osg::Node> freed;
    {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
        osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
        root->addChild(group);
        group->addChild(node);
        node->setReceiver({root});
        group->setCasters({group});
        const auto copy = test::throughFile(*root, kind());
        ASSERT_TRUE(copy);
        EXPECT_EQ(childOf<PlanarShadowNode>(childOf<ShadowCasterGroup>(*copy, 0), 0).getReceiver().node, copy);
        freed = copy.get();
    }
    EXPECT_FALSE(freed.valid());
}

TEST_P(SceneFile, AsksForTheBitsThatItsShadowsNeedBeforeAWindowIsMade) {
    const osg::ref_ptr<osg::DisplaySettings> before = osg::DisplaySettings::instance();
    osg::DisplaySettings::instance() = new osg::DisplaySettings;
    osg::DisplaySettings& settings = *osg::DisplaySettings::instance();
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
    group->addChild(map);
    settings.setMinimumNumStencilBits(0);
    settings.setMinimumNumAlphaBits(0);
    test::throughFile(*group, kind());
    EXPECT_EQ(settings.getMinimumNumStencilBits(), 8u);
    EXPECT_EQ(settings.getMinimumNumAlphaBits(), 0u) << "hard edges need none";
    map->setEdges(ShadowMapTechnique::SMOOTH);
    settings.setMinimumNumStencilBits(16);
    test::throughFile(*group, kind());
    EXPECT_EQ(settings.getMinimumNumStencilBits(), 16u) << "never lowered";
    EXPECT_EQ(settings.getMinimumNumAlphaBits(), 8u);
    osg::DisplaySettings::instance() = before;
}

TEST_P(SceneFile, LoadsDefaultsAsDefaults) {
    const osg::ref_ptr<ShadowCasterGroup> fresh = new ShadowCasterGroup;
    const auto copy = test::throughFile(*fresh, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getCasters(), fresh->getCasters());
    EXPECT_EQ(copy->getComposite(), fresh->getComposite());
    EXPECT_EQ(copy->getDark(), fresh->getDark());
    EXPECT_EQ(copy->getOpaqueFrom(), fresh->getOpaqueFrom());
    EXPECT_TRUE(copy->getLights().empty() && copy->getLightSources().empty());
    const osg::ref_ptr<PlanarShadowNode> freshNode = new PlanarShadowNode;
    const auto node = test::throughFile(*freshNode, kind());
    ASSERT_TRUE(node);
    EXPECT_FALSE(node->hasReceiver());
    EXPECT_TRUE(node->getPlanes().empty());
    EXPECT_TRUE(node->getStencilCure() && node->getOffsetCure() && node->getClipCure());
}

TEST_P(SceneFile, DrawsTheSamePictureOnceLoaded) {
    test::Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}, 8.0, {1.0, 0.3, 1.0, 0.0});
    scene.addShadow(test::planar(test::find(*scene.content, "ground")));
    scene.group->setComposite(ShadowCasterGroup::BLEND);
    scene.group->setDark(0.3f);
    expectSamePictureOnceLoaded(scene);
}

TEST(SceneFileText, SaysNothingOfDefaults) {
    test::usePluginsOfThisBuild();
    const std::string start = "#Ascii Scene \n#Version 161 \n#Generator OpenSceneGraph 3.6.5 \n\n";
    EXPECT_EQ(test::written(*osg::ref_ptr<osg::Node>(new ShadowCasterGroup), "osgt"),
              start + "gnomon::ShadowCasterGroup {\n  UniqueID 1 \n}\n");
    EXPECT_EQ(test::written(*osg::ref_ptr<osg::Node>(new PlanarShadowNode), "osgt"),
              start + "gnomon::PlanarShadowNode {\n  UniqueID 1 \n  CullingActive FALSE \n}\n");
    EXPECT_EQ(test::written(*osg::ref_ptr<osg::Node>(new gnomon::ShadowMapTechnique), "osgt"),
              start + "gnomon::ShadowMapTechnique {\n  UniqueID 1 \n  CullingActive FALSE \n}\n");
}

TEST(SceneFileText, CanBeWrittenByHand) {
    test::usePluginsOfThisBuild();
    const auto group = test::loadedAs<ShadowCasterGroup>(R"(#Ascii Scene
#Version 161
#Generator by hand
gnomon::ShadowCasterGroup {
  UniqueID 1
  Children 1 { gnomon::PlanarShadowNode { UniqueID 2
      Receiver { Mask 0xff Node FALSE }
      Planes 2 { 0 0 1 -.5  1e0 0 0 3 }
      ClipCure FALSE } }
  Casters { Mask 0xf0 Node FALSE }
  Composite BLEND
  Dark 0.25
  Lights 1 { 2 1 2.5 3 0 }
}
)",
                                                         "osgt");
    ASSERT_TRUE(group);
    EXPECT_EQ(group->getCasters().mask, 0xf0u);
    EXPECT_EQ(group->getComposite(), ShadowCasterGroup::BLEND);
    EXPECT_EQ(group->getDark(), 0.25f);
    EXPECT_EQ(group->getLights(), (std::vector<ShadowLight>{{2, {1.0, 2.5, 3.0, 0.0}}}));
    const auto& node = childOf<PlanarShadowNode>(*group, 0);
    EXPECT_EQ(node.getReceiver().mask, 0xffu);
    EXPECT_EQ(node.getPlanes(), (std::vector<osg::Vec4d>{{0.0, 0.0, 1.0, -0.5}, {1.0, 0.0, 0.0, 3.0}}));
    EXPECT_TRUE(node.getStencilCure() && node.getOffsetCure() && !node.getClipCure());
}

} // namespace
