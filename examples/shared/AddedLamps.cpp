// SPDX-License-Identifier: MIT
#include "AddedLamps.h"
#include "Paint.h"

#include <osg/LightModel>

namespace gnomon::examples {

AddedLamps::AddedLamps(osg::Node& things, int count) {
    osg::ref_ptr<osg::Group> casters = new osg::Group;
    casters->addChild(&things);
    casters->addChild(_boxes);
    for (int i = 0; i < count; ++i) {
        AddedLamp& lamp = _lamps.emplace_back(i, things, *casters);
        _boxes->addChild(lamp.box());
        _node->addChild(lamp.node());
    }
    osg::StateSet& set = *_node->getOrCreateStateSet();
    osg::ref_ptr<osg::LightModel> dark = new osg::LightModel;
    dark->setAmbientIntensity(osg::Vec4(0, 0, 0, 1));
    set.setAttributeAndModes(dark);
    set.setMode(GL_LIGHTING, osg::StateAttribute::ON);
    set.setMode(GL_NORMALIZE, osg::StateAttribute::ON);
    set.setTextureAttributeAndModes(0, drawnTexture(1, [](int, int) { return osg::Vec3(1, 1, 1); }));
    set.addUniform(_bias);
    set.addUniform(_bicubic);
    setUpView(*casters);
    _node->addChild(_boxes);
}

void AddedLamps::setUpView(osg::Node& casters) {
    _view->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
    _view->setRenderOrder(osg::Camera::POST_RENDER);
    _view->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    _view->setAllowEventFocus(false);
    _view->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setReferenceFrame(osg::LightSource::ABSOLUTE_RF); // where it is seen from
    osg::Light& light = *source->getLight();
    light.setPosition(osg::Vec4(0, 0, 0, 1));
    light.setAmbient(osg::Vec4(0.1f, 0.1f, 0.1f, 1.0f));
    light.setDiffuse(osg::Vec4(0.6f, 0.6f, 0.6f, 1.0f));
    light.setSpecular(osg::Vec4(0.5f, 0.5f, 0.5f, 1.0f));
    _view->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    _view->addChild(source);
    _view->addChild(&casters);
    _node->addChild(_view);
    showView(false);
}

void AddedLamps::shineOn(ShadowCasterGroup& group) {
    for (AddedLamp& lamp : _lamps) {
        const auto number = static_cast<GLenum>(lamp.source()->getLight()->getLightNum());
        group.addLight(lamp.source());
        group.getOrCreateStateSet()->setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
    }
}

void AddedLamps::setMaps(bool fastCopy, bool displaced) {
    for (AddedLamp& lamp : _lamps) {
        lamp.map().setFastCopy(fastCopy);
        lamp.map().setDisplaced(displaced);
    }
}

std::string AddedLamps::mapsDrawn() const {
    std::string text = "maps drawn:";
    for (const AddedLamp& lamp : _lamps) text += " " + std::to_string(lamp.map().drawn());
    return text;
}

void AddedLamps::showPasses(bool on) {
    for (AddedLamp& lamp : _lamps) lamp.showPass(on);
}

void AddedLamps::lookFrom(const osg::Matrixd& view, double aspect) {
    _view->setViewMatrix(view);
    _view->setProjectionMatrixAsPerspective(AddedLamp::fieldOfView, aspect, AddedLamp::zNear, AddedLamp::zFar);
}

} // namespace gnomon::examples
