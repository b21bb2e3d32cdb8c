// SPDX-License-Identifier: MIT
#include "AddedLamp.h"
#include "Mesh.h"
#include "Paint.h"

#include <added_lamp_shaders.h>

#include <osg/BlendFunc>
#include <osg/Depth>
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

} // namespace gnomon::examples
