// SPDX-License-Identifier: MIT
// Several groups and lights in one view, and techniques under nodes that choose among their children.
#include "TwoGrounds.h"

#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Switch>

#include <array>

using namespace test;

namespace {

using gnomon::ShadowCasterGroup;

const std::array<osg::Vec4d, 3> suns = {osg::Vec4d(1.0, 0.3, 1.2, 0.0), osg::Vec4d(-1.0, 0.5, 1.0, 0.0),
                                        osg::Vec4d(0.3, -1.0, 1.2, 0.0)};
const Mesh ground = square(5.0), farHouse = house({1.6, 1.2}, {1.6, 1.2, 1.4}, 20.0),
           nearHouse = house({-1.2, -1.0}, {1.2, 1.2, 1.0}, 50.0), ball = sphere({0.5, -0.4, 1.2}, 0.5, 16);
const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 240, 180, 30.0);

/// One ground, three lights.
/// @param dark  bit i: light i without its diffuse.
Scene lit(unsigned dark) {
    Scene scene = test::scene(suns[0]);
    for (unsigned i = 0; i < suns.size(); ++i) {
        osg::ref_ptr<osg::LightSource> source = i ? new osg::LightSource : scene.light.get();
        osg::Light& light = *source->getLight();
        const float share = dark & (1u << i) ? 0.0f : 0.25f;
        light.setLightNum(static_cast<int>(i));
        light.setPosition(osg::Vec4(suns[i]));
        light.setAmbient({0.05f, 0.02f, 0.0f, 1.0f});
        light.setDiffuse({share, i == 1 ? share : share / 3.0f, share / 2.0f, 1.0f});
        light.setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0 + i, osg::StateAttribute::ON);
        if (i) scene.root->addChild(source);
    }
    scene.content->addChild(node(ground, "ground"));
    return scene;
}

osg::ref_ptr<ShadowCasterGroup> groupOf(const std::vector<Mesh>& casters, osg::Node* receiver) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    for (const Mesh& caster : casters) group->addChild(node(caster));
    group->addChild(planar(receiver));
    return group;
}

/// What casts in each light.
struct Casting {
    std::array<std::vector<Mesh>, 3> casters;
};

/// Every pixel away from edges is that of one of the eight renders without Gnomon.
::testing::AssertionResult isOneOfEight(Scene& scene, const std::vector<Mesh>& solids, const Casting& casting) {
    std::vector<Picture> renders;
    for (unsigned dark = 0; dark < 8; ++dark) {
        Scene plain = lit(dark);
        for (const Mesh& solid : solids) plain.content->addChild(node(solid));
        renders.push_back(render(plain.root, view));
    }
    const Mask seen = castRays(ground, solids, suns[0], view); // what one sees, edges included
    std::vector<Mask> masks;
    for (unsigned i = 0; i < 3; ++i) masks.push_back(castRays(ground, casting.casters[i], suns[i], view));
    Camera camera(scene.root, view);
    const Frames actual = frames(camera);
    int wrong = 0, shadowed = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            unsigned dark = 0;
            bool edge = seen.atEdge(x, y);
            for (unsigned i = 0; i < 3; ++i) {
                edge = edge || masks[i].atEdge(x, y);
                if (seen.at(x, y) != Seen::Caster && masks[i].at(x, y) == Seen::ShadowedReceiver) dark |= 1u << i;
            }
            if (edge) continue;
            shadowed += dark != 0;
            wrong += actual.first.at(x, y) != renders[dark].at(x, y) || actual.third.at(x, y) != renders[dark].at(x, y);
        }
    if (shadowed < 300) return ::testing::AssertionFailure() << "no shadow to judge";
    if (wrong) return ::testing::AssertionFailure() << wrong << " pixels are wrong, " << shadowed << " in shadow";
    return ::testing::AssertionSuccess();
}

class Groups : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Planar, Groups, testing::Bool(),
                         [](const auto& named) { return named.param ? "NamedReceiver" : "Unnamed"; });

osg::Node* receiver(Scene& scene, bool named) { return named ? find(*scene.root, "ground") : nullptr; }

} // namespace

