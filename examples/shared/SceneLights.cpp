// SPDX-License-Identifier: MIT
#include "SceneLights.h"

#include <osg/LightModel>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr double sunAzimuth = 135.0, sunElevation = 45.0;  // degrees
constexpr double fillElevation = 30.0, leastApart = 105.0; // degrees; apart from the first light, seen from above
constexpr int mostLights = 8;                              // OpenGL's

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

osg::Vec4 rgba(const osg::Vec3d& colour) { return osg::Vec4(osg::Vec3(colour), 1.0f); }
osg::Vec3d grey(double level) { return {level, level, level}; }

double azimuthOf(const osg::Vec3d& way) { return osg::RadiansToDegrees(std::atan2(way.x(), way.y())); }

/// What of a light's diffuse part a level ground gets, there or in the distance.
double shareOf(const osg::Vec4d& place, const std::optional<osg::Vec3d>& at) {
    if (isLamp(place) && !at) return 0.0;
    const osg::Vec3d way = wayTo(place, at.value_or(osg::Vec3d()));
    return std::max(0.0, way.z() / way.length()); // 0 of a lamp right there
}

osg::Vec3d rgb(const osg::Vec4& colour) { return {colour.r(), colour.g(), colour.b()}; }

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

SceneLights::SceneLights(const ViewOptions& options, osg::Group& root, ShadowCasterGroup& group,
                         const osg::Vec3d& centre)
    : _group(&group),
      _scene(lightSourcesIn(group)),
      _viewAzimuth(options.eye ? azimuthOf(*options.eye - options.center.value_or(centre)) : framingAzimuth) {
    for (const osg::Vec4d& place : options.lights) add(place, root);
    if (count() == 0 && !options.keepLights) add(sunAt(sunAzimuth, sunElevation), root);
    if (!_own.empty() || !options.keepLights) root.getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    for (const Own& own : _own) own.source->setStateSetModes(*root.getOrCreateStateSet(), osg::StateAttribute::ON);
    colour(options, root);
    standFill(centre);
    tellGroup();
}

osg::Vec3d SceneLights::groundColour(const std::optional<osg::Vec3d>& at) const {
    osg::Vec3d sum = _ambient;
    const auto addLight = [&](const osg::Light& light, const osg::Vec4d& place) {
        sum += rgb(light.getAmbient()) + rgb(light.getDiffuse()) * shareOf(place, at);
    };
    const std::vector<osg::Vec4d> where = places();
    for (std::size_t i = 0; i < where.size(); ++i)
        addLight(*(i < _own.size() ? _own[i].source : _scene[i - _own.size()])->getLight(), where[i]);
    if (_fill) addLight(*_fill->getLight(), _fill->getLight()->getPosition());
    for (int i = 0; i < 3; ++i) sum[i] = std::min(sum[i], 1.0);
    return sum;
}

void SceneLights::shineOn(osg::Node& node) const {
    for (const osg::ref_ptr<osg::LightSource>& source : _scene)
        source->setStateSetModes(*node.getOrCreateStateSet(), osg::StateAttribute::ON);
}

std::optional<SceneLights::Direction> SceneLights::given(const osg::Vec3d& seenFrom) const {
    if (_own.empty()) return std::nullopt;
    const osg::Vec3d way = wayTo(_own.front().given, seenFrom);
    return Direction{azimuthOf(way), osg::RadiansToDegrees(std::atan2(way.z(), std::hypot(way.x(), way.y())))};
}

void SceneLights::move(const Direction& by, const osg::Vec3d& centre) {
    for (Own& own : _own) {
        own.place = moved(own.given, by, centre);
        standLight(*own.mount, *own.source->getLight(), own.place);
    }
    standFill(centre);
    tellGroup();
}

void SceneLights::turn(double degrees) { move({-degrees, 0.0}, osg::Vec3d()); }

void SceneLights::add(const osg::Vec4d& place, osg::Group& root) {
    Own own{place, place, new osg::MatrixTransform, new osg::LightSource};
    own.source->setLight(new osg::Light(static_cast<unsigned>(freeNumber())));
    own.mount->addChild(own.source);
    standLight(*own.mount, *own.source->getLight(), place);
    root.insertChild(0, own.mount); // before files that hold osgShadow's nodes, which take the lights met before them
    _own.push_back(own);
}

void SceneLights::addFill(const osg::Vec3d& diffuse, osg::Group& root) {
    _fill = new osg::LightSource;
    osg::Light& light = *new osg::Light(static_cast<unsigned>(freeNumber()));
    _fill->setLight(&light);
    light.setAmbient(rgba(osg::Vec3d()));
    light.setDiffuse(rgba(diffuse));
    light.setSpecular(rgba(osg::Vec3d()));
    _fill->setStateSetModes(*root.getOrCreateStateSet(), osg::StateAttribute::ON);
    root.insertChild(0, _fill);
}

void SceneLights::standFill(const osg::Vec3d& centre) {
    if (!_fill) return;
    const double first = azimuthOf(wayTo(places().front(), centre));
    const double apart = std::remainder(_viewAzimuth - first, 360.0);
    const double azimuth = first + std::copysign(std::max(std::abs(apart), leastApart), apart);
    _fill->getLight()->setPosition(osg::Vec4(sunAt(azimuth, fillElevation)));
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
    if (number >= mostLights)
        throw std::invalid_argument(
            "there are more than 8 lights, counting those of the scene. Allowed: 8, as OpenGL has.");
    return number;
}

void SceneLights::colour(const ViewOptions& options, osg::Group& root) {
    std::optional<osg::Vec3d> ambient = options.ambient, diffuse = options.diffuse, fill = options.fill;
    if (options.lighting && _scene.empty()) {
        if (!ambient) ambient = grey(options.lighting->ambient);
        if (!diffuse) diffuse = grey(options.lighting->diffuse / double(_own.size()));
        if (!fill && count() < mostLights) fill = grey(options.lighting->fill);
    }
    if (fill && fill->length2() > 0.0 && count() > 0) addFill(*fill, root);
    if (ambient) {
        osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
        model->setAmbientIntensity(rgba(*ambient));
        root.getOrCreateStateSet()->setAttributeAndModes(model);
        _ambient = *ambient;
    }
    std::vector<osg::ref_ptr<osg::LightSource>> all = _scene;
    for (const Own& own : _own) all.push_back(own.source);
    for (const osg::ref_ptr<osg::LightSource>& source : all) {
        osg::Light& light = *source->getLight();
        if (ambient) light.setAmbient(rgba(osg::Vec3d()));
        if (diffuse) light.setDiffuse(rgba(*diffuse));
    }
}

void SceneLights::tellGroup() {
    _group->removeLights();
    for (const osg::ref_ptr<osg::LightSource>& source : _scene) _group->addLight(source.get());
    for (const Own& own : _own) _group->addLight(ShadowLight{own.source->getLight()->getLightNum(), own.place});
}

} // namespace gnomon::examples
