// SPDX-License-Identifier: MIT
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/LocalLight.h>
#include <gnomon/volume/VolumeCache.h>
#include <gnomon/volume/VolumeMark.h>

namespace gnomon {

ShadowVolumeOptions ShadowVolumeOptions::usable() const {
    return {view == VOLUMES ? VOLUMES : ShadowVolumeOptions().view};
}

ShadowVolumeTechnique::ShadowVolumeTechnique() : _cache(std::make_unique<VolumeCache>()) {}

ShadowVolumeTechnique::ShadowVolumeTechnique(const ShadowVolumeTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _options(other._options), _cache(std::make_unique<VolumeCache>()) {}

ShadowVolumeTechnique::~ShadowVolumeTechnique() = default;

unsigned ShadowVolumeTechnique::builds() const { return _cache->builds(); }

std::vector<osg::ref_ptr<MarkJob>> ShadowVolumeTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                                  const FrameCasters& casters) const {
    const CasterLayers& layers = casters.layers();
    const SceneFrame scene(layers.origin);
    const auto usable = localLight(light.inGroup, scene);
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    std::optional<SeenVolumes> seen = _cache->see(layers, view, light.number, *usable, scene);
    if (!seen) return {}; // out of sight: nothing to say
    osg::ref_ptr<VolumeMark> mark = new VolumeMark;
    mark->seen = std::move(*seen);
    mark->screenBounds = mark->seen.bounds;
    mark->program = _cache->program;
    mark->pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    mark->showsVolumes = _options.view == VOLUMES;
    return {mark};
}

void ShadowVolumeTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _cache->resizeGLObjectBuffers(maxSize);
}

void ShadowVolumeTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _cache->release(state);
}

} // namespace gnomon