TEST_P(Groups, TwoUnderThreeLightsUniteTheirShadowsLightByLight) {
    Scene scene = lit(0);
    scene.root->addChild(groupOf({farHouse}, receiver(scene, GetParam())));
    scene.root->addChild(groupOf({nearHouse, ball}, receiver(scene, GetParam())));
    const std::vector<Mesh> all = {farHouse, nearHouse, ball};
    EXPECT_TRUE(isOneOfEight(scene, all, {{all, all, all}}));
}

TEST_P(Groups, EachWithLightsOfItsOwn) {
    Scene scene = lit(0);
    const auto first = groupOf({farHouse}, receiver(scene, GetParam())), second = groupOf({nearHouse, ball}, nullptr);
    first->addLight({0, suns[0]});
    first->addLight({2, suns[2]});
    second->addLight({1, suns[1]});
    second->addLight({2, suns[2]});
    scene.root->addChild(first);
    scene.root->addChild(second);
    EXPECT_TRUE(isOneOfEight(scene, {farHouse, nearHouse, ball},
                             {{{{farHouse}, {nearHouse, ball}, {farHouse, nearHouse, ball}}}}));
}

// The outer group's technique casts for all below it, the inner one's for its own group alone; a sibling of the inner group
// belongs to the outer one.
TEST_P(Groups, NestedOneCastsForItself) {
    Scene scene = lit(0);
    const auto inner = groupOf({nearHouse}, receiver(scene, GetParam())), outer = groupOf({farHouse}, nullptr);
    inner->addLight({0, suns[0]});
    outer->addLight({1, suns[1]});
    osg::ref_ptr<osg::Group> between = new osg::Group;
    between->addChild(node(ball));
    between->addChild(inner);
    outer->addChild(between);
    scene.root->addChild(outer);
    const std::vector<Mesh> all = {farHouse, nearHouse, ball};
    EXPECT_TRUE(isOneOfEight(scene, all, {{{{nearHouse}, all, {}}}}));
}

TEST_P(Groups, SharingOneTechniqueEachCastTheirOwn) {
    Scene scene = lit(0);
    const auto first = groupOf({farHouse}, receiver(scene, GetParam()));
    osg::ref_ptr<ShadowCasterGroup> second = new ShadowCasterGroup;
    second->addChild(node(nearHouse));
    second->addChild(first->getChild(1));
    first->addLight({0, suns[0]});
    second->addLight({1, suns[1]});
    scene.root->addChild(first);
    scene.root->addChild(second);
    EXPECT_TRUE(isOneOfEight(scene, {farHouse, nearHouse}, {{{{farHouse}, {nearHouse}, {}}}}));
}

TEST_P(Groups, TechniqueUnderASwitchAndAnLODCastsWhereTheyLetItThrough) {
    Scene scene = lit(0);
    const auto group = groupOf({farHouse}, receiver(scene, GetParam()));
    const osg::ref_ptr<osg::Node> technique = group->getChild(1);
    group->removeChild(technique);
    osg::ref_ptr<osg::Switch> chosen = new osg::Switch;
    osg::ref_ptr<osg::LOD> near = new osg::LOD, far = new osg::LOD;
    near->addChild(technique, 0.0f, 100.0f);
    far->addChild(technique, 100.0f, 1e6f);
    chosen->addChild(near, true);
    chosen->addChild(far, true);
    chosen->addChild(technique, false);
    group->addChild(chosen);
    scene.root->addChild(group);
    const std::vector<Mesh> casters = {farHouse};
    EXPECT_TRUE(isOneOfEight(scene, casters, {{casters, casters, casters}}));
    chosen->setSingleChildOn(2);
    EXPECT_TRUE(isOneOfEight(scene, casters, {{casters, casters, casters}}));
    chosen->setAllChildrenOn(); // twice in one frame is as once
    EXPECT_TRUE(isOneOfEight(scene, casters, {{casters, casters, casters}}));
    chosen->setSingleChildOn(1); // the view is nearer
    EXPECT_FALSE(isOneOfEight(scene, casters, {{casters, casters, casters}}));
}
