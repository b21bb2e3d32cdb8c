// SPDX-License-Identifier: MIT
#include "MapPlays.h"

#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Texture2D>

namespace test::layers {
namespace {

/// All that can cast lies between posts, so that where it moves changes no map's place.
std::vector<Mesh> betweenPosts() {
    std::vector<Mesh> meshes{test::square(12.0), test::house({-2.0, 1.0}, {1.0, 1.5, 1.2}, -20.0),
                             test::sphere({2.5, 2.0, 1.0}, 0.8, 24)};
    for (const double x : {-6.0, 6.0})
        for (const double y : {-6.0, 6.0}) meshes.push_back(test::box({x, y, 0.0}, {x + 0.2, y + 0.2, 4.0}));
    return meshes;
}

/// The same in a sun, where something flat is in the maps at all times.
TracedCase underABoard() {
    TracedCase given = inSun();
    given.meshes.push_back(test::quad({-4.0, 3.0, 3.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}));
    return given;
}

/// A play of the scene in sun, or another, with a box and a ball that move; what else is special is said after.
Play play(const std::string& name, const TracedCase& given = inSun()) { return {name, given, {aBox(), aBall()}}; }

} // namespace

/// By maps that never saw another moment, in a context of its own.
Picture freshPicture(const Play& play, const Moment& moment, const View& from) {
    Stage stage(play);
    stage.set(moment);
    return test::render(stage.scene.root, from);
}

TracedCase inSun() { return {"sun", betweenPosts(), {0.9, 0.4, 1.2, 0.0}, view}; }

TracedCase byLamp() {
    const osg::Vec3d lamp(0.3, 0.2, 2.6);
    std::vector<Mesh> meshes = betweenPosts();
    meshes.push_back(test::box({-11.0, -11.0, 0.0}, {11.0, 11.0, 0.05}));
    for (const osg::Vec3d& way : {osg::Vec3d(0.2, 0, 0), {-0.2, 0, 0}, {0, 0.2, 0}, {0, -0.2, 0}, {0, 0, -0.2}}) {
        const glm::dvec3 middle(lamp.x() + way.x(), lamp.y() + way.y(), lamp.z() + way.z());
        meshes.push_back(test::box(middle - 0.01, middle + 0.01));
    }
    return {"lamp", meshes, osg::Vec4d(lamp, 1.0), view};
}

osg::ref_ptr<osg::Node> aBox() { return test::node(test::box({-0.5, -0.4, 0.3}, {0.5, 0.6, 1.1})); }
osg::ref_ptr<osg::Node> aBall() { return test::node(test::sphere({0.0, 0.0, 0.6}, 0.5, 24)); }
osg::ref_ptr<osg::Node> aBoard() { return test::node(test::quad({-1.0, -0.8, 1.5}, {2.0, 0.0, 0.0}, {0.0, 1.6, 0.0})); }

osg::ref_ptr<osg::Node> aFence() {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned y = 0; y < 8; ++y)
        for (unsigned x = 0; x < 8; ++x) image->setColor({1.0f, 1.0f, 1.0f, (x + y) % 2 ? 1.0f : 0.0f}, x, y);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(which, osg::Texture::NEAREST);
    osg::ref_ptr<osg::Geometry> fence =
        osg::createTexturedQuadGeometry({-1.0f, 0.2f, 0.3f}, {2.0f, 0.3f, 0.0f}, {0.1f, 0.2f, 2.0f});
    fence->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    fence->getStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    return fence;
}

std::vector<Play> plays() {
    const auto soft = [](ShadowMapTechnique& technique) {
        technique.setEdges(ShadowMapTechnique::SOFT);
        technique.setSunAngle(4.0);
    };
    const auto smooth = [](ShadowMapTechnique& technique) { technique.setEdges(ShadowMapTechnique::SMOOTH); };
    const auto twoSuns = [](Scene& scene) {
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        scene.group->setLights({{0, {0.9, 0.4, 1.2, 0.0}}, {1, {-0.6, 0.8, 1.0, 0.0}}});
    };
    const auto blend = [](Scene& scene) { scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND); };
    const auto spot = [](Scene& scene) {
        scene.group->addLight(gnomon::ShadowLight{0, {0.3, 0.2, 2.6, 1.0}, {0.1, -0.5, -1.0}, 55.0});
    };
    Play moversFirst = play("MoversFirst"), blended = play("Blend"), inTwoSuns = play("TwoSuns"),
         smoothBlended = play("SmoothBlend"), softly = play("Soft"), softBlended = play("SoftBlend"),
         fence = play("Fence"), fences = play("TwoFences"), board = play("Board", underABoard()),
         lampFence = play("LampFence", byLamp()), inSpot = play("Spot", byLamp()),
         street = play("Street", test::longStreet(45.0));
    moversFirst.first = true;
    blended.light = smoothBlended.light = softBlended.light = blend;
    inTwoSuns.light = twoSuns;
    smoothBlended.change = smooth;
    softly.change = softBlended.change = soft;
    fence.movers = {aFence(), aBall()};
    fences.movers = {aFence(), aFence()};
    board.movers = {aBoard(), aBox()};
    lampFence.movers = {aFence(), aBox()};
    inSpot.light = spot;
    street.movers = {test::node(test::box({20.0, -2.0, 0.0}, {22.0, 0.0, 2.0})),
                     test::node(test::box({60.0, -2.0, 0.0}, {64.0, 1.0, 7.0}))};
    street.given.view = test::perspective({-10.0, 0.0, 2.5}, {100.0, 0.0, 0.0}, 320, 240, 40.0, 0.2, 3000.0);
    street.change = [](ShadowMapTechnique& technique) { technique.setCascades(3); };
    return {play("Sun"), moversFirst, play("TiltedGround", test::tilted(inSun())),
            blended,     inTwoSuns,   smoothBlended,
            softly,      softBlended, fence,
            fences,      board,       play("Lamp", byLamp()),
            lampFence,   inSpot,      street};
}

void PrintTo(const Play& play, std::ostream* out) { *out << play.name; }

} // namespace test::layers
