// SPDX-License-Identifier: MIT
// What auto takes where an alpha test cuts one of the casters: a map, from the frame in which the test is there.
#include "AutoTrial.h"

#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Texture2D>

#include <algorithm>

using test::Camera;
using test::Picture;

namespace {

constexpr double half = 18.0;  // of the ground's side
constexpr double error = 0.42; // pixels: a map of all needs smooth edges for it
const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);

test::View view() { return test::perspective({-20.0, -28.0, 20.0}, {0.0, 0.0, 0.0}, 320, 240); }

/// A board above the houses, whose shadow falls on them and on theirs. An alpha test cuts a hole of a centimetre into it, which no
/// pixel shows.
struct Board {
    const osg::Vec3 corner{-1.5f, -1.5f, 5.0f}, side{3.0f, 0.0f, 0.0f}, up{0.0f, 3.0f, 0.0f};

    test::Mesh mesh() const {
        test::Mesh result;
        for (const osg::Vec3& vertex :
             {corner, corner + side, corner + side + up, corner, corner + side + up, corner + up})
            result.emplace_back(vertex.x(), vertex.y(), vertex.z());
        return result;
    }
    osg::ref_ptr<osg::Geode> node() const {
        const osg::ref_ptr<osg::Image> white = new osg::Image;
        white->allocateImage(256, 256, 1, GL_RGBA, GL_UNSIGNED_BYTE);
        std::fill_n(white->data(), white->getTotalSizeInBytes(), 255);
        white->setColor({1.0f, 1.0f, 1.0f, 0.0f}, 64u, 64u);
        const osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(corner, side, up);
        osg::StateSet& set = *geometry->getOrCreateStateSet();
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(white);
        for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
            texture->setWrap(wrap, osg::Texture::REPEAT); // else its border of no alpha rounds the corners
        set.setTextureAttributeAndModes(0, texture);
        set.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
        const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->addDrawable(geometry);
        return geode;
    }
};

struct Town : test::AutoTrial {
    Town() : AutoTrial(test::town(6), {error}, half, sun) { scene.content->addChild(board); }
    bool isMap() const { return chosen().rfind("map", 0) == 0; }

    const osg::ref_ptr<osg::Geode> board = Board().node();
};

} // namespace

TEST(AutoCutout, KeepsTheErrorByAMap) {
    std::vector<test::Mesh> casters = test::town(6);
    casters.push_back(Board().mesh());
    const test::GroundTruth truth(casters, half, sun, view());
    Town town;
    const Picture picture = test::render(town.scene.root, view());
    EXPECT_TRUE(town.isMap()) << town.chosen();
    // 1.5: how well errors of maps are predicted
    EXPECT_LE(truth.edgesOffBy(picture), 1.5 * error) << town.chosen();
    EXPECT_EQ(town.technique->diagnose(), std::vector<std::string>());
}

TEST(AutoCutout, TakesTheMapInTheFrameInWhichTheTestIsThere) {
    Town town;
    Camera camera(town.scene.root, view());
    for (int i = 0; i < 5; ++i) camera.frame(); // the first ones are compared anyway
    ASSERT_TRUE(town.isMap()) << town.chosen();
    osg::StateSet& set = *town.board->getDrawable(0)->getStateSet();
    const osg::ref_ptr<osg::StateAttribute> test = set.getAttribute(osg::StateAttribute::ALPHAFUNC);
    set.removeAttribute(osg::StateAttribute::ALPHAFUNC);
    for (int i = 0; i < 70; ++i) camera.frame(); // a map is not wrong: it is compared again once the patience is over
    ASSERT_EQ(town.chosen(), "volume");
    set.setAttributeAndModes(test);
    camera.frame();
    EXPECT_TRUE(town.isMap()) << town.chosen() << " in the frame in which the test is there";
}

TEST(AutoCutout, HasRaysAmongItsCandidatesWhereATextureTellsWhatIsClear) {
    const auto obstacleOf = [](const Town& town, const std::string& spec) {
        const auto candidates = town.technique->lastDecision().front().candidates;
        const auto found = std::find_if(candidates.begin(), candidates.end(),
                                        [&](const auto& each) { return each.spec.rfind(spec, 0) == 0; });
        return found == candidates.end() ? "no such candidate" : found->obstacle;
    };
    for (const bool byVertex : {false, true}) {
        Town town;
        osg::Geometry& board = *town.board->getDrawable(0)->asGeometry();
        const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(4);
        for (unsigned i = 0; i < 4; ++i) (*colors)[i] = osg::Vec4(1.0f, 1.0f, 1.0f, i < 2 ? 1.0f : 0.0f);
        if (byVertex) board.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
        if (byVertex) board.getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        test::render(town.scene.root, view());
        EXPECT_EQ(obstacleOf(town, "traced").empty(), !byVertex);
        EXPECT_EQ(obstacleOf(town, "volume"), "casters have clear parts");
    }
}
