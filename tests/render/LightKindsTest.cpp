// SPDX-License-Identifier: MIT
// Lights of every kind, wherever they come from: the shadow takes away exactly what they give.
#include "ReceiverCases.h"

#include <osg/LightModel>
#include <osg/Material>
#include <osg/MatrixTransform>

using namespace test;

namespace {

osg::Light& light(TwoReceivers& scene) { return scene.caster(); }

void attenuate(TwoReceivers& scene) {
    light(scene).setConstantAttenuation(0.5f);
    light(scene).setLinearAttenuation(0.02f);
    light(scene).setQuadraticAttenuation(0.01f);
}

void makeSpot(TwoReceivers& scene) {
    const osg::Vec4d& from = scene.lightInWorld;
    osg::Vec3 direction = osg::Vec3d(0.5, -1.0, 0.0) - osg::Vec3d(from.x(), from.y(), from.z());
    direction.normalize();
    light(scene).setDirection(direction);
    light(scene).setSpotCutoff(35.0f);
    light(scene).setSpotExponent(3.0f);
}

void makeShiny(TwoReceivers& scene) {
    auto* material =
        dynamic_cast<osg::Material*>(scene.root->getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
    material->setSpecular(osg::Material::FRONT_AND_BACK, {1.0f, 0.9f, 0.8f, 1.0f});
    material->setShininess(osg::Material::FRONT_AND_BACK, 4.0f);
}

void attenuatedSpotOnShiny(TwoReceivers& scene) {
    makeSpot(scene);
    attenuate(scene);
    makeShiny(scene);
}

void makeOnlySpecular(TwoReceivers& scene) {
    makeShiny(scene);
    light(scene).setDiffuse({0.0f, 0.0f, 0.0f, 1.0f});
    light(scene).setSpecular({0.6f, 0.5f, 0.4f, 1.0f});
}

void makeColoured(TwoReceivers& scene) {
    makeShiny(scene);
    light(scene).setAmbient({0.1f, 0.2f, 0.0f, 0.5f});
    light(scene).setDiffuse({0.5f, 0.3f, 0.1f, 0.5f});
    light(scene).setSpecular({0.1f, 0.2f, 0.3f, 0.5f});
}

/// OpenGL takes a negative light as it comes.
void makeNegative(TwoReceivers& scene) { light(scene).setDiffuse({-0.2f, -0.1f, 0.3f, 1.0f}); }

/// The same place with another w.
void doubleW(TwoReceivers& scene) { light(scene).setPosition(light(scene).getPosition() * 2.0f); }

/// Under a transform, the light's own position such that it comes to stand where it was.
void placeUnder(TwoReceivers& scene, const osg::Matrixd& worldFromLight) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(worldFromLight);
    scene.root->replaceChild(scene.light, transform);
    transform->addChild(scene.light);
    const osg::Vec4 local(scene.lightInWorld * osg::Matrixd::inverse(worldFromLight));
    light(scene).setPosition(local);
    scene.lightInWorld = osg::Vec4d(local) * worldFromLight;
}

void turnAndMove(TwoReceivers& scene) {
    placeUnder(scene, osg::Matrixd::rotate(0.7, osg::Vec3d(1.0, 2.0, 3.0)) * osg::Matrixd::translate(4.0, -3.0, 2.0));
}

void scale(TwoReceivers& scene) {
    placeUnder(scene, osg::Matrixd::scale(2.0, 3.0, 0.5) * osg::Matrixd::rotate(0.3, osg::Vec3d(0.0, 1.0, 0.0)));
}

void mirror(TwoReceivers& scene) {
    placeUnder(scene, osg::Matrixd::scale(-1.0, 1.0, 1.0) * osg::Matrixd::translate(1.0, 2.0, 3.0));
}

/// An absolute LightSource takes its position as one in eye space, whatever transform it is under.
void placeInEyeSpace(TwoReceivers& scene) {
    placeUnder(scene, osg::Matrixd::translate(5.0, 5.0, 5.0));
    const osg::Vec4 inEye(scene.lightInWorld * viewOfTwoReceivers().view);
    scene.light->setReferenceFrame(osg::LightSource::ABSOLUTE_RF);
    light(scene).setPosition(inEye);
    scene.lightInWorld = osg::Vec4d(inEye) * osg::Matrixd::inverse(viewOfTwoReceivers().view);
}

void byHeadlight(TwoReceivers& scene) {
    lightByViewer(scene, osg::View::HEADLIGHT, osg::Vec4(scene.lightInWorld * viewOfTwoReceivers().view));
}

void bySkyLight(TwoReceivers& scene) { lightByViewer(scene, osg::View::SKY_LIGHT, osg::Vec4(scene.lightInWorld)); }

/// The LightSource among the casters, under the group.
void putIntoContent(TwoReceivers& scene) {
    scene.root->removeChild(scene.light);
    scene.content->addChild(scene.light);
}

/// On for what protects it, off for all else.
void findWhereProtected(TwoReceivers& scene) {
    leaveToDiscovery(scene);
    scene.root->getStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    scene.receivers->getOrCreateStateSet()->setMode(GL_LIGHT0,
                                                    osg::StateAttribute::ON | osg::StateAttribute::PROTECTED);
}

class LightKinds : public testing::TestWithParam<ReceiverParam> {};
class LightNumbers : public testing::TestWithParam<ReceiverParam> {};

std::vector<ReceiverCase> numbers(bool discovered) {
    std::vector<ReceiverCase> cases;
    for (int number = 0; number < 8; ++number)
        cases.push_back({(discovered ? "Found" : "Light") + std::to_string(number), [=](TwoReceivers& scene) {
                             renumber(scene, number);
                             if (discovered) leaveToDiscovery(scene);
                         }});
    return cases;
}

} // namespace

