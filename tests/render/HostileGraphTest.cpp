// SPDX-License-Identifier: MIT
// What a user's graph may hold against the compositor: the right pixel, or the reason why not.
#include <support/Causes.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>
#include <osg/Stencil>
#include <osgUtil/CullVisitor>

using namespace test;

namespace {

const View slanted = perspective({-6.0, -10.0, 6.0}, {0.0, 0.0, 0.0}, 300, 200);

Scene boxScene() { return groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})}); }

void expectOneCause(const gnomon::ShadowTechnique& technique, const std::string& part) {
    const std::vector<std::string> causes = causesButLitSurfaces(technique); // some casters shadow each other
    ASSERT_EQ(causes.size(), 1u) << (causes.size() > 1 ? causes[1] : "");
    EXPECT_NE(causes[0].find(part), std::string::npos) << causes[0];
}

/// Draws a square before the eye by a leaf of its own, as osgSim::LightPointNode does.
class BareLeaf : public osg::Node {
public:
    explicit BareLeaf(bool projected, const glm::dvec3& before = {-1.0, 0.4, -3.0})
        : _projected(projected), _before(node(quad(before, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}))) {
        setCullingActive(false);
    }
    void traverse(osg::NodeVisitor& visitor) override {
        osgUtil::CullVisitor* cull = visitor.asCullVisitor();
        if (!cull) return;
        osgUtil::StateGraph* graph = cull->getCurrentStateGraph();
        if (graph->leaves_empty()) cull->getCurrentRenderBin()->addStateGraph(graph);
        osg::RefMatrix* projection = _projected ? cull->getProjectionMatrix() : nullptr;
        graph->addLeaf(
            new osgUtil::RenderLeaf((_projected ? _before : _onScreen)->getDrawable(0), projection, nullptr, 0.0f));
    }

private:
    const bool _projected;
    const osg::ref_ptr<osg::Geode> _before, _onScreen = node(quad({-0.9, 0.5, 0.0}, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}));
};

/// Hands what it draws to visitors, as osgTerrain's tiles do, or to culls alone: nothing of it is its child.
class Hands : public osg::Node {
public:
    Hands(osg::Node* drawn, bool toAll) : _drawn(drawn), _toAll(toAll) {}
    void traverse(osg::NodeVisitor& visitor) override {
        if (_toAll || visitor.asCullVisitor()) _drawn->accept(visitor);
    }
    osg::BoundingSphere computeBound() const override { return _drawn->getBound(); }

private:
    const osg::ref_ptr<osg::Node> _drawn;
    const bool _toAll;
};

/// Counts the visits of visitors that are no traversal of the viewer's.
class Counted : public osg::Group {
public:
    void traverse(osg::NodeVisitor& visitor) override {
        visits += visitor.getVisitorType() == osg::NodeVisitor::NODE_VISITOR;
        osg::Group::traverse(visitor);
    }
    int visits = 0;
};

/// Puts a node that hands it on in the place of the content's child of that name.
osg::ref_ptr<osg::Node> handOn(Scene& scene, const std::string& name, bool toAll = true) {
    const osg::ref_ptr<osg::Node> child = find(*scene.root, name), hands = new Hands(child, toAll);
    scene.content->replaceChild(child, hands);
    return hands;
}

} // namespace

TEST(HostileGraph, ANamedReceiverThatHandsOnWhatItDrawsIsShadowedAsItsChildWouldBe) {
    const auto picture = [](const std::string& spec, bool handed, int naming) {
        Scene scene = boxScene();
        osg::ref_ptr<osg::Node> ground = find(*scene.root, "ground"), caster = find(*scene.root, "caster");
        if (handed) ground = handOn(scene, "ground");
        ground->setNodeMask(1);
        caster->setNodeMask(2);
        scene.addShadow(spec);
        auto* technique =
            dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(scene.group->getNumChildren() - 1));
        technique->setReceiver(naming == 0 ? gnomon::Selection{ground}
                                           : gnomon::Selection{nullptr, naming == 1 ? 1u : 2u});
        return render(scene.root, perspective({-6.0, -10.0, 6.0}, {0.0, 0.0, 0.0}, 90, 60));
    };
    for (const std::string spec : {"planar", "map", "volume:composite=blend", "traced", "hull"})
        for (const int naming : {0, 1, 2}) { // by node, by its mask, by another mask
            const Picture expected = picture(spec, false, naming);
            EXPECT_EQ(picture(spec, true, naming).different(expected), 0) << spec << ", " << naming;
            if (naming < 2) EXPECT_GT(expected.count(shadowedGround), 100) << spec;
        }
}

