// SPDX-License-Identifier: MIT
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/MapMark.h>
#include <gnomon/map/MapSettings.h>
#include <gnomon/map/ShadowMapCache.h>

namespace gnomon {
ShadowMapTechnique::ShadowMapTechnique() : _maps(std::make_unique<ShadowMapCache>()) {}

ShadowMapTechnique::ShadowMapTechnique(const ShadowMapTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _options(other._options), _maps(std::make_unique<ShadowMapCache>()) {}

ShadowMapTechnique::~ShadowMapTechnique() = default;

unsigned ShadowMapTechnique::passes() const { return _maps->resources().passes; }

std::vector<osg::ref_ptr<MarkJob>> ShadowMapTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                               const FrameCasters& casters) const {
    const osg::ref_ptr<const MapCasters> drawn = _maps->castersOf(casters.layers());
    const auto usable = localLight(light.inGroup, SceneFrame(drawn->layers->origin));
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    const std::optional<SpotCone> cone = spotOf(light);
    std::vector<osg::ref_ptr<MarkJob>> marks;
    if (cone && _options.programUnit < 0 && view.group->getComposite() == ShadowCasterGroup::RELIGHT)
        marks.emplace_back(_maps->around(view, *usable, *cone, *drawn));
    const osg::ref_ptr<MarkJob> mark = _maps->mark(view, light.number, *usable, cone, *drawn, _options);
    if (mark) marks.emplace_back(mark); // else out of sight: nothing to say
    return marks;
}

std::string ShadowMapTechnique::programFunction() const { return visibilityFunction(definesOf(_options.filter)); }

void ShadowMapTechnique::letGo() const { _maps->letGo(); }

void ShadowMapTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _maps->resizeGLObjectBuffers(maxSize);
}

void ShadowMapTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _maps->release(state);
}

} // namespace gnomon
