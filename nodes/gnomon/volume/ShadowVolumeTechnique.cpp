// SPDX-License-Identifier: MIT
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/volume/VolumeCache.h>
#include <gnomon/volume/VolumeMark.h>

namespace gnomon {

namespace {

constexpr double mostOff = 1.0; // pixels
constexpr const char* coarse = "casters are so far from one another, or so far from the origin of their vertices, that "
                               "floats place those near the eye only to "
                               "more than a pixel. Leave what is far away out of the casters, give it a group of its "
                               "own, or put the offset into a transform.";

/// Least w of what is drawn.
double nearOf(const osg::Matrixd& projection) {
    return projection(3, 3) != 0.0 ? 1.0 : projection(3, 2) / (projection(2, 2) - 1.0);
}

} // namespace

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
    if (seen->vertexStep(view.pixels.x(), nearOf(view.projection)) > mostOff) report(view.frameNumber, coarse);
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
