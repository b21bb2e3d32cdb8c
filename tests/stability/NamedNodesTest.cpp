// SPDX-License-Identifier: MIT
// Nodes that the kit names without keeping them: what is above the one that names it is freed, and copies name their own.
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osg/observer_ptr>
#include <support/Scene.h>

#include <functional>

using namespace test;

namespace {

using gnomon::Selection;

/// A ground and a lamp beside a group with a box, a technique and a mirror.
struct Graph {
    Graph() {
        ground->setName("ground");
        root->addChild(ground);
        root->addChild(lamp);
        group->addChild(node(box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), "box"));
        group->addChild(technique);
        group->addChild(mirror);
        root->addChild(group);
    }

    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::LightSource> lamp = new osg::LightSource;
    osg::ref_ptr<osg::Node> ground = node(square(4.0));
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    osg::ref_ptr<gnomon::ShadowTechnique> technique = planar();
    osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
};

template <class Class>
Class& child(osg::Group& group, unsigned number) {
    return dynamic_cast<Class&>(*group.getChild(number));
}

/// What the graph's nodes name, and where it must stand in a copy of the root.
void expectOwnNodes(osg::Group& root) {
    auto& group = child<gnomon::ShadowCasterGroup>(root, 2);
    EXPECT_EQ(group.getCasters().node, group.getChild(0));
    ASSERT_EQ(group.getLightSources().size(), 1u);
    EXPECT_EQ(group.getLightSources().front(), root.getChild(1));
    EXPECT_EQ(child<gnomon::ShadowTechnique>(group, 1).getReceiver(), Selection({root.getChild(0), 0xffu}));
    EXPECT_EQ(child<gnomon::PlanarReflectionNode>(group, 2).getSurface().node, root.getChild(0));
}

void name(Graph& graph) {
    graph.group->setCasters({graph.group->getChild(0)});
    graph.group->addLight(graph.lamp);
    graph.technique->setReceiver({graph.ground, 0xffu});
    graph.mirror->setSurface({graph.ground});
}

} // namespace

TEST(NamedNodes, AboveTheOneThatNamesThemAreFreed) {
    const std::vector<std::function<void(Graph&)>> namings = {[](Graph& g) { g.technique->setReceiver({g.group}); },
                                                              [](Graph& g) { g.technique->setReceiver({g.root}); },
                                                              [](Graph& g) { g.group->setCasters({g.root}); },
                                                              [](Graph& g) { g.group->setCasters({g.group}); },
                                                              [](Graph& g) { g.mirror->setSurface({g.root}); },
                                                              [](Graph& g) {
                                                                  g.lamp->addChild(g.group);
                                                                  g.group->addLight(g.lamp);
                                                              },
                                                              [](Graph& g) {
                                                                  osg::ref_ptr<gnomon::TerrainShadowGeode> shadows =
                                                                      new gnomon::TerrainShadowGeode;
                                                                  shadows->setReceiver({g.root});
                                                                  g.group->addChild(shadows);
                                                              }};
    for (std::size_t i = 0; i < namings.size(); ++i) {
        osg::observer_ptr<osg::Node> root, group;
        {
            Graph graph;
            namings[i](graph);
            graph.group->casters()->layers();
            root = graph.root.get();
            group = graph.group.get();
        }
        EXPECT_FALSE(root.valid()) << i;
        EXPECT_FALSE(group.valid()) << i;
    }
}

TEST(NamedNodes, OfADeepCopyOfTheRootAreItsOwn) {
    osg::ref_ptr<osg::Group> copy, again;
    {
        Graph graph;
        name(graph);
        copy = osg::clone(graph.root.get(), osg::CopyOp::DEEP_COPY_ALL);
        again = osg::clone(copy.get(), osg::CopyOp::DEEP_COPY_ALL); // before anything has asked the first
        expectOwnNodes(*graph.root);
    }
    expectOwnNodes(*copy);
    expectOwnNodes(*again);
}

TEST(NamedNodes, OfADeepCopyBesideItsOriginalAreItsOwn) {
    Graph graph;
    name(graph);
    osg::ref_ptr<osg::Group> both = new osg::Group;
    osg::ref_ptr<osg::Group> copy = osg::clone(graph.root.get(), osg::CopyOp::DEEP_COPY_ALL);
    both->addChild(graph.root);
    both->addChild(copy);
    expectOwnNodes(*copy);
}

TEST(NamedNodes, BesideTheGroupStayTheSameForACopyOfTheGroupAlone) {
    Graph graph;
    name(graph);
    osg::ref_ptr<gnomon::ShadowCasterGroup> copy = osg::clone(graph.group.get(), osg::CopyOp::DEEP_COPY_ALL);
    EXPECT_EQ(copy->getCasters().node, copy->getChild(0));
    graph.root->replaceChild(graph.group, copy);
    expectOwnNodes(*graph.root);
}

TEST(NamedNodes, OfACopyOfACopyAreThoseOfTheGraphThatItComesTo) {
    Graph graph;
    name(graph);
    const osg::ref_ptr<osg::Group> root = osg::clone(graph.root.get(), osg::CopyOp::DEEP_COPY_ALL);
    const osg::ref_ptr<osg::Group> first = osg::clone(graph.group.get(), osg::CopyOp::DEEP_COPY_ALL),
                                   second = osg::clone(first.get(), osg::CopyOp::DEEP_COPY_ALL);
    root->replaceChild(root->getChild(2), second);
    expectOwnNodes(*root);
}

TEST(NamedNodes, ThatAreGoneSelectNothing) {
    Graph graph;
    graph.technique->setReceiver({node(square(1.0))});
    graph.group->setCasters({node(square(1.0))});
    graph.group->addLight(osg::ref_ptr<osg::LightSource>(new osg::LightSource));
    EXPECT_TRUE(graph.technique->isReceiverGone());
    EXPECT_TRUE(graph.technique->hasReceiver());
    EXPECT_EQ(graph.technique->getReceiver(), Selection({nullptr, 0u}));
    EXPECT_TRUE(graph.group->areCastersGone());
    EXPECT_TRUE(graph.group->casters()->empty());
    EXPECT_EQ(graph.group->getNumLightSources(), 1u);
    EXPECT_TRUE(graph.group->getLightSources().empty());
}
