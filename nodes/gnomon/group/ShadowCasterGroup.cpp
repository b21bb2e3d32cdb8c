// SPDX-License-Identifier: MIT
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/base/OptimizerGuard.h>
#include <gnomon/casters/CasterTable.h>

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

/// What of a group's settings decides what casts.
CastingRule ruleOf(const ShadowCasterGroup& group) {
    const float from = group.getOpaqueFrom();
    const auto clips = group.getClipping() == ShadowCasterGroup::ALL    ? CastingRule::All
                       : group.getClipping() == ShadowCasterGroup::NONE ? CastingRule::None
                                                                        : CastingRule::OfGraph;
    const float even = from < 0.0f ? 1.0f : from;
    return {from < 0.0f ? 0.5f : from, even, clips, group.getTerminatorOffset(), group.getMatrixUniforms()};
}

/// Techniques that are off are met as well.
class LetsGo : public osg::NodeVisitor {
public:
    LetsGo() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
    void apply(osg::Geode& geode) override {
        if (const auto* technique = dynamic_cast<const ShadowTechnique*>(&geode)) technique->letGo();
    }
};

} // namespace

ShadowCasterGroup::ShadowCasterGroup() : _table(new CasterTable) { _table->setRule(ruleOf(*this)); }

ShadowCasterGroup::ShadowCasterGroup(const ShadowCasterGroup& other, const osg::CopyOp& copyOp)
    : osg::Group(other, copyOp),
      _casters(other._casters, other),
      _composite(other._composite),
      _clipping(other._clipping),
      _terminatorOffset(other._terminatorOffset),
      _dark(other._dark),
      _opaqueFrom(other._opaqueFrom),
      _lights(other._lights),
      _lightUniforms(other._lightUniforms),
      _matrixUniforms(other._matrixUniforms),
      _options(other._options),
      _table(new CasterTable) {
    _table->setRule(ruleOf(*this));
    for (const ObservedNode& source : other._lightSources) _lightSources.emplace_back(source, other);
}

ShadowCasterGroup::~ShadowCasterGroup() = default;

bool ShadowCasterGroup::showsAllChildren() const { return typeid(*this) == typeid(ShadowCasterGroup); }

void ShadowCasterGroup::setCasters(const Selection& casters) {
    _casters = casters;
    _table->clear();
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

void ShadowCasterGroup::setOpaqueFrom(float alpha) {
    if (std::isnan(alpha)) {
        OSG_WARN
            << "gnomon: ShadowCasterGroup::setOpaqueFrom(): NaN is refused. Give an alpha from 0 (all cast) to 1, or "
               "-1 (glass and water do not)."
            << std::endl;
        return;
    }
    _opaqueFrom = alpha < 0.0f ? -1.0f : std::min(alpha, 1.0f);
    _table->setRule(ruleOf(*this));
}

void ShadowCasterGroup::setClipping(Clipping clipping) {
    _clipping = clipping == ALL || clipping == NONE ? clipping : GRAPH;
    _table->setRule(ruleOf(*this));
}

void ShadowCasterGroup::setTerminatorOffset(bool offset) {
    _terminatorOffset = offset;
    _table->setRule(ruleOf(*this));
}

void ShadowCasterGroup::addLight(osg::LightSource* light) {
    if (light) _lightSources.emplace_back(light);
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

std::vector<osg::ref_ptr<osg::LightSource>> ShadowCasterGroup::getLightSources() const {
    std::vector<osg::ref_ptr<osg::LightSource>> sources;
    for (const ObservedNode& named : _lightSources) {
        const osg::ref_ptr<osg::Node> node = named.in(*this);
        if (auto* source = dynamic_cast<osg::LightSource*>(node.get())) sources.emplace_back(source);
    }
    return sources;
}

std::vector<Selection> ShadowCasterGroup::namedParts() const {
    std::vector<Selection> parts;
    if (getCasters() != Selection()) parts.push_back(getCasters());
    for (const auto& source : getLightSources()) parts.push_back({source});
    return parts;
}

void ShadowCasterGroup::traverse(osg::NodeVisitor& visitor) {
    if (keptFromOptimizer(*this, visitor)) return;
    if (visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR && _table->passCull()) {
        const osg::ref_ptr<LetsGo> techniques = new LetsGo;
        osg::Group::traverse(*techniques);
    }
    osg::Group::traverse(visitor);
}

void ShadowCasterGroup::ascend(osg::NodeVisitor& visitor) {
    if (!endsForOptimizer(visitor)) osg::Group::ascend(visitor);
}

void ShadowCasterGroup::addLightUniform(const LightUniform& uniform) {
    if (isLightNumber(uniform.number, "addLightUniform")) _lightUniforms.push_back(uniform);
}

void ShadowCasterGroup::setLightUniforms(std::vector<LightUniform> uniforms) {
    _lightUniforms.clear();
    for (const LightUniform& uniform : uniforms) addLightUniform(uniform);
}

void ShadowCasterGroup::addMatrixUniform(const MatrixUniform& uniform) {
    if (uniform.kind < MatrixUniform::MODEL_VIEW_PROJECTION || uniform.kind > MatrixUniform::VIEW_PROJECTION) {
        OSG_WARN << "gnomon: ShadowCasterGroup::addMatrixUniform(): kind " << int(uniform.kind) << " of '"
                 << uniform.name << "' is refused. Give MODEL_VIEW_PROJECTION, PROJECTION or VIEW_PROJECTION."
                 << std::endl;
        return;
    }
    _matrixUniforms.push_back(uniform);
    _table->setRule(ruleOf(*this));
}

void ShadowCasterGroup::setMatrixUniforms(std::vector<MatrixUniform> uniforms) {
    _matrixUniforms.clear();
    _table->setRule(ruleOf(*this));
    for (const MatrixUniform& uniform : uniforms) addMatrixUniform(uniform);
}

void ShadowCasterGroup::removeLights() {
    _lightSources.clear();
    _lights.clear();
}

osg::ref_ptr<const Casters> ShadowCasterGroup::casters(const CasterView* view) const {
    auto* self = const_cast<ShadowCasterGroup*>(this); // a visitor asks for a mutable node, and changes nothing
    return _table->casters(*self, getCasters(), view);
}

unsigned ShadowCasterGroup::revision() const { return _table->count(); }

} // namespace gnomon
