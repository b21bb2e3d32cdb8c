// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/volume/VolumeCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/task_arena.h>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

VolumeCache::VolumeCache() : program(shaderProgram("#define EXTRUDE\n")) {}

std::optional<SeenVolumes> VolumeCache::see(const FrameCasters& casters, const ViewFrame& view, int lightNumber,
                                            const glm::dvec4& light, const SceneFrame& scene) {
    const ReceiverBox receivers = receiversOf(view, scene);
    Lock lock(_mutex);
    std::vector<osg::ref_ptr<LightVolumes>> all;
    for (const VolumeCaster& caster : _casters.of(casters))
        all.push_back(find(caster, {view.stage, lightNumber, all.size(), nullptr}, light, receivers));
    _entries.dropOldestBeyond(std::max(most, 4 * all.size()));
    return seenVolumes(all, scene.clipFromScene(view));
}

/// Another view's will do. A view's own of another light gives up its memory, unless it is still drawn.
osg::ref_ptr<LightVolumes> VolumeCache::find(const VolumeCaster& caster, const Entry& owner, const glm::dvec4& light,
                                             const ReceiverBox& receivers) {
    if (const Entry* known =
            _entries.find([&](const Entry& entry) { return entry.volumes->are(caster, light, receivers); }))
        return known->volumes;
    Entry* own = _entries.find([&](const Entry& entry) {
        return entry.stage == owner.stage && entry.light == owner.light && entry.mesh == owner.mesh;
    });
    if (!own) own = &_entries.add(owner);
    if (!own->volumes || own->volumes->referenceCount() > 1) own->volumes = new LightVolumes;
    // Isolated: a thread that waits for others must not take up work of the caller's, which might ask in turn.
    tbb::this_task_arena::isolate([&] { own->volumes->set(caster, light, receivers); });
    ++_builds;
    return own->volumes;
}

unsigned VolumeCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

void VolumeCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    program->resizeGLObjectBuffers(maxSize);
    for (const Entry& entry : _entries) entry.volumes->resizeGLObjectBuffers(maxSize);
}

void VolumeCache::release(osg::State* state) const {
    Lock lock(_mutex);
    program->releaseGLObjects(state);
    for (const Entry& entry : _entries) entry.volumes->releaseGLObjects(state);
}

} // namespace gnomon