TEST_P(LightKinds, AreTakenAwayExactly) { expectExact(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Planar, LightKinds,
    testing::Combine(
        testing::Values(
            ReceiverCase{"Sun"}, ReceiverCase{"Lamp", [](TwoReceivers&) {}, true},
            ReceiverCase{"AttenuatedLamp", attenuate, true}, ReceiverCase{"SpotLight", makeSpot, true},
            ReceiverCase{"AttenuatedSpotOnShiny", attenuatedSpotOnShiny, true},
            ReceiverCase{"LampOfAnotherW", doubleW, true}, ReceiverCase{"OnlySpecular", makeOnlySpecular},
            ReceiverCase{"Coloured", makeColoured}, ReceiverCase{"Negative", makeNegative},
            ReceiverCase{"TurnedAndMovedSun", turnAndMove}, ReceiverCase{"TurnedAndMovedLamp", turnAndMove, true},
            ReceiverCase{"ScaledSun", scale}, ReceiverCase{"ScaledLamp", scale, true},
            ReceiverCase{"MirroredLamp", mirror, true}, ReceiverCase{"SunInEyeSpace", placeInEyeSpace},
            ReceiverCase{"LampInEyeSpace", placeInEyeSpace, true}, ReceiverCase{"FoundSun", leaveToDiscovery},
            ReceiverCase{"FoundWhereProtected", findWhereProtected}, ReceiverCase{"Headlight", byHeadlight},
            ReceiverCase{"LampAtTheHead", byHeadlight, true}, ReceiverCase{"SkyLight", bySkyLight},
            ReceiverCase{"LampInTheSky", bySkyLight, true}, ReceiverCase{"LampUnderTheGroup", putIntoContent, true}),
        testing::Values(0, 1)),
    caseName);

TEST_P(LightNumbers, AreTakenAwayExactly) { expectExact(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Set, LightNumbers, testing::Combine(testing::ValuesIn(numbers(false)), testing::Values(0, 1)),
                         caseName);
INSTANTIATE_TEST_SUITE_P(Found, LightNumbers, testing::Combine(testing::ValuesIn(numbers(true)), testing::Values(0, 1)),
                         caseName);

namespace {

/// About the Earth's radius, on no axis; all three are exact in double.
const osg::Vec3d farAway(5512345.25, -2743210.5, 1734567.75);

void replaceBy(osg::Group& parent, osg::Node* child, osg::Group* between) {
    const osg::ref_ptr<osg::Node> keep = child;
    parent.replaceChild(child, between);
    between->addChild(child);
}

/// Content and lights each under transforms to `place`, the lamp under two.
void moveTo(const osg::Vec3d& place, TwoReceivers& scene) {
    const osg::Matrixd there = osg::Matrixd::translate(place);
    replaceBy(*scene.group, scene.content, new osg::MatrixTransform(there));
    replaceBy(*scene.root, scene.fill, new osg::MatrixTransform(there));
    osg::ref_ptr<osg::MatrixTransform> inner = new osg::MatrixTransform(osg::Matrixd::translate(place / 4.0));
    replaceBy(*scene.root, scene.light, inner);
    replaceBy(*scene.root, inner, new osg::MatrixTransform(osg::Matrixd::translate(place * 0.75)));
}

std::vector<Picture> attenuatedSpotAt(const osg::Vec3d& place, const osg::Vec4d& lamp, Receiving receiving) {
    TwoReceivers scene = twoReceivers(lamp);
    attenuatedSpotOnShiny(scene);
    castOnReceivers(scene, receiving)->setPlanes({osg::Vec4d(0.0, 0.0, 1.0, -place.z())});
    moveTo(place, scene);
    View view = viewOfTwoReceivers();
    view.view.preMultTranslate(-place);
    return threeFrames(scene, view);
}

} // namespace

TEST(FarLights, AttenuatedSpotUnderTwoTransformsAtTheEarthsRadiusGivesThePictureOfTheOrigin) {
    for (const osg::Vec4d& lamp : {osg::Vec4d(3.0, 2.0, 9.0, 1.0), osg::Vec4d(-1.0, 4.0, 8.0, 1.0)})
        for (const Receiving receiving : {Receiving::Named, Receiving::NamedAmongOthers, Receiving::Unnamed}) {
            const auto here = attenuatedSpotAt({0.0, 0.0, 0.0}, lamp, receiving);
            const auto there = attenuatedSpotAt(farAway, lamp, receiving);
            for (std::size_t i = 0; i < here.size(); ++i)
                EXPECT_EQ(here[i].different(there[i]), 0) << nameOf(receiving);
        }
}