TEST(HostileGraph, AReceiverOfWhichAPartStandsElsewhereIsVisitedOnTheWayToThatPartAlone) {
    const auto picture = [](bool shared) {
        Scene scene = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})});
        const osg::ref_ptr<osg::Node> ground = find(*scene.root, "ground"), plate = node(square(1.0, 0.01));
        const osg::ref_ptr<osg::Group> receiver = new osg::Group;
        const osg::ref_ptr<Counted> rest = new Counted;
        scene.content->replaceChild(ground, receiver);
        receiver->addChild(rest);
        rest->addChild(ground);
        receiver->addChild(plate);
        const osg::ref_ptr<osg::MatrixTransform> beside =
            new osg::MatrixTransform(osg::Matrixd::translate(-1.5, 0.0, 0.1));
        beside->addChild(shared ? plate.get() : osg::clone(plate.get(), osg::CopyOp::DEEP_COPY_ALL));
        scene.content->addChild(beside);
        scene.addShadow("map");
        scene.group->setCasters({find(*scene.root, "caster")});
        dynamic_cast<gnomon::ShadowTechnique&>(*scene.group->getChild(1)).setReceiver({receiver});
        Camera camera(scene.root, slanted);
        camera.frame();
        rest->visits = 0;
        const Picture drawn = camera.frame();
        EXPECT_EQ(rest->visits, 0) << shared;
        return drawn;
    };
    EXPECT_EQ(picture(true).different(picture(false)), 0);
}

TEST(HostileGraph, ACasterThatHandsOnWhatItDrawsCastsWhereItIsNamed) {
    Scene scene = boxScene(), expected = boxScene();
    for (Scene* each : {&scene, &expected}) each->addShadow("traced");
    scene.group->setCasters({handOn(scene, "caster")});
    expected.group->setCasters({find(*expected.root, "caster")});
    EXPECT_EQ(render(scene.root, slanted).different(render(expected.root, slanted)), 0);
}

TEST(HostileGraph, AReceiverInSightUnderWhichNothingIsFoundIsNamedAsTheCause) {
    for (const bool byNode : {true, false}) {
        Scene scene = boxScene();
        const osg::ref_ptr<osg::Node> ground = handOn(scene, "ground", false);
        ground->setName("tile");
        const auto technique = planar();
        technique->setReceiver(byNode ? gnomon::Selection{ground} : gnomon::Selection{nullptr, 0u});
        scene.addShadow(technique);
        render(scene.root, slanted);
        expectOneCause(*technique, byNode ? "nothing that is drawn is found under the receiver 'tile'"
                                          : "nothing that is drawn is found under the receiver.");
        render(scene.root, perspective({0.0, 0.0, 50.0}, {0.0, 1.0, 500.0}));
        EXPECT_EQ(technique->diagnose().size(), byNode ? 0u : 1u); // where a mask would be seen nobody knows
    }
}

