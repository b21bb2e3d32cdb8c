// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/group/ViewFrame.h>
#include <gnomon/traced/TracedMark.h>

#include <exception>

namespace gnomon {

TracedShadowTechnique::TracedShadowTechnique()
    : _casters(new RaySceneCache), _resolved(new ResolvedDepth), _frames(new TracedFrames) {}

TracedShadowTechnique::TracedShadowTechnique(const TracedShadowTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp),
      _casters(new RaySceneCache),
      _resolved(new ResolvedDepth),
      _frames(new TracedFrames) {}

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
    mark->frame.lightInScene = *usable;
    mark->frame.light = light.number;
    mark->frame.stage = view.stage;
    mark->frame.origin = layers.origin;
    mark->frame.pieces = layers.pieces;
    mark->frames = _frames;
    mark->resolved = _resolved;
    mark->rounding = layers.largestRounding;
    mark->frame.clipFromScene = scene.clipFromScene(view);
    mark->pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    const auto bounds = shadowBounds(layers, mark->frame.clipFromScene, *usable);
    if (!bounds) return {}; // out of sight: nothing to say
    mark->screenBounds = *bounds;
    try {
        mark->frame.scene = _casters->of(layers, describe());
    } catch (const std::exception& failure) {
        report(view.frameNumber, std::string("there is no shadow. ") + failure.what());
        return {};
    }
    return {mark};
}

std::string TracedShadowTechnique::whyUnavailable() const { return whyMissing(OptionalPart::Traced); }

unsigned TracedShadowTechnique::builds() const { return _casters->builds(); }

std::size_t TracedShadowTechnique::tracedPixels() const { return _frames->traced(); }

void TracedShadowTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _resolved->release(state);
}

} // namespace gnomon
