// SPDX-License-Identifier: MIT
#include <gnomon/group/SceneFrame.h>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

using gnomon::SceneFrame;

namespace {

gnomon::ViewFrame turnedView() {
    gnomon::ViewFrame view;
    view.eyeFromGroup = osg::Matrixd::lookAt(osg::Vec3d(1e6 + 30.0, -5e5, 80.0), osg::Vec3d(1e6, -5e5 + 20.0, 10.0),
                                             osg::Vec3d(0.0, 0.0, 1.0));
    view.projection = osg::Matrixd::perspective(40.0, 1.5, 1.0, 500.0);
    return view;
}

void expectNear(const glm::dvec4& got, const glm::dvec4& expected, double off) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(got[i], expected[i], off) << i;
}

glm::dvec4 homogeneous(const glm::dvec3& point) { return {point, 1.0}; }

const osg::Vec3d origin(64.0, -32.0, 8.0);

} // namespace

TEST(SceneFrame, TakesPointsFromTheGroup) {
    EXPECT_EQ(SceneFrame(origin).point({65.0, -30.0, 11.0}), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_EQ(SceneFrame(glm::dvec3(1.0, 2.0, 3.0)).point({1.0, 2.0, 3.0}), glm::dvec3(0.0));
}

TEST(SceneFrame, GivesThePlaceThatTheGroupsOwnMatrixGives) {
    const gnomon::ViewFrame view = turnedView();
    const osg::Vec3d about(1e6, -5e5, 0.0), place(1e6 + 3.25, -5e5 + 11.5, 7.75);
    const SceneFrame scene(about);
    const glm::dvec4 inGroup = homogeneous(gnomon::toGlm(place)), inScene = homogeneous(scene.point(place));
    const glm::dmat4 clipFromGroup = gnomon::toGlm(view.eyeFromGroup * view.projection);
    expectNear(scene.clipFromScene(view) * inScene, clipFromGroup * inGroup, 1e-8);
    expectNear(scene.eyeFromScene(view) * inScene, gnomon::toGlm(view.eyeFromGroup) * inGroup, 1e-8);
    const glm::dvec4 there = scene.eyeFromScene(view) * inScene;
    expectNear(gnomon::toGlm(scene.sceneFromEye(view)) * there, inScene, 1e-8);
}

TEST(SceneFrame, KeepsThePlacesInAPlane) {
    const glm::dvec4 plane(0.0, 0.6, 0.8, -5.0);
    const SceneFrame scene(origin);
    EXPECT_EQ(glm::dvec3(scene.plane(plane)), glm::dvec3(plane));
    EXPECT_DOUBLE_EQ(scene.plane(plane).w, -5.0 - 0.6 * 32.0 + 0.8 * 8.0);
    const osg::Vec3d place(3.0, 7.0, -2.0);
    EXPECT_NEAR(gnomon::distance(scene.plane(plane), scene.point(place)), gnomon::distance(plane, gnomon::toGlm(place)),
                1e-13);
}

/// Pictures rest on it to the bit: one product of the two matrices, then the origin.
TEST(SceneFrame, RoundsAsTheProductOfTheTwoMatricesDoes) {
    const gnomon::ViewFrame view = turnedView();
    const osg::Vec3d about(1e6 / 3.0, -5e5 / 7.0, 0.1);
    const glm::dmat4 expected =
        glm::translate(gnomon::toGlm(view.eyeFromGroup * view.projection), gnomon::toGlm(about));
    EXPECT_EQ(SceneFrame(about).clipFromScene(view), expected);
}
