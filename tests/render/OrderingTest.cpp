// SPDX-License-Identifier: MIT
// What is drawn below, among and above the compositor's bin: decals, overlays, glass, clipping, queries and bins of all
// kinds.
#include "TwoGrounds.h"

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/ClipNode>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/OcclusionQueryNode>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>
#include <osgUtil/RenderBin>

using namespace test;

namespace {

const Mesh decalMesh = quad({-1.5, -2.2, 0.0}, {2.0, 0.0, 0.0}, {0.0, 2.4, 0.0}); // over both grounds and shadows
const Mesh raised = moved(quad({-2.5, -2.5, 0.0}, {2.5, 0.0, 0.0}, {0.0, 2.0, 0.0}), {0.0, 0.0, 0.6});

void colour(osg::Geode& geode, const osg::Vec4& color) {
    auto* colors = static_cast<osg::Vec4Array*>(geode.getDrawable(0)->asGeometry()->getColorArray());
    colors->front() = color;
}

osg::ref_ptr<osg::Geode> unlit(const Mesh& mesh, const osg::Vec4& color) {
    const osg::ref_ptr<osg::Geode> geode = node(mesh, "unlit");
    colour(*geode, color);
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return geode;
}

void keepDepth(osg::Node& node) {
    node.getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
}

/// As painted on the ground: offset towards the eye, depth not written.
void paintOn(osg::Node& node) {
    keepDepth(node);
    node.getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
}

void blendIn(osg::Node& node) {
    node.getOrCreateStateSet()->setAttributeAndModes(new osg::BlendFunc);
    keepDepth(node);
}

void useBin(osg::Node& node, int number, const std::string& name = "RenderBin") {
    node.getOrCreateStateSet()->setRenderBinDetails(number, name);
}

Trial litDecal(int bin) {
    Trial trial;
    trial.over = decalMesh;
    trial.change = [bin](Scene& scene) {
        const osg::ref_ptr<osg::Geode> decal = node(decalMesh, "decal");
        osg::ref_ptr<osg::Material> red = new osg::Material;
        red->setDiffuse(osg::Material::FRONT_AND_BACK, {1.0f, 0.2f, 0.1f, 1.0f});
        red->setAmbient(osg::Material::FRONT_AND_BACK, {1.0f, 0.2f, 0.1f, 1.0f});
        decal->getOrCreateStateSet()->setAttributeAndModes(red);
        paintOn(*decal);
        if (bin) useBin(*decal, bin);
        scene.content->addChild(decal);
    };
    return trial;
}

/// Blends without light, so that it shows as it would over any picture.
Trial glassDecal(int bin) {
    Trial trial;
    trial.cause = "no light can be taken from 'unlit'";
    trial.change = [bin](Scene& scene) {
        const osg::ref_ptr<osg::Geode> decal = unlit(decalMesh, {0.2f, 1.0f, 0.2f, 0.4f});
        paintOn(*decal);
        blendIn(*decal);
        useBin(*decal, bin);
        scene.content->addChild(decal);
    };
    return trial;
}

/// An overlay in pixels of its own, over shadows too.
Trial overlay(osg::Camera::RenderOrder order, int bin) {
    Trial trial;
    trial.change = [order, bin](Scene& scene) {
        osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        camera->setRenderOrder(order);
        camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
        camera->setProjectionMatrix(osg::Matrixd::ortho2D(0.0, 200.0, 0.0, 150.0));
        camera->setClearMask(order == osg::Camera::NESTED_RENDER ? 0 : GL_DEPTH_BUFFER_BIT);
        camera->addChild(unlit(quad({60.0, 40.0, 0.0}, {70.0, 0.0, 0.0}, {0.0, 60.0, 0.0}), {1.0f, 1.0f, 0.0f, 1.0f}));
        camera->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
        if (bin) useBin(*camera, bin);
        scene.root->addChild(camera);
    };
    return trial;
}

/// Two panes one behind the other over shadows: the farther must be drawn first.
void addPanes(osg::Group& parent) {
    for (const double y : {-1.2, 1.6}) { // the nearer first
        const float red = y < 0.0 ? 1.0f : 0.0f;
        const Mesh pane = quad({-3.0, y, 0.05}, {4.0, 0.0, 0.0}, {0.0, 0.0, 2.5});
        const osg::ref_ptr<osg::Geode> glass = unlit(pane, {red, 0.5f, 1.0f - red, 0.5f});
        blendIn(*glass);
        parent.addChild(glass);
    }
}

Trial panes(int bin, const std::string& name) {
    Trial trial;
    trial.change = [bin, name](Scene& scene) { // beside the group: they do not cast
        osg::ref_ptr<osg::Group> glass = new osg::Group;
        addPanes(*glass);
        for (unsigned i = 0; i < glass->getNumChildren(); ++i) useBin(*glass->getChild(i), bin, name);
        scene.root->addChild(glass);
    };
    return trial;
}

/// A table in a bin, met in the graph before the technique or after it: the root's last child is the content or the group
/// that wraps it.
Trial tableInBin(int number, const std::string& name, bool beforeTheTechnique) {
    const auto addTable = [number, name](osg::Group& parent) {
        const osg::ref_ptr<osg::Geode> table = node(raised, "table");
        useBin(*table, number, name);
        parent.addChild(table);
    };
    Trial trial;
    trial.before = raised;
    if (beforeTheTechnique)
        trial.change = [addTable](Scene& scene) { addTable(*scene.content); };
    else
        trial.set = [addTable](Camera& camera) {
            osg::Group* root = camera.viewer().getSceneData()->asGroup();
            addTable(*root->getChild(root->getNumChildren() - 1)->asGroup());
        };
    return trial;
}

/// A kind of bin that lays an attribute over its leaves.
class BinKind {
public:
    BinKind(const std::string& name, osg::StateAttribute& attribute) {
        osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
        set->setAttribute(&attribute, osg::StateAttribute::OVERRIDE);
        _bin->setStateSet(set);
        osgUtil::RenderBin::addRenderBinPrototype(name, _bin);
    }
    ~BinKind() { osgUtil::RenderBin::removeRenderBinPrototype(_bin); }
    BinKind(const BinKind&) = delete;
    BinKind& operator=(const BinKind&) = delete;

private:
    osg::ref_ptr<osgUtil::RenderBin> _bin = new osgUtil::RenderBin(osgUtil::RenderBin::SORT_BACK_TO_FRONT);
};

class Ordering : public testing::TestWithParam<TwoGrounds> {};
INSTANTIATE_TEST_SUITE_P(Planar, Ordering, testing::ValuesIn(allTwoGrounds()),
                         [](const auto& place) { return nameOf(place.param); });

} // namespace

