// SPDX-License-Identifier: MIT
#include "SceneLights.h"

#include <osg/LightModel>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr double sunAzimuth = 135.0, sunElevation = 45.0; // degrees

bool isLamp(const osg::Vec4d& place) { return std::abs(place.w()) > 1e-9; }

osg::Vec3d point(const osg::Vec4d& place) { return osg::Vec3d(place.x(), place.y(), place.z()) / place.w(); }

/// From `seenFrom` to the light, times w where that is not 0.
osg::Vec3d wayTo(const osg::Vec4d& place, const osg::Vec3d& seenFrom) {
    const osg::Vec3d way = osg::Vec3d(place.x(), place.y(), place.z()) - seenFrom * place.w();
    return place.w() < 0.0 ? -way : way;
}

/// To the bit as it was given where it is not moved.
osg::Vec4d moved(const osg::Vec4d& given, const SceneLights::Direction& by, const osg::Vec3d& centre) {
    if (by.azimuth == 0.0 && by.elevation == 0.0) return given;
    const osg::Vec3d up(0, 0, 1), way = wayTo(given, centre), across = way ^ up;
    const osg::Vec3d axis = across.length2() > 0.0 ? across : osg::Vec3d(1, 0, 0);
    const osg::Vec3d now = way * osg::Matrixd::rotate(osg::DegreesToRadians(by.elevation), axis) *
                           osg::Matrixd::rotate(-osg::DegreesToRadians(by.azimuth), up);
    const double w = std::abs(given.w());
    return {now + centre * w, w};
}

osg::Vec4 grey(double level) {
    const float l = static_cast<float>(level);
    return {l, l, l, 1.0f};
}

} // namespace

std::vector<osg::Vec4d> SceneLights::places() const {
    std::vector<osg::Vec4d> result;
    for (const Own& own : _own) result.push_back(own.place);
    for (const osg::ref_ptr<osg::LightSource>& source : _scene) {
        const osg::Vec4d local(source->getLight()->getPosition());
        const osg::MatrixList ways = source->getWorldMatrices();
        result.push_back(ways.empty() ? local : local * ways.front());
    }
    return result;
}

void standLight(osg::MatrixTransform& mount, osg::Light& light, const osg::Vec4d& place) {
    mount.setMatrix(isLamp(place) ? osg::Matrixd::translate(point(place)) : osg::Matrixd());
    light.setPosition(isLamp(place) ? osg::Vec4(0, 0, 0, 1) : osg::Vec4(place));
}

SceneLights::SceneLights(const ViewOptions& options, osg::Group& root, ShadowCasterGroup& group)
    : _group(&group), _scene(lightSourcesIn(group)) {
    for (const osg::Vec4d& place : options.lights) add(place, root);
    if (count() == 0 && !options.keepLights) add(sunAt(sunAzimuth, sunElevation), root);
    if (!_own.empty() || !options.keepLights) root.getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    for (const Own& own : _own) own.source->setStateSetModes(*root.getOrCreateStateSet(), osg::StateAttribute::ON);
    colour(options);
    if (options.ambient) {
        osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
        model->setAmbientIntensity(grey(*options.ambient));
        root.getOrCreateStateSet()->setAttributeAndModes(model);
    }
    tellGroup();
}

void SceneLights::shineOn(osg::Node& node) const {
    for (const osg::ref_ptr<osg::LightSource>& source : _scene)
        source->setStateSetModes(*node.getOrCreateStateSet(), osg::StateAttribute::ON);
}

std::optional<SceneLights::Direction> SceneLights::given(const osg::Vec3d& seenFrom) const {
    if (_own.empty()) return std::nullopt;
    const osg::Vec3d way = wayTo(_own.front().given, seenFrom);
    return Direction{osg::RadiansToDegrees(std::atan2(way.x(), way.y())),
                     osg::RadiansToDegrees(std::atan2(way.z(), std::hypot(way.x(), way.y())))};
}

void SceneLights::move(const Direction& by, const osg::Vec3d& centre) {
    for (Own& own : _own) {
        own.place = moved(own.given, by, centre);
        standLight(*own.mount, *own.source->getLight(), own.place);
    }
    tellGroup();
}

void SceneLights::turn(double degrees) { move({-degrees, 0.0}, osg::Vec3d()); }

void SceneLights::add(const osg::Vec4d& place, osg::Group& root) {
    Own own{place, place, new osg::MatrixTransform, new osg::LightSource};
    own.source->setLight(new osg::Light(static_cast<unsigned>(freeNumber())));
    own.mount->addChild(own.source);
    standLight(*own.mount, *own.source->getLight(), place);
    root.addChild(own.mount);
    _own.push_back(own);
}

int SceneLights::freeNumber() const {
    const auto uses = [](const osg::LightSource& source, int number) {
        return source.getLight()->getLightNum() == number;
    };
    int number = 0;
    const auto taken = [&] {
        return std::any_of(_scene.begin(), _scene.end(), [&](const auto& s) { return uses(*s, number); }) ||
               std::any_of(_own.begin(), _own.end(), [&](const Own& own) { return uses(*own.source, number); });
    };
    while (taken()) ++number;
    if (number > 7)
        throw std::invalid_argument(
            "there are more than 8 lights, counting those of the scene. Allowed: 8, as OpenGL has.");
    return number;
}

void SceneLights::colour(const ViewOptions& options) {
    std::vector<osg::ref_ptr<osg::LightSource>> all = _scene;
    for (const Own& own : _own) all.push_back(own.source);
    for (const osg::ref_ptr<osg::LightSource>& source : all) {
        osg::Light& light = *source->getLight();
        if (options.ambient) light.setAmbient(grey(0.0));
        if (options.diffuse) light.setDiffuse(grey(*options.diffuse));
    }
}

void SceneLights::tellGroup() {
    _group->removeLights();
    for (const osg::ref_ptr<osg::LightSource>& source : _scene) _group->addLight(source.get());
    for (const Own& own : _own) _group->addLight(ShadowLight{own.source->getLight()->getLightNum(), own.place});
}

} // namespace gnomon::examples
