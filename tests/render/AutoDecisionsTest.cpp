// SPDX-License-Identifier: MIT
// What an automatic choice keeps from frame to frame, and what it tells of itself.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/auto/AutoChooser.h>
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/group/LocalLight.h>
#include <gtest/gtest.h>
#include <osg/PolygonOffset>

#include <memory>
#include <set>

using namespace test;

namespace {

const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);
const Mesh cube = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});

View viewFrom(double x) { return perspective({x, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 160, 120); }

/// Chooses as AutoShadowTechnique does, and draws nothing.
class Asked : public gnomon::ShadowTechnique {
public:
    std::vector<osg::ref_ptr<gnomon::MarkJob>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                       const gnomon::FrameCasters& casters) const override {
        const auto usable = gnomon::localLight(light.inGroup, gnomon::SceneFrame(osg::Vec3d()));
        surfaces = _chooser.choose({view, light, casters, casters.drawables(), *usable}, {}, {}).surfaces;
        names.clear();
        for (const osgUtil::RenderLeaf* leaf : *surfaces) names.insert(gnomon::nameOf(*leaf));
        return {};
    }

    mutable std::shared_ptr<const gnomon::LeafSet> surfaces; ///< of the last frame.
    mutable std::multiset<std::string> names;                ///< of these.

private:
    mutable gnomon::AutoChooser _chooser;
};

} // namespace

// Each frame would look at all casters and all receivers for them.
TEST(AutoDecisions, FindTheReceiversOfPlanarOnceWhileNothingMoves) {
    Scene scene = groundScene({cube}, 8.0, sun);
    const osg::ref_ptr<Asked> asked = new Asked;
    scene.addShadow(asked);
    Camera camera(scene.root, viewFrom(-7.0));
    const auto found = [&] {
        camera.frame();
        return asked->surfaces;
    };
    const auto first = found();
    EXPECT_EQ(asked->names, std::multiset<std::string>{"ground"});
    EXPECT_EQ(found(), first);
    EXPECT_EQ(found(), first);
    camera.setView(viewFrom(-6.0));
    const auto moved = found();
    EXPECT_NE(moved, first) << "another view may see other drawables";
    EXPECT_EQ(asked->names, std::multiset<std::string>{"ground"});
    EXPECT_EQ(found(), moved);
    scene.content->addChild(node(test::moved(square(2.0), {-4.0, 4.0, 0.0}), "carpet"));
    EXPECT_NE(found(), moved);
    EXPECT_EQ(asked->names, (std::multiset<std::string>{"carpet", "ground"}));
}

// The box that is drawn late gets no shadow, and its decision would hide the other.
TEST(AutoDecisions, AreToldOfAllKindsOfReceiversAndTheUsualOnesFirst) {
    Scene scene = groundScene({cube}, 8.0, sun);
    const auto add = [&scene](const Mesh& mesh) {
        const osg::ref_ptr<osg::Geode> geode = node(mesh);
        scene.content->addChild(geode);
        return geode->getOrCreateStateSet();
    };
    add(box({-1.0, -5.0, 0.0}, {1.0, -3.5, 1.0}))->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    scene.addShadow(technique);
    Camera camera(scene.root, viewFrom(-7.0));
    camera.frame();
    const auto told = [&technique] {
        std::vector<std::string> all;
        for (const gnomon::ShadowDecision& each : technique->lastDecision())
            all.push_back(each.subject() + ": " + each.chosen.spec);
        return all;
    };
    EXPECT_EQ(told(), (std::vector<std::string>{"light 0: planar", "light 0, receivers drawn late: none"}));
    EXPECT_EQ(technique->lastDecision().back().text().rfind("light 0, receivers drawn late: none, predicted", 0), 0u);
    add(moved(square(0.5), {-2.5, -1.0, 0.001}))
        ->setAttributeAndModes(new osg::PolygonOffset(1.0f, 1.0f), osg::StateAttribute::ON);
    camera.frame();
    ASSERT_EQ(told().size(), 3u);
    EXPECT_EQ(technique->lastDecision()[0].receivers, "");
    EXPECT_EQ(technique->lastDecision()[1].receivers, "with a depth range or polygon offset");
    EXPECT_EQ(technique->lastDecision()[2].receivers, "drawn late");
    scene.content->removeChildren(2, 2); // the box and the carpet
    camera.frame();
    EXPECT_EQ(told(), std::vector<std::string>{"light 0: planar"}) << "the others are of earlier frames";
}

TEST(AutoCandidate, OfMapsAloneAMovingViewChangesWhatWasDrawn) {
    gnomon::AutoCandidate volume, map;
    volume.kind = gnomon::AutoCandidate::Kind::Volume;
    map.kind = gnomon::AutoCandidate::Kind::Map;
    const gnomon::CostRates& rates = gnomon::processorRates;
    for (gnomon::AutoCandidate* each : {&volume, &map}) {
        each->still.calls = 2.0 / rates.call; // 2 ms
        each->change.calls = 10.0 / rates.call;
    }
    const gnomon::ShadowCandidate sides = volume.judged(rates, {0.5, 0.5}), texels = map.judged(rates, {0.5, 0.5});
    EXPECT_NEAR(sides.still, 2.0, 1e-9);
    EXPECT_NEAR(sides.flying, 2.0, 1e-9) << "outlines are the light's and the casters'";
    EXPECT_NEAR(sides.moving, 12.0, 1e-9);
    EXPECT_NEAR(sides.time, 7.0, 1e-9);
    EXPECT_GT(texels.flying, 3.0);
    EXPECT_LT(texels.flying, 4.0) << "one frame in seven, about";
    EXPECT_NEAR(texels.time, (texels.flying + texels.moving) / 2.0, 1e-9);
}
