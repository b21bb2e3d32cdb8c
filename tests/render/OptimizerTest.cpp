// SPDX-License-Identifier: MIT
// osgUtil::Optimizer, which stock osgviewer runs on every file: the picture after it is the picture before.
#include <gnomon/HaloNode.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osgUtil/Optimizer>
#include <support/Picture.h>
#include <support/Scene.h>

#include <functional>

using namespace test;

namespace {

using gnomon::ShadowTechnique;
using osgUtil::Optimizer;

/// What an osgviewer runs, all there is, and what flattens transforms alone.
const std::vector<unsigned> allOptions = {Optimizer::DEFAULT_OPTIMIZATIONS,
                                          Optimizer::ALL_OPTIMIZATIONS | Optimizer::DEFAULT_OPTIMIZATIONS,
                                          Optimizer::ALL_OPTIMIZATIONS,
                                          Optimizer::FLATTEN_STATIC_TRANSFORMS,
                                          Optimizer::FLATTEN_STATIC_TRANSFORMS_DUPLICATING_SHARED_SUBGRAPHS,
                                          Optimizer::REMOVE_REDUNDANT_NODES,
                                          Optimizer::MERGE_GEODES,
                                          Optimizer::SPATIALIZE_GROUPS};

osg::ref_ptr<osg::MatrixTransform> placed(osg::Node* node, const osg::Matrixd& matrix) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->setDataVariance(osg::Object::STATIC);
    transform->addChild(node);
    return transform;
}

osg::ref_ptr<osg::Group> below(osg::Node* node) {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(node);
    return group;
}

/// A ground and two boxes, each below a transform, below a group that is below another.
struct Stage {
    Stage() {
        ground = placed(node(square(6.0)), osg::Matrixd::translate(0.0, 0.0, -1.0));
        named = below(node(box({-1.0, -1.0, 0.0}, {0.0, 0.0, 1.0})));
        other = placed(node(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0})), osg::Matrixd::translate(0.5, 0.5, 0.5));
        group->addChild(named);
        group->addChild(other);
        osg::ref_ptr<osg::Group> inside = new osg::Group;
        inside->addChild(ground);
        inside->addChild(group);
        scene.content->addChild(
            placed(inside, osg::Matrixd::rotate(0.2, osg::Z_AXIS) * osg::Matrixd::translate(0.3, -0.2, 1.0)));
    }

    Scene scene = test::scene({1.0, 0.0, 1.0, 0.0});
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    osg::ref_ptr<osg::MatrixTransform> ground, other;
    osg::ref_ptr<osg::Group> named;
};

/// What a case adds to the stage.
using Case = std::function<void(Stage&)>;

template <class Technique>
osg::ref_ptr<Technique> added(Stage& stage) {
    osg::ref_ptr<Technique> technique = new Technique;
    stage.group->addChild(technique);
    return technique;
}

osg::ref_ptr<gnomon::PlanarShadowNode> onGround(Stage& stage) {
    const auto planar = added<gnomon::PlanarShadowNode>(stage);
    planar->setPlanes({osg::Vec4d(0.0, 0.0, 1.0, 1.0)}); // of the group's frame
    return planar;
}

const std::vector<std::pair<std::string, Case>> cases = {
    {"planar", [](Stage& s) { onGround(s); }},
    {"planar on a named transform", [](Stage& s) { onGround(s)->setReceiver({s.ground}); }},
    {"planar below a transform",
     [](Stage& s) {
         osg::ref_ptr<gnomon::PlanarShadowNode> planar = new gnomon::PlanarShadowNode({0.0, 0.0, 1.0, 0.0});
         s.group->addChild(placed(planar, osg::Matrixd::translate(0.0, 0.0, -1.0)));
     }},
    {"a named group casts",
     [](Stage& s) {
         onGround(s);
         s.group->setCasters({s.named});
     }},
    {"a named transform casts",
     [](Stage& s) {
         onGround(s);
         s.group->setCasters({s.other});
     }},
    {"a light given in the group's frame",
     [](Stage& s) {
         onGround(s);
         s.group->addLight(gnomon::ShadowLight{0, {1.0, 0.4, 1.0, 0.0}});
     }},
    {"map", [](Stage& s) { added<gnomon::ShadowMapTechnique>(s); }},
    {"map on a named geode",
     [](Stage& s) { added<gnomon::ShadowMapTechnique>(s)->setReceiver({s.ground->getChild(0)}); }},
    {"map on two named nodes",
     [](Stage& s) {
         added<gnomon::ShadowMapTechnique>(s)->setReceiver({s.ground, ~0u, {s.named}});
     }},
    {"traced", [](Stage& s) { added<gnomon::TracedShadowTechnique>(s)->setReceiver({s.ground}); }},
    {"hull", [](Stage& s) { added<gnomon::TerrainShadowGeode>(s)->setReceiver({s.ground}); }},
    {"mirror",
     [](Stage& s) {
         onGround(s);
         osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
         mirror->addChild(below(node(box({-2.0, 1.0, 0.0}, {-1.0, 2.0, 1.0}))));
         mirror->setPlane({0.0, 0.0, 1.0, 1.0});
         mirror->setSurface({s.ground});
         s.group->getParent(0)->addChild(mirror);
     }},
    {"halo", [](Stage& s) {
         onGround(s);
         osg::ref_ptr<gnomon::HaloNode> halo = new gnomon::HaloNode;
         halo->addChild(below(node(box({-2.0, 1.0, 0.0}, {-1.0, 2.0, 1.0}))));
         s.group->getParent(0)->addChild(halo);
     }}};

const View view = perspective({-5.0, -9.0, 8.0}, {0.0, 0.0, 0.5}, 320, 240);

Picture pictureOf(const Case& add, unsigned options) {
    Stage stage;
    add(stage);
    if (options) Optimizer().optimize(stage.scene.root, options);
    return render(stage.scene.root, view);
}

} // namespace

TEST(Optimizer, ChangesNoPixelOfAnyTechniqueOrEffect) {
    const Picture plain = pictureOf([](Stage&) {}, 0);
    for (const auto& [name, add] : cases) {
        const Picture before = pictureOf(add, 0);
        EXPECT_GT(before.different(plain), 100) << name;
        for (const unsigned options : allOptions)
            EXPECT_LE(before.different(pictureOf(add, options)), pictureOf([](Stage&) {}, options).different(plain))
                << name << " with " << options;
    }
}

TEST(Optimizer, StillOptimizesAGroupThatNamesNothing) {
    Stage stage;
    added<gnomon::ShadowMapTechnique>(stage);
    Optimizer().optimize(stage.scene.root, Optimizer::DEFAULT_OPTIMIZATIONS);
    EXPECT_STREQ(stage.group->getChild(0)->className(), "Geode") << "no redundant group";
    EXPECT_FALSE(stage.group->getChild(1)->asTransform()) << "no static transform";
}
