// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/PlanarShadowNode.h>

#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/Camera>
#include <osg/LOD>
#include <osg/PagedLOD>
#include <osg/Projection>
#include <osg/Sequence>
#include <osg/Switch>

#include <gtest/gtest.h>

using namespace scene;
using Starts = std::vector<double>;

namespace {

/// A group with triangles at 1, 2 and 3.
template <class Group>
osg::ref_ptr<Group> threeTriangles() {
    osg::ref_ptr<Group> group = new Group;
    for (int x = 1; x <= 3; ++x) group->addChild(triangleAt(x));
    return group;
}

osg::ref_ptr<osg::LOD> lodOf(osg::LOD::RangeMode mode, std::initializer_list<std::pair<float, float>> ranges) {
    osg::ref_ptr<osg::LOD> lod = threeTriangles<osg::LOD>();
    lod->setRangeMode(mode);
    lod->setRangeList(ranges);
    return lod;
}

/// As osgText's: a drawable with triangles that turns to the eye; told by its library's name.
class Text : public osg::Drawable {
public:
    const char* libraryName() const override { return _library; }
    void accept(osg::PrimitiveFunctor& functor) const override {
        static_cast<const osg::Drawable&>(*_letters).accept(functor);
    }
    using osg::Drawable::accept;
    bool supports(const osg::PrimitiveFunctor&) const override { return true; }
    const char* _library = "osgText";

private:
    osg::ref_ptr<osg::Geometry> _letters = triangle();
};

Starts startsOfOneUnder(osg::Group* group) {
    group->addChild(geodeOf(triangle().get()));
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(group);
    root->addChild(triangleAt(1));
    return startsOf(*root);
}

} // namespace

TEST(CasterVisitorChoice, ASwitchCastsWithItsChildrenThatAreOn) {
    const osg::ref_ptr<osg::Switch> choice = threeTriangles<osg::Switch>();
    choice->setValue(1, false);
    EXPECT_EQ(startsOf(*choice), (Starts{1, 3}));
}

TEST(CasterVisitorChoice, ASequenceCastsWithItsCurrentFrame) {
    const osg::ref_ptr<osg::Sequence> sequence = threeTriangles<osg::Sequence>();
    sequence->setValue(2);
    EXPECT_EQ(startsOf(*sequence), (Starts{3}));
}

TEST(CasterVisitorChoice, AnLodCastsWithTheChildrenShownNearestOrLargest) {
    constexpr auto distance = osg::LOD::DISTANCE_FROM_EYE_POINT, pixels = osg::LOD::PIXEL_SIZE_ON_SCREEN;
    EXPECT_EQ(startsOf(*lodOf(distance, {{100, 1e6f}, {10, 100}, {0, 10}})), (Starts{3}));
    EXPECT_EQ(startsOf(*lodOf(distance, {{5, 10}, {10, 100}, {100, 1e6f}})), (Starts{1})) << "shown from 5 on only";
    EXPECT_EQ(startsOf(*lodOf(pixels, {{0, 20}, {20, 200}, {200, 1e6f}})), (Starts{3}));
    EXPECT_EQ(startsOf(*lodOf(pixels, {{200, 1e6f}, {20, 200}, {0, 20}})), (Starts{1}));
    EXPECT_EQ(startsOf(*lodOf(distance, {{0, 1000}, {0, 10}, {10, 1000}})), (Starts{1, 2})) << "shown together";
    EXPECT_EQ(startsOf(*lodOf(distance, {{0, 0}, {5, 10}})), (Starts{2})) << "an empty range, and none";
    EXPECT_EQ(startsOf(*lodOf(distance, {})), (Starts{}));
}

TEST(CasterVisitorChoice, APagedLodCastsWithTheFinestThatIsLoaded) {
    osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    paged->addChild(triangleAt(1), 100, 1e6f);
    paged->setRange(1, 10, 100);
    paged->setFileName(1, "finer");
    EXPECT_EQ(startsOf(*paged), (Starts{1}));
    paged->addChild(triangleAt(2), 10, 100);
    EXPECT_EQ(startsOf(*paged), (Starts{2}));
}