TEST_P(Ordering, PlainScene) { EXPECT_TRUE(isExact(GetParam(), {})); }

TEST_P(Ordering, DecalIsAReceiverWhereNoneIsNamedElseStaysOverTheShadow) {
    for (const int bin : {0, 1, 7}) EXPECT_TRUE(isExact(GetParam(), litDecal(bin))) << "bin " << bin;
}

TEST_P(Ordering, BlendingDecalBlendsOverTheShadowedGround) {
    for (const int bin : {1, 7}) EXPECT_TRUE(isExact(GetParam(), glassDecal(bin))) << "bin " << bin;
}

TEST_P(Ordering, OverlayStaysAsItIs) {
    using C = osg::Camera;
    EXPECT_TRUE(isExact(GetParam(), overlay(C::NESTED_RENDER, 0)));
    EXPECT_TRUE(isExact(GetParam(), overlay(C::NESTED_RENDER, 11)));
    EXPECT_TRUE(isExact(GetParam(), overlay(C::POST_RENDER, 0)));
}

TEST_P(Ordering, GlassBlendsOverTheShadowedGround) {
    EXPECT_TRUE(isExact(GetParam(), panes(10, "DepthSortedBin")));
    EXPECT_TRUE(isExact(GetParam(), panes(4, "DepthSortedBin")));
    EXPECT_TRUE(isExact(GetParam(), panes(4, "TraversalOrderBin")));
    EXPECT_TRUE(isExact(GetParam(), panes(-2, "DepthSortedBin")));
}

TEST_P(Ordering, GlassInABinOfTheCompositorsNumberIsSorted) {
    EXPECT_TRUE(isExact(GetParam(), panes(8, "DepthSortedBin")));
    EXPECT_TRUE(isExact(GetParam(), panes(8, "TraversalOrderBin")));
}

TEST_P(Ordering, ThingsInABinOfTheCompositorsNumberAreDrawn) {
    for (const char* name : {"RenderBin", "TraversalOrderBin"})
        for (const bool first : {true, false})
            EXPECT_TRUE(isExact(GetParam(), tableInBin(8, name, first))) << name << first;
}

