// SPDX-License-Identifier: MIT
// The same scene far from the origin, and in other units: the same picture.
#include "Trial.h"

#include <osg/CoordinateSystemNode>
#include <osg/Math>
#include <osg/MatrixTransform>

using namespace test;

namespace {

/// About the Earth's radius, on no axis; all three are exact in double.
const osg::Vec3d farAway(5512345.25, -2743210.5, 1734567.75);
const osg::Vec4d sun(1.0, 0.5, 1.0, 0.0), lamp(2.0, 1.0, 4.0, 1.0);

Mesh scaled(Mesh mesh, double factor) {
    for (glm::dvec3& v : mesh) v *= factor;
    return mesh;
}

View slanting(double scale = 1.0) {
    return perspective(osg::Vec3d(-8.0, -9.0, 6.0) * scale, {0.0, 0.0, 0.0}, 400, 300, 40.0, scale, 100.0 * scale);
}

View fromAboveAt(double scale = 1.0) {
    View view;
    view.width = 400;
    view.height = 300;
    view.view.makeLookAt({0.0, 0.0, 50.0 * scale}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    view.projection.makeOrtho(-4.0 * scale, 4.0 * scale, -3.0 * scale, 3.0 * scale, scale, 100.0 * scale);
    return view;
}

Trial trialAt(const osg::Vec4d& light, bool fromTop, double scale = 1.0) {
    Trial trial;
    for (const Mesh& mesh : {sphere({-1.0, 1.0, 0.25}, 1.0, 24), house({1.5, -0.5}, {1.0, 1.5, 2.0}, 30.0),
                             quad({-1.0, -1.5, 1.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.25})})
        trial.casters.push_back(scaled(mesh, scale));
    trial.light = osg::Vec4d(light.x() * (light.w() == 0.0 ? 1.0 : scale), light.y() * (light.w() == 0.0 ? 1.0 : scale),
                             light.z() * (light.w() == 0.0 ? 1.0 : scale), light.w());
    trial.half = 8.0 * scale;
    trial.view = fromTop ? fromAboveAt(scale) : slanting(scale);
    return trial;
}

/// Relit, first and second frame, and blended to black.
std::vector<Picture> pictures(const Scene& scene, osg::Node* root, const View& view) {
    Camera camera(root, view);
    std::vector<Picture> result{camera.frame(), camera.frame()};
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    scene.group->setDark(0.0f);
    result.push_back(camera.frame());
    return result;
}

std::vector<Picture> pictures(const Trial& trial) {
    const Scene scene = trial.buildWithShadow();
    return pictures(scene, scene.root, trial.view);
}

int mostDifferent(const std::vector<Picture>& some, const std::vector<Picture>& others) {
    int most = 0;
    for (std::size_t i = 0; i < some.size(); ++i) most = std::max(most, some[i].different(others[i]));
    return most;
}

const osg::Matrixd toFarAway = osg::Matrixd::translate(farAway);

/// From where one sees the same of a scene that stands at `place`.
View at(const osg::Matrixd& place, View view) {
    view.view.preMult(osg::Matrixd::inverse(place));
    return view;
}

/// Runs `check` for sun and lamp, from above and slanting.
template <class Check>
void forEachLightAndView(const Check& check) {
    for (const osg::Vec4d& light : {sun, lamp})
        for (const bool fromTop : {true, false}) {
            SCOPED_TRACE(testing::Message()
                         << (light.w() == 0.0 ? "sun" : "lamp") << (fromTop ? " from above" : " slanting"));
            check(light, fromTop);
        }
}

GNOMON_BY_TECHNIQUE(Place);
GNOMON_BY_TECHNIQUE(Scale);
GNOMON_BY_TECHNIQUE(Globe);
GNOMON_BY(GlobeInGroup, By::Planar, By::Traced, By::Map, By::Volume); // the others' ground is level in the group

/// Where a scene stands on the Earth, east, north and up being x, y and z of its own: from Tennessee to New Zealand.
std::vector<osg::Matrixd> placesOnEarth() {
    const osg::ref_ptr<osg::EllipsoidModel> earth = new osg::EllipsoidModel;
    std::vector<osg::Matrixd> places;
    for (const auto& [latitude, longitude] : {std::pair(36.39, -84.13), {-43.59, 170.14}, {0.0, 0.0}}) {
        places.emplace_back();
        earth->computeLocalToWorldTransformFromLatLongHeight(osg::DegreesToRadians(latitude),
                                                             osg::DegreesToRadians(longitude), 300.0, places.back());
    }
    return places;
}

} // namespace

TEST_P(Place, OfTheOriginIsWhatRaysSay) { // what all others here are compared with
    forEachLightAndView([](const osg::Vec4d& light, bool fromTop) {
        const Trial trial = trialAt(light, fromTop);
        const Truth truth = truthOf(trial);
        EXPECT_GT(truth.shadowPixels(), 3000);
        Scene scene = trial.buildWithShadow();
        EXPECT_TRUE(isRight(scene, trial.view, truth));
    });
}

TEST_P(Place, FarAwayByATransformAboveTheGroupChangesNoBit) {
    forEachLightAndView([](const osg::Vec4d& light, bool fromTop) {
        const Trial trial = trialAt(light, fromTop);
        const Scene scene = trial.buildWithShadow();
        const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(toFarAway);
        transform->addChild(scene.root);
        EXPECT_EQ(mostDifferent(pictures(scene, transform, at(toFarAway, trial.view)), pictures(trial)), 0);
    });
}

namespace {

/// On the ground where its place is in the group.
void addShadow(Scene& scene, By technique, const osg::Matrixd& place) {
    const osg::Vec3d up = osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, 1.0), place);
    if (technique == By::Planar)
        scene.addShadow(new gnomon::PlanarShadowNode(osg::Vec4d(up, -(up * place.getTrans()))));
    else
        scene.addShadow(castingTechnique(find(*scene.root, "ground")));
}