/// Where the leaf is, the picture is that without shadows; elsewhere it is that without the leaf.
TEST(HostileGraph, ALeafWithoutMatricesIsDrawnAndLeavesTheShadowsRight) {
    for (const bool projected : {true, false})
        for (const int way : {0, 1, 2, 3, 4}) {
            const auto picture = [&](bool leaf, bool shadow) {
                Scene scene = boxScene();
                const osg::ref_ptr<BareLeaf> bare = new BareLeaf(projected);
                bare->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
                if (leaf) scene.root->addChild(bare);
                if (shadow && way == 0) scene.addShadow(new gnomon::TracedShadowTechnique);
                if (shadow && way == 1) scene.addShadow(new gnomon::ShadowMapTechnique);
                if (shadow && way == 4) scene.addShadow(new gnomon::ShadowVolumeTechnique);
                if (shadow && (way == 2 || way == 3))
                    scene.addShadow(planar(way == 3 ? find(*scene.root, "ground") : nullptr));
                return render(scene.root, slanted);
            };
            const Picture plain = picture(false, false), leaf = picture(true, false), shadow = picture(false, true),
                          both = picture(true, true);
            EXPECT_GT(plain.different(leaf), 500);
            EXPECT_GT(plain.different(shadow), 500);
            int wrong = 0;
            for (std::size_t i = 0; i < both.pixels.size(); ++i)
                wrong += both.pixels[i] != (leaf.pixels[i] != plain.pixels[i] ? leaf.pixels[i] : shadow.pixels[i]);
            EXPECT_EQ(wrong, 0) << "way " << way << (projected ? ", projected" : "");
        }
}

/// Whatever its state makes planar, and who looks for causes, ask of it.
TEST(HostileGraph, ALeafWithoutMatricesMayLieOverTheShadowOfAPlane) {
    const auto picture = [](bool lit, bool shadow) {
        Scene scene = boxScene();
        const osg::ref_ptr<BareLeaf> bare = new BareLeaf(true, {-0.3, -0.2, -3.0});
        osg::StateSet& state = *bare->getOrCreateStateSet();
        if (!lit) state.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        state.setAttributeAndModes(new osg::CullFace);
        state.setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
        scene.root->addChild(bare);
        if (shadow) scene.addShadow(planar());
        return render(scene.root, slanted);
    };
    Scene bare = boxScene();
    bare.addShadow(planar());
    const Picture without = render(bare.root, slanted);
    for (const bool lit : {false, true}) {
        const Picture plain = picture(lit, false), shadowed = picture(lit, true);
        EXPECT_GT(plain.different(shadowed), 100);
        EXPECT_LT(plain.different(shadowed), render(boxScene().root, slanted).different(without) - 100)
            << "the leaf lies over some of it";
    }
}

TEST(HostileGraph, LeafHiddenByItsOwnStencilTestStaysHidden) {
    for (const bool named : {false, true}) {
        Scene scene = boxScene();
        const osg::ref_ptr<osg::Geode> hidden = node(square(4.0, 0.5));
        osg::ref_ptr<osg::Stencil> never = new osg::Stencil;
        never->setFunction(osg::Stencil::EQUAL, 1, 1u);
        hidden->getOrCreateStateSet()->setAttributeAndModes(never);
        scene.content->addChild(hidden);
        const Picture lit = render(scene.root, slanted);
        const auto technique = planar(named ? find(*scene.root, "ground") : nullptr);
        scene.addShadow(technique);
        scene.group->setCasters({find(*scene.root, "caster")});
        const Picture shadowed = render(scene.root, slanted);
        int changed = 0, other = 0; // every changed pixel is the ground's, blended
        for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
            changed += shadowed.pixels[i] != lit.pixels[i];
            other += shadowed.pixels[i] != lit.pixels[i] && shadowed.pixels[i] != grey(litGround / 2);
        }
        EXPECT_GT(changed, 500);
        EXPECT_EQ(other, 0);
        expectOneCause(*technique, "stencil test");
    }
}

TEST(HostileGraph, BlendKeepsToTheChannelsThatTheSceneWrites) {
    for (const bool named : {false, true}) {
        Scene scene = boxScene();
        scene.root->getOrCreateStateSet()->setAttribute(new osg::ColorMask(true, false, false, true));
        const Picture lit = render(scene.root, slanted);
        scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        const Picture shadowed = render(scene.root, slanted);
        int red = 0, others = 0;
        for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
            const std::uint32_t difference = lit.pixels[i] ^ shadowed.pixels[i];
            red += (difference & 0xffu) != 0;
            others += (difference & 0xffffff00u) != 0;
        }
        EXPECT_GT(red, 500);
        EXPECT_EQ(others, 0);
    }
}

