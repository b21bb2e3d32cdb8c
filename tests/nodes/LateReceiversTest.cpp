// SPDX-License-Identifier: MIT
#include <gnomon/compositor/LateReceivers.h>

#include <gtest/gtest.h>
#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <ctime>
#include <vector>

namespace {

constexpr int late = 10;

/// Leaves of drawables that blend by the colours of their vertices, in a late bin, as a cull leaves them.
struct Leaves {
    explicit Leaves(int number) {
        const osg::ref_ptr<osg::StateSet> blending = new osg::StateSet;
        blending->setAttributeAndModes(new osg::BlendFunc);
        osgUtil::StateGraph* graph = root->find_or_insert(blending);
        for (int i = 0; i < number; ++i) {
            const osg::ref_ptr<osg::Geometry> geometry =
                osg::createTexturedQuadGeometry(osg::Vec3(), osg::Vec3(1.0f, 0.0f, 0.0f), osg::Vec3(0.0f, 1.0f, 0.0f));
            const osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray(4);
            for (osg::Vec4ub& color : *colors) color.set(255, 255, 255, 255);
            geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
            kept.push_back(geometry);
            graph->addLeaf(new osgUtil::RenderLeaf(geometry, nullptr, nullptr, 0.0f));
        }
        stage->find_or_insert(late, "RenderBin")->addStateGraph(graph);
    }

    const osg::ref_ptr<osgUtil::StateGraph> root = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    std::vector<osg::ref_ptr<osg::Geometry>> kept;
};

/// Of this thread, so that what else runs does not count.
double processorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

} // namespace

TEST(LateReceivers, FollowTheColorsOfTheirVertices) {
    const Leaves leaves(3);
    EXPECT_EQ(gnomon::lateReceivers(*leaves.stage, late).leaves.size(), 3u);
    auto& colors = static_cast<osg::Vec4ubArray&>(*leaves.kept[1]->getColorArray());
    for (osg::Vec4ub& color : colors) color.a() = 100;
    colors.dirty();
    EXPECT_EQ(gnomon::lateReceivers(*leaves.stage, late).leaves.size(), 2u);
    leaves.kept[2]->setColorArray(new osg::Vec4ubArray(1), osg::Array::BIND_OVERALL); // clear
    const gnomon::LateReceivers found = gnomon::lateReceivers(*leaves.stage, late);
    EXPECT_EQ(found.leaves.size(), 1u);
    EXPECT_EQ(found.clear.size(), 2u);
}

TEST(LateReceivers, AreCutWhereOneAlphaOfSeveralHidesWhatIsBehind) {
    const Leaves leaves(1);
    auto& colors = static_cast<osg::Vec4ubArray&>(*leaves.kept[0]->getColorArray());
    const auto found = [&](unsigned char first, unsigned char others) {
        for (osg::Vec4ub& color : colors) color.a() = others;
        colors.front().a() = first;
        colors.dirty();
        return gnomon::lateReceivers(*leaves.stage, late);
    };
    EXPECT_FALSE(found(255, 255).areCut);
    EXPECT_TRUE(found(0, 255).areCut);
    EXPECT_TRUE(found(0, 128).areCut) << "more than a half";
    EXPECT_EQ(found(0, 128).leaves.size(), 1u);
    EXPECT_EQ(found(0, 127).clear.size(), 1u) << "less";
    EXPECT_EQ(found(200, 200).clear.size(), 1u) << "glass";
}

// With what grows as the square of their number it is hundreds of times as long.
TEST(LateReceivers, OfManyDrawablesAreFoundInAFirstFrameNearlyAsFastAsInOthers) {
    const Leaves leaves(32000);
    const double start = processorSeconds();
    EXPECT_EQ(gnomon::lateReceivers(*leaves.stage, late).leaves.size(), 32000u);
    const double first = processorSeconds();
    EXPECT_EQ(gnomon::lateReceivers(*leaves.stage, late).leaves.size(), 32000u);
    EXPECT_LT(first - start, 50.0 * (processorSeconds() - first));
}
