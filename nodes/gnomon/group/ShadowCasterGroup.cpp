// SPDX-License-Identifier: MIT
#include <gnomon/NamesNodes.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/base/CopiedNodes.h>
#include <gnomon/casters/CasterRevisions.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace gnomon {
namespace {

/// Warns otherwise.
bool isLightNumber(int number, const char* method) {
    if (number >= 0 && number < 8) return true;
    OSG_WARN << "gnomon: ShadowCasterGroup::" << method << "(): light " << number
             << " is refused. Give an OpenGL light number from 0 to 7." << std::endl;
    return false;
}

} // namespace

ShadowCasterGroup::ShadowCasterGroup() : _casters(new CasterRevisions) {}

ShadowCasterGroup::ShadowCasterGroup(const ShadowCasterGroup& other, const osg::CopyOp& copyOp)
    : osg::Group(other, copyOp),
      _selection(other._selection),
      _composite(other._composite),
      _dark(other._dark),
      _lightSources(other._lightSources),
      _lights(other._lights),
      _lightUniforms(other._lightUniforms),
      _options(other._options),
      _casters(new CasterRevisions) {
    followCopies(other);
}

ShadowCasterGroup::~ShadowCasterGroup() = default;

void ShadowCasterGroup::followCopies(const ShadowCasterGroup& original) {
    const CopiedNodes copied(original, *this);
    setCasters({copied.of(_selection.node.get()), _selection.mask});
    for (osg::ref_ptr<osg::LightSource>& source : _lightSources)
        if (auto* own = dynamic_cast<osg::LightSource*>(copied.of(source.get()))) source = own;
    copied.forEachCopy([&copied](osg::Node& node) {
        if (auto* names = dynamic_cast<NamesNodes*>(&node)) names->followCopies(copied);
    });
}

bool ShadowCasterGroup::showsAllChildren() const { return typeid(*this) == typeid(ShadowCasterGroup); }

void ShadowCasterGroup::setCasters(const Selection& casters) {
    _selection = casters;
    _casters->clear();
}

void ShadowCasterGroup::setDark(float factor) {
    if (std::isnan(factor)) {
        OSG_WARN
            << "gnomon: ShadowCasterGroup::setDark(): NaN is refused. Give a factor from 0 (black) to 1 (no shadow)."
            << std::endl;
        return;
    }
    _dark = std::clamp(factor, 0.0f, 1.0f);
}

void ShadowCasterGroup::addLight(osg::LightSource* light) {
    if (light) _lightSources.push_back(light);
}

void ShadowCasterGroup::addLight(const ShadowLight& light) {
    if (isLightNumber(light.number, "addLight")) _lights.push_back(light);
}

void ShadowCasterGroup::setLights(std::vector<ShadowLight> lights) { // by value: it may be the group's own
    _lights.clear();
    for (const ShadowLight& light : lights) addLight(light);
}

void ShadowCasterGroup::setLightSources(std::vector<osg::ref_ptr<osg::LightSource>> sources) {
    _lightSources.clear();
    for (const osg::ref_ptr<osg::LightSource>& source : sources) addLight(source);
}

void ShadowCasterGroup::addLightUniform(const LightUniform& uniform) {
    if (isLightNumber(uniform.number, "addLightUniform")) _lightUniforms.push_back(uniform);
}

void ShadowCasterGroup::setLightUniforms(std::vector<LightUniform> uniforms) {
    _lightUniforms.clear();
    for (const LightUniform& uniform : uniforms) addLightUniform(uniform);
}

void ShadowCasterGroup::removeLights() {
    _lightSources.clear();
    _lights.clear();
}

osg::ref_ptr<const CasterMesh> ShadowCasterGroup::casters(const CasterView* view) const {
    auto* self = const_cast<ShadowCasterGroup*>(this); // a visitor asks for a mutable node, and changes nothing
    return _casters->mesh(*self, _selection, view);
}

osg::ref_ptr<const CasterDrawables> ShadowCasterGroup::drawables(const CasterView* view) const {
    auto* self = const_cast<ShadowCasterGroup*>(this); // as above
    return _casters->drawables(*self, _selection, view);
}

unsigned ShadowCasterGroup::revision() const { return _casters->count(); }

} // namespace gnomon