TEST_P(Ordering, BinsUnderBins) {
    Trial trial;
    trial.change = [](Scene& scene) {
        osg::ref_ptr<osg::Group> outer = new osg::Group, glass = new osg::Group, panes = new osg::Group;
        osg::ref_ptr<osg::Node> grounds = find(*scene.root, "grounds");
        scene.content->replaceChild(grounds, outer);
        outer->addChild(grounds);
        useBin(*find(*grounds, "left"), -1, "TraversalOrderBin");
        useBin(*find(*grounds, "right"), 2, "SORT_BACK_TO_FRONT");
        addPanes(*panes);
        useBin(*panes, 10, "DepthSortedBin");
        glass->addChild(panes);
        scene.root->addChild(glass);                              // not a caster
        for (const auto& each : {outer, glass}) useBin(*each, 3); // in it -1, 2 and 10
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}

TEST_P(Ordering, BinsWithStateSetsOfTheirOwn) {
    osg::ref_ptr<osg::Material> green = new osg::Material;
    green->setDiffuse(osg::Material::FRONT_AND_BACK, {0.2f, 1.0f, 0.3f, 1.0f});
    osg::ref_ptr<osg::LightModel> dim = new osg::LightModel;
    dim->setAmbientIntensity({0.02f, 0.05f, 0.3f, 1.0f});
    const BinKind outer("green", *green), inner("dim", *dim);
    Trial trial;
    trial.change = [](Scene& scene) {
        useBin(*find(*scene.root, "grounds"), 2, "green");
        useBin(*find(*scene.root, "right"), 1, "dim"); // in the green one
        useBin(*find(*scene.root, "house"), 5);
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}

/// State that would spoil marks, were it still in force when they are drawn.
TEST_P(Ordering, LastLeafBelowIsDrawnUnlikeAnyOther) {
    Trial trial;
    trial.change = [](Scene& scene) {
        const osg::ref_ptr<osg::Geode> speck = unlit(quad({3.2, -2.0, -1.0}, {0.3, 0.0, 0.0}, {0.0, 0.3, 0.0}), {});
        osg::ref_ptr<osg::ClipNode> above = new osg::ClipNode; // its state is inherited, the speck has one of its own
        above->addClipPlane(new osg::ClipPlane(0, 1.0, 0.0, 0.0, -3.0));
        above->addChild(speck);
        osg::StateSet* set = above->getOrCreateStateSet();
        set->setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::POINT));
        set->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::NEVER, 0.5f));
        set->setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT));
        set->setAttribute(new osg::FrontFace(osg::FrontFace::CLOCKWISE));
        set->setAttribute(new osg::ColorMask(false, false, false, false));
        set->setRenderBinDetails(7, "RenderBin");
        scene.root->addChild(above);
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}

TEST_P(Ordering, ReceiverThatBlendsOverAnUnlitFloor) {
    TwoGrounds place = GetParam();
    if (place.named == Named::Nothing) return; // then the floor would receive as well
    Trial trial;
    trial.change = [](Scene& scene) {
        scene.root->addChild(unlit(square(7.0, -1.0), {0.3f, 0.5f, 0.1f, 1.0f}));
        for (const char* name : {"left", "right"}) {
            auto* ground = find(*scene.root, name);
            colour(*ground->asGeode(), {1.0f, 1.0f, 1.0f, 0.5f});
            auto* set = ground->getOrCreateStateSet();
            set->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
            set->setRenderBinDetails(5, "RenderBin");
        }
    };
    EXPECT_TRUE(isExact(place, trial));
}

TEST_P(Ordering, ClippedReceiver) {
    TwoGrounds place = GetParam();
    Trial trial;
    trial.change = [](Scene& scene) {
        osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
        clip->addClipPlane(new osg::ClipPlane(0, -1.0, 0.2, 0.0, 0.7));
        clip->addClipPlane(new osg::ClipPlane(1, 0.0, 1.0, 0.0, 2.0));
        osg::ref_ptr<osg::Node> grounds = find(*scene.root, "grounds");
        scene.content->replaceChild(grounds, clip);
        clip->addChild(grounds);
    };
    // what is clipped off shows the same background with and without light, so that the mask need not know of it
    EXPECT_TRUE(isExact(place, trial));
}

TEST_P(Ordering, WholeSceneUnderAClipNode) {
    Trial trial;
    trial.change = [](Scene& scene) {
        osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
        clip->addClipPlane(new osg::ClipPlane(0, 1.0, 0.2, 0.0, 3.2));
        const osg::ref_ptr<osg::Group> inner = new osg::Group;
        for (unsigned i = 0; i < scene.content->getNumChildren(); ++i) inner->addChild(scene.content->getChild(i));
        scene.content->removeChildren(0, scene.content->getNumChildren());
        scene.content->addChild(clip);
        clip->addChild(inner);
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}

TEST_P(Ordering, OcclusionQueries) {
    Trial trial;
    trial.change = [](Scene& scene) {
        for (const char* name : {"house", "left"}) {
            osg::ref_ptr<osg::OcclusionQueryNode> query = new osg::OcclusionQueryNode;
            osg::ref_ptr<osg::Node> child = find(*scene.root, name);
            osg::ref_ptr<osg::Group> parent = child->getParent(0);
            query->setQueryFrameCount(1);
            parent->replaceChild(child, query);
            query->addChild(child);
        }
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}
