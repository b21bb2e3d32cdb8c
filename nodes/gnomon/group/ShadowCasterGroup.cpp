// SPDX-License-Identifier: MIT
#include <gnomon/NamesNodes.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/base/CopiedNodes.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterFingerprint.h>
#include <gnomon/casters/CasterMesh.h>

#include <OpenThreads/ScopedLock>
#include <osg/Notify>

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// Warns otherwise.
bool isLightNumber(int number, const char* method) {
    if (number >= 0 && number < 8) return true;
    OSG_WARN << "gnomon: ShadowCasterGroup::" << method << "(): light " << number
             << " is refused. Give an OpenGL light number from 0 to 7." << std::endl;
    return false;
}

} // namespace

ShadowCasterGroup::ShadowCasterGroup() : _watch(new CasterFingerprint) {}

ShadowCasterGroup::ShadowCasterGroup(const ShadowCasterGroup& other, const osg::CopyOp& copyOp)
    : osg::Group(other, copyOp),
      _selection(other._selection),
      _composite(other._composite),
      _dark(other._dark),
      _lightSources(other._lightSources),
      _lights(other._lights),
      _lightUniforms(other._lightUniforms),
      _options(other._options),
      _watch(new CasterFingerprint(other._selection)) {
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
    Lock lock(_mutex);
    _selection = casters;
    _watch = new CasterFingerprint(casters);
    _mesh = nullptr;
    _pieces = nullptr;
    _fingerprint = 0;
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

osg::ref_ptr<const CasterMesh> ShadowCasterGroup::casters() const {
    auto* self = const_cast<ShadowCasterGroup*>(this); // a visitor asks for a mutable node, and changes nothing
    Lock lock(_mutex);
    _watch->reset();
    self->accept(*_watch);
    noteRevision(_watch->value());
    if (_mesh && _watch->value() == _meshFingerprint) return _mesh;
    osg::ref_ptr<CasterExtraction> traverser = new CasterExtraction(_selection);
    self->accept(*traverser);
    _mesh = new CasterMesh(*traverser);
    _meshFingerprint = _watch->value();
    return _mesh;
}

void ShadowCasterGroup::noteRevision(std::uint64_t fingerprint) const {
    if (_revision > 0 && fingerprint == _fingerprint) return;
    _fingerprint = fingerprint;
    ++_revision;
}

osg::ref_ptr<const CasterDrawables> ShadowCasterGroup::drawables() const {
    Lock lock(_mutex);
    _pieces = CasterDrawables::of(*const_cast<ShadowCasterGroup*>(this), _selection, _pieces); // which changes nothing
    noteRevision(_pieces->fingerprint);
    return _pieces;
}

unsigned ShadowCasterGroup::revision() const {
    Lock lock(_mutex);
    return _revision;
}

} // namespace gnomon
