// SPDX-License-Identifier: MIT
#include "Staging.h"
#include "SceneLights.h"
#include "WhiteCopy.h"

#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>

#include <cmath>

namespace gnomon::examples {
namespace {

osg::Vec4 grey(float level) { return {level, level, level, 1.0f}; }

osg::ref_ptr<osg::Material> white() {
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, grey(1.0f));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, grey(1.0f));
    material->setSpecular(osg::Material::FRONT_AND_BACK, grey(0.0f));
    return material;
}

osg::ref_ptr<osg::StateSet> rootState(Look look) {
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(grey(look == Look::SHADED ? shadedAmbient : 0.0f));
    state->setAttributeAndModes(model);
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    state->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    if (look == Look::VISIBILITY) {
        state->setAttributeAndModes(white());
        state->setMode(GL_NORMALIZE, osg::StateAttribute::ON); // or a scene under a scale is too dark to be judged
    }
    return state;
}

/// The way the light goes; a lamp's is towards `centre`.
osg::Vec3d directionOf(const osg::Vec4d& light, const osg::Vec3d& centre) {
    const osg::Vec3d place(light.x(), light.y(), light.z());
    osg::Vec3d way = light.w() == 0.0 ? -place : centre - place / light.w();
    way.normalize();
    return way;
}

} // namespace

Staging::Staging(const ChartScene& scene, Look look)
    : _root(new osg::Group),
      _content(look == Look::SHADED ? scene.content : whiteCopy(*scene.content)),
      _light(new osg::Light(0)),
      _mount(new osg::MatrixTransform),
      _centre(scene.center),
      _look(look) {
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(_light);
    _mount->addChild(source);
    _root->addChild(_mount);
    _root->setStateSet(rootState(look));
    _light->setAmbient(grey(0.0f));
    setShining(true);
    Staging::setLight(scene.light);
}

osg::Vec4 Staging::background() const { return _look == Look::SHADED ? osg::Vec4(0.2f, 0.2f, 0.4f, 1.0f) : grey(0.0f); }

void Staging::setLight(const osg::Vec4d& light) {
    standLight(*_mount, *_light, light);
    _light->setDirection(osg::Vec3(directionOf(light, _centre)));
}

void Staging::setShining(bool shines) {
    const float level = !shines ? 0.0f : _look == Look::SHADED ? shadedDiffuse : 1.0f;
    _light->setDiffuse(grey(level));
    _light->setSpecular(grey(_look == Look::SHADED ? level : 0.0f));
}

PlainStaging::PlainStaging(const ChartScene& scene, Look look) : Staging(scene, look) { _root->addChild(_content); }

} // namespace gnomon::examples
