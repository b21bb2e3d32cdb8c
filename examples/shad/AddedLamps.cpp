// SPDX-License-Identifier: MIT
#include "AddedLamps.h"

#include "Mesh.h"
#include "Paint.h"

#include <added_lamp_shaders.h>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/LightModel>
#include <osg/Program>

#include <cmath>

namespace gnomon::examples {
namespace {

constexpr auto forced = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

osg::ref_ptr<osg::Program> additiveProgram() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, added_lamp::additive_frag));
    return program;
}

} // namespace

AddedLamp::AddedLamp(int number, osg::Node& things, osg::Node& casters) : _map(std::make_unique<DepthPass>(casters)) {
    osg::Light& light = *_source->getLight();
    light.setLightNum(number);
    light.setAmbient(osg::Vec4(0.1f, 0.1f, 0.1f, 1.0f));
    const double half = zNear * std::sin(osg::DegreesToRadians(fieldOfView / 2.0));
    _box->addChild(examples::node(examples::box({-half, -half, 0.01 - zNear}, {half, half, 0.0})));
    _inMap->setTextureUnit(static_cast<unsigned>(number) + 1);
    _inMap->getTexGen()->setMode(osg::TexGen::EYE_LINEAR);
    _pass->addChild(&things);
    setUpPass(number);
    for (osg::Node* child : {static_cast<osg::Node*>(_source), static_cast<osg::Node*>(_inMap),
                             static_cast<osg::Node*>(_pass), static_cast<osg::Node*>(_map->camera())})
        _node->addChild(child);
}

void AddedLamp::setUpPass(int number) {
    const unsigned unit = static_cast<unsigned>(number) + 1; // 0 is the objects' own
    const bool first = number == 0;
    osg::StateSet& set = *_pass->getOrCreateStateSet();
    set.setMode(GL_LIGHT0 + static_cast<GLenum>(number), forced);
    set.setAttributeAndModes(new osg::Depth(first ? osg::Depth::LEQUAL : osg::Depth::EQUAL, 0.0, 1.0, first), forced);
    set.setAttributeAndModes(new osg::BlendFunc(GL_ONE, first ? GL_ZERO : GL_ONE), forced);
    set.setRenderBinDetails(number, "RenderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
    set.setTextureAttribute(unit, _map->texture());
    for (const GLenum mode : {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q})
        set.setTextureMode(unit, mode, osg::StateAttribute::ON);
    set.setAttributeAndModes(additiveProgram(), forced);
    set.addUniform(new osg::Uniform("own", 0));
    set.addUniform(new osg::Uniform("map", static_cast<int>(unit)));
    set.addUniform(new osg::Uniform("unit", static_cast<int>(unit)));
}

void AddedLamp::place(const osg::Matrixd& view) {
    const osg::Matrixd back = osg::Matrixd::inverse(view);
    _source->getLight()->setPosition(osg::Vec4(osg::Vec4d(back.getTrans(), 1.0)));
    _box->setMatrix(back);
    _map->lookFrom(view, osg::Matrixd::perspective(fieldOfView, 1.0, zNear, zFar));
    _inMap->getTexGen()->setPlanesFromMatrix(_map->textureFromScene());
}

void AddedLamp::setColor(const osg::Vec3& color, float share) {
    paintedUnlit(_box, osg::Vec4(color, 1.0f));
    _source->getLight()->setDiffuse(osg::Vec4(color * share, 1.0f));
    _source->getLight()->setSpecular(osg::Vec4(color * share, 1.0f));
}

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
