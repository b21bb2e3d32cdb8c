// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/volume/VolumeCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/task_arena.h>

#include <iterator>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

VolumeCache::VolumeCache() : program(shaderProgram("#define EXTRUDE\n")) {}

std::optional<SeenVolumes> VolumeCache::see(const CasterLayers& casters, const ViewFrame& view, int lightNumber,
                                            const glm::dvec4& light, const SceneFrame& scene) {
    const ReceiverBox receivers = receiversOf(view, scene);
    Lock lock(_mutex);
    const auto own = _entries.find({view.stage, lightNumber, 0});
    // A light that is asked for twice begins a round as well, for views may count no frames.
    if (view.frameNumber != _frame || (own != _entries.end() && own->second.used == _round)) ++_round;
    _frame = view.frameNumber;
    const ReceiverBox& box = boxOf(view.stage, receivers);
    std::vector<osg::ref_ptr<LightVolumes>> all;
    for (const VolumeCaster& caster : _casters.of(casters, _round))
        all.push_back(find(caster, _entries[{view.stage, lightNumber, all.size()}], light, box));
    dropUnused();
    return seenVolumes(all, scene.clipFromScene(view));
}

const ReceiverBox& VolumeCache::boxOf(const void* stage, const ReceiverBox& receivers) {
    const auto [known, isNew] = _boxes.emplace(stage, Box{receivers});
    Box& box = known->second;
    if (!isNew && !box.receivers.fits(receivers)) box.receivers = receivers.grown();
    box.used = _round;
    return box.receivers;
}

/// Those of another light give up their memory, unless they are still drawn.
osg::ref_ptr<LightVolumes> VolumeCache::find(const VolumeCaster& caster, Entry& own, const glm::dvec4& light,
                                             const ReceiverBox& receivers) {
    own.used = _round;
    if (own.volumes && own.volumes->are(caster, light, receivers)) return own.volumes;
    if (!own.volumes || own.volumes->referenceCount() > 1) own.volumes = new LightVolumes;
    // Isolated: a thread that waits for others must not take up work of the caller's, which might ask in turn.
    tbb::this_task_arena::isolate([&] { own.volumes->set(caster, light, receivers); });
    ++_builds;
    return own.volumes;
}

void VolumeCache::dropUnused() {
    const auto drop = [this](auto& owners) {
        for (auto owner = owners.begin(); owner != owners.end();)
            owner = _round - owner->second.used > longUnused ? owners.erase(owner) : std::next(owner);
    };
    drop(_entries);
    drop(_boxes);
}

unsigned VolumeCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

void VolumeCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    program->resizeGLObjectBuffers(maxSize);
    for (const auto& [owner, entry] : _entries) entry.volumes->resizeGLObjectBuffers(maxSize);
}

void VolumeCache::release(osg::State* state) const {
    Lock lock(_mutex);
    program->releaseGLObjects(state);
    for (const auto& [owner, entry] : _entries) entry.volumes->releaseGLObjects(state);
}

} // namespace gnomon
