// SPDX-License-Identifier: MIT
#include "TownScene.h"
#include "TownSite.h"

#include <gnomon/ProgressLine.h>
#include <gnomon/TerrainGround.h>

#include <osg/Geode>
#include <osg/Material>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr double latitude = 36.6;                               // degrees
constexpr double cameraAzimuth = 240.0, cameraDistance = 960.0; // degrees and m, from the town's middle
constexpr double cameraHeight = 420.0, clearance = 60.0;        // m, above the town's middle and any ground below it
constexpr double mostAway = 800.0 / cameraHeight;               // so many times: a large town is looked over from 800 m
constexpr double townSeenWhole = 900.0;                         // m, its side

osg::ref_ptr<osg::Geode> drawTerrain(osg::HeightField& field) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(&field));
    osg::ref_ptr<osg::Material> grass = new osg::Material;
    grass->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0.50f, 0.58f, 0.38f, 1.0f));
    grass->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.50f, 0.58f, 0.38f, 1.0f));
    geode->getOrCreateStateSet()->setAttributeAndModes(grass);
    geode->setName("terrain");
    return geode;
}

void lookAt(ViewOptions& view, const Ground& ground, const glm::dvec2& middle, double side) {
    const double azimuth = osg::DegreesToRadians(cameraAzimuth), away = std::clamp(side / townSeenWhole, 1.0, mostAway);
    const glm::dvec2 eye = middle + away * cameraDistance * glm::dvec2(std::sin(azimuth), std::cos(azimuth));
    const double low = ground.height(middle.x, middle.y).value_or(0.0);
    const double below = ground.height(eye.x, eye.y).value_or(low);
    view.center = osg::Vec3d(middle.x, middle.y, low);
    view.eye = osg::Vec3d(eye.x, eye.y, std::max(low + away * cameraHeight, below + clearance));
}

void setLooks(ViewOptions& view, double hour) {
    view.receiver = "terrain";
    view.casters = "town";
    view.ground = "none";
    const SunPosition sun = townSun(hour);
    view.lights = {sunAt(sun.azimuth, sun.elevation)};
    view.ambient = 0.35;
    view.diffuse = 0.9;
    view.background = {0.62, 0.74, 0.88};
}

/// Fills in the view, too.
osg::ref_ptr<osg::Group> makeScene(ViewOptions& view, double hour, osg::HeightField& field, const TownPlan& plan) {
    field.setOrigin(osg::Vec3());
    const std::shared_ptr<const Ground> ground = groundOf(field);
    const glm::dvec2 middle = townSite(field, plan.side());
    lookAt(view, *ground, middle, plan.side());
    setLooks(view, hour);
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(drawTerrain(field));
    ProgressLine progress("building the town");
    scene->addChild(makeTown(*ground, middle, plan, [&](double share) { progress.show(share); }));
    return scene;
}

} // namespace

SunPosition townSun(double hour) {
    const SunClock meridian(latitude, 0.0); // where UTC is mean solar time
    return meridian.at(*julianDay("2026-03-20T00:00:00Z") + hour / 24.0);
}

TownScene::TownScene(ViewOptions view, double hour, osg::HeightField& terrain, const TownPlan& plan)
    : _given(hour), _hour(hour), _view(std::move(view)) {
    const osg::ref_ptr<osg::Group> scene = makeScene(_view, hour, terrain, plan);
    _setup = setUpScene(_view, *scene);
}

void TownScene::setHour(double hour) {
    _hour = hour;
    const SunPosition given = townSun(_given), now = townSun(hour);
    _setup.lights->move({now.azimuth - given.azimuth, now.elevation - given.elevation}, *_view.center);
}

} // namespace gnomon::examples