TEST(CasterVisitorChoice, AMaskOfZeroNeverCasts) {
    const osg::ref_ptr<osg::Group> group = threeTriangles<osg::Group>();
    group->getChild(0)->setNodeMask(0);
    EXPECT_EQ(startsOf(*group), (Starts{2, 3}));
}

TEST(CasterVisitorSelection, AMaskMustLetThroughTheWholeWayDown) {
    const osg::ref_ptr<osg::Group> group = threeTriangles<osg::Group>();
    group->getChild(0)->setNodeMask(0x1);
    group->getChild(1)->setNodeMask(0x6);
    gnomon::Selection selection;
    selection.mask = 0x2;
    EXPECT_EQ(startsOf(*group, selection), (Starts{2, 3}));
    group->getChild(2)->asGroup()->getChild(0)->setNodeMask(0x1);
    EXPECT_EQ(startsOf(*group, selection), (Starts{2}));
    selection.mask = 0;
    EXPECT_EQ(startsOf(*group, selection), (Starts{}));
}

TEST(CasterVisitorSelection, ANodeCastsInTheRootsFrameInEachOfItsPlaces) {
    const osg::ref_ptr<osg::Group> group = threeTriangles<osg::Group>();
    osg::Node* geode = group->getChild(1)->asGroup()->getChild(0);
    EXPECT_EQ(startsOf(*group, {group->getChild(1)}), (Starts{2}));
    EXPECT_EQ(startsOf(*group, {geode}), (Starts{2}));
    EXPECT_EQ(startsOf(*group, {geode->asGeode()->getDrawable(0)}), (Starts{2}));
    EXPECT_EQ(startsOf(*group, {group}), (Starts{1, 2, 3})) << "the root";
    EXPECT_EQ(startsOf(*group, {new osg::Group}), (Starts{})) << "one that is not there";
    osg::ref_ptr<osg::MatrixTransform> again = new osg::MatrixTransform(osg::Matrix::translate(10, 0, 0));
    again->addChild(group->getChild(0));
    group->addChild(again);
    EXPECT_EQ(startsOf(*group, {group->getChild(0)}), (Starts{1, 11}));
}

TEST(CasterVisitorSelection, ASelectedLodCasts) {
    const osg::ref_ptr<osg::LOD> lod = lodOf(osg::LOD::DISTANCE_FROM_EYE_POINT, {{0, 10}, {10, 100}, {100, 1e6f}});
    osg::ref_ptr<osg::Group> root = threeTriangles<osg::Group>();
    root->addChild(lod);
    root->addChild(triangleAt(4));
    EXPECT_EQ(startsOf(*root, {lod}), (Starts{1}));
}

TEST(CasterVisitorLeavesOut, WhatHasAnotherFrameOrTurnsOrScalesWithTheViewAndTechniques) {
    for (auto frame : {osg::Transform::ABSOLUTE_RF, osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT}) {
        osg::ref_ptr<osg::MatrixTransform> absolute = new osg::MatrixTransform;
        absolute->setReferenceFrame(frame);
        EXPECT_EQ(startsOfOneUnder(absolute.get()), (Starts{1}));
    }
    osg::ref_ptr<osg::AutoTransform> fixed = new osg::AutoTransform, turning = new osg::AutoTransform,
                                     scaling = new osg::AutoTransform;
    fixed->setPosition({5, 0, 0});
    turning->setAutoRotateMode(osg::AutoTransform::ROTATE_TO_CAMERA);
    scaling->setAutoScaleToScreen(true);
    EXPECT_EQ(startsOfOneUnder(fixed.get()), (Starts{5, 1}));
    for (osg::Group* other : std::initializer_list<osg::Group*>{turning, scaling, new osg::Billboard, new osg::Camera,
                                                                new osg::Projection, new gnomon::PlanarShadowNode})
        EXPECT_EQ(startsOfOneUnder(other), (Starts{1})) << other->className();
}

TEST(CasterVisitorLeavesOut, Text) {
    osg::ref_ptr<::Text> text = new ::Text;
    EXPECT_TRUE(trianglesOf(*text).empty());
    text->_library = "osgOther";
    EXPECT_EQ(trianglesOf(*text).size(), 1u) << "any other drawable with triangles casts";
}