TEST(HostileGraph, ReceiverThatCannotReceiveIsNamedAsTheCause) {
    Scene transparent = boxScene();
    osg::StateSet& late = *find(*transparent.root, "ground")->getOrCreateStateSet();
    late.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    late.setAttribute(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
    const auto above = planar(find(*transparent.root, "ground"));
    transparent.addShadow(above);
    render(transparent.root, slanted);
    expectOneCause(*above, "bin above 8");

    Scene scene = boxScene();
    const osg::ref_ptr<osg::Geode> elsewhere = node(square(1.0), "elsewhere");
    const auto outside = planar(elsewhere);
    scene.addShadow(outside);
    const Picture first = render(scene.root, slanted);
    expectOneCause(*outside, "the receiver 'elsewhere' is not in this scene graph");
    EXPECT_EQ(first.different(render(boxScene().root, slanted)), 0);
}

TEST(HostileGraph, ReceiverOutOfSightIsNoCause) {
    Scene scene = boxScene();
    const auto technique = planar(find(*scene.root, "ground"));
    scene.addShadow(technique);
    render(scene.root, perspective({0.0, 0.0, 5.0}, {0.0, 1.0, 50.0}));
    EXPECT_TRUE(technique->diagnose().empty());
}

TEST(HostileGraph, NestedCameraWithItsOwnViewportIsRefusedWithTheReason) {
    Scene scene = boxScene();
    const auto technique = planar();
    scene.addShadow(technique);
    osg::ref_ptr<osg::Camera> nested = new osg::Camera;
    nested->setRenderOrder(osg::Camera::NESTED_RENDER);
    nested->setReferenceFrame(osg::Transform::RELATIVE_RF);
    nested->setViewport(10, 10, 50, 50);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(nested);
    nested->addChild(scene.root);
    render(root, slanted);
    expectOneCause(*technique, "nested camera");
}

TEST(HostileGraph, LightNumbersThatOpenGLLacksAreRefused) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    for (const int number : {-1, 8, 40}) group->addLight({number, osg::Vec4d(0.0, 0.0, 1.0, 0.0)});
    EXPECT_TRUE(group->getLights().empty());
    group->setLights({{7, osg::Vec4d(0.0, 0.0, 1.0, 0.0)}, {8, osg::Vec4d(0.0, 0.0, 1.0, 0.0)}});
    EXPECT_EQ(group->getLights().size(), 1u);
}

// Half of 2,000 instances of one tile receive: each leaf must be told apart.
TEST(HostileGraph, InstancesAreToldApartOnceEach) {
    Scene scene = test::scene();
    const osg::ref_ptr<osg::Geode> tile = node(square(0.05));
    osg::ref_ptr<osg::Group> half = new osg::Group;
    for (int i = 0; i < 2000; ++i) {
        osg::ref_ptr<osg::MatrixTransform> place =
            new osg::MatrixTransform(osg::Matrixd::translate(i % 50 * 0.1 - 2.45, i / 50 * 0.1 - 1.95, 0.0));
        place->addChild(tile);
        if (i / 50 < 20)
            half->addChild(place);
        else
            scene.content->addChild(place);
    }
    scene.content->addChild(half);
    scene.content->addChild(
        node(square(6.0, 8.0), "caster")); // its shadow, 8 m to the left, covers all tiles up to x = -2
    scene.addShadow(planar(half));
    scene.group->setCasters({find(*scene.root, "caster")});
    View view = fromAbove(2.5);
    view.view.makeLookAt({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}); // under the caster
    Camera camera(scene.root, view);
    const Picture picture = camera.frame();
    // Columns of tiles to x = -2, rows to y = 0: 0.5 × 2 m of 51.2² pixels each, to a pixel around.
    EXPECT_NEAR(picture.count(shadowedGround), 0.5 * 2.0 * 51.2 * 51.2, 2.0 * (0.5 + 2.0) * 51.2);
}
