// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/LocalLight.h>
#include <gnomon/group/ViewFrame.h>
#include <gnomon/traced/TracedMark.h>

#include <stdexcept>

namespace gnomon {

TracedShadowTechnique::TracedShadowTechnique() : _casters(new RaySceneCache), _resolved(new ResolvedDepth) {}

TracedShadowTechnique::TracedShadowTechnique(const TracedShadowTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _casters(new RaySceneCache), _resolved(new ResolvedDepth) {}

TracedShadowTechnique::~TracedShadowTechnique() = default;

std::vector<osg::ref_ptr<MarkJob>> TracedShadowTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                                  const FrameCasters& casters) const {
    const CasterLayers& layers = casters.layers();
    const SceneFrame scene(layers.origin);
    const auto usable = localLight(light.inGroup, scene);
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    osg::ref_ptr<TracedMark> mark = new TracedMark;
    mark->light = *usable;
    mark->resolved = _resolved;
    mark->rounding = layers.largestRounding;
    mark->clipFromScene = scene.clipFromScene(view);
    mark->pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    const auto bounds = shadowBounds(layers, mark->clipFromScene, *usable);
    if (!bounds) return {}; // out of sight: nothing to say
    mark->screenBounds = *bounds;
    try {
        mark->scene = _casters->of(layers, describe());
    } catch (const std::exception& failure) {
        report(view.frameNumber, std::string("there is no shadow. ") + failure.what());
        return {};
    }
    return {mark};
}

unsigned TracedShadowTechnique::builds() const { return _casters->builds(); }

void TracedShadowTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _resolved->release(state);
}

} // namespace gnomon