/// Puts the content, within the group, and the light each under a transform to `place`.
void moveContentAndLight(Scene& scene, const osg::Matrixd& place) {
    const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(place),
                                             ofLight = new osg::MatrixTransform(place);
    scene.group->replaceChild(scene.content, transform);
    transform->addChild(scene.content);
    scene.root->replaceChild(scene.light, ofLight);
    ofLight->addChild(scene.light);
}

} // namespace

TEST_P(Place, FarAwayByATransformInTheGroupChangesNoBit) {
    forEachLightAndView([](const osg::Vec4d& light, bool fromTop) {
        const Trial trial = trialAt(light, fromTop);
        Scene scene = trial.build();
        addShadow(scene, GetParam(), toFarAway);
        moveContentAndLight(scene, toFarAway);
        EXPECT_EQ(mostDifferent(pictures(scene, scene.root, at(toFarAway, trial.view)), pictures(trial)), 0);
    });
}

TEST_P(Place, FarAwayOfALightGivenInDoubleChangesNoBit) {
    forEachLightAndView([](const osg::Vec4d& light, bool fromTop) {
        const Trial trial = trialAt(light, fromTop);
        Scene scene = trial.build();
        addShadow(scene, GetParam(), toFarAway);
        scene.group->addLight({0, light + osg::Vec4d(farAway, 0.0) * light.w()});
        moveContentAndLight(scene, toFarAway);
        EXPECT_EQ(mostDifferent(pictures(scene, scene.root, at(toFarAway, trial.view)), pictures(trial)), 0);
    });
}

namespace {

/// Frames of the scene without shadows where it stands, for normals that are turned are rounded anew.
/// @param mask  by rays at the origin.
Truth truthAt(const Trial& trial, const osg::Matrixd& place, const Mask& mask) {
    const auto picture = [&](Scene scene) {
        const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(place);
        transform->addChild(scene.root);
        return render(transform, at(place, trial.view));
    };
    Scene dark = trial.build();
    dark.takeLightAway();
    return {picture(trial.build()), picture(dark), mask};
}

} // namespace

TEST_P(Globe, UnderATransformAboveTheGroupShowsWhatRaysSay) {
    forEachLightAndView([&](const osg::Vec4d& light, bool fromTop) {
        const Trial trial = trialAt(light, fromTop);
        const Mask mask = truthOf(trial).mask;
        for (const osg::Matrixd& place : placesOnEarth()) {
            Scene scene = trial.buildWithShadow();
            const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(place);
            transform->addChild(scene.root);
            scene.root = transform;
            EXPECT_TRUE(isRight(scene, at(place, trial.view), truthAt(trial, place, mask)));
        }
    });
}

TEST_P(GlobeInGroup, UnderATransformInTheGroupShowsWhatRaysSay) {
    forEachLightAndView([&](const osg::Vec4d& light, bool fromTop) {
        const Trial trial = trialAt(light, fromTop);
        const Mask mask = truthOf(trial).mask;
        for (const osg::Matrixd& place : placesOnEarth()) {
            Scene scene = trial.build();
            addShadow(scene, GetParam(), place);
            moveContentAndLight(scene, place);
            EXPECT_TRUE(isRight(scene, at(place, trial.view), truthAt(trial, place, mask)));
        }
    });
}

TEST_P(Scale, ByAPowerOfTwoChangesNoBit) {
    forEachLightAndView([](const osg::Vec4d& light, bool fromTop) {
        const auto expected = pictures(trialAt(light, fromTop));
        for (const double factor : {1.0 / 1024.0, 1024.0}) {
            SCOPED_TRACE(factor);
            EXPECT_EQ(mostDifferent(pictures(trialAt(light, fromTop, factor)), expected), 0);
        }
    });
}

/// Other factors round the corners anew: a pixel whose centre is within 10⁻⁷ of an edge may change sides, with or
/// without shadows.
TEST_P(Scale, ByAThousandChangesNoMoreThanTwoPixelsOfAHundredThousand) {
    forEachLightAndView([](const osg::Vec4d& light, bool fromTop) {
        const auto expected = pictures(trialAt(light, fromTop));
        for (const double factor : {1e-3, 1e3}) {
            SCOPED_TRACE(factor);
            EXPECT_LE(mostDifferent(pictures(trialAt(light, fromTop, factor)), expected), 400 * 300 / 50000);
        }
    });
}
