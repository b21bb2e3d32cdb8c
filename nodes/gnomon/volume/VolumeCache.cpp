// SPDX-License-Identifier: MIT
#include <gnomon/casters/Casters.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/volume/VolumeCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// What its drawables hide, a bit each, for each triangle; empty if that is all the same.
std::vector<std::uint8_t> kindsOf(const CasterMesh& mesh) {
    const auto hidesAll = [](const auto& drawn) { return drawn.hiding == Hiding::Both; };
    std::vector<std::uint8_t> kinds;
    if (std::all_of(mesh.drawn.begin(), mesh.drawn.end(), hidesAll)) return kinds;
    kinds.resize(mesh.triangles->size() / 3);
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        const std::size_t end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : mesh.triangles->size();
        std::fill(kinds.begin() + std::ptrdiff_t(mesh.drawn[i].first / 3), kinds.begin() + std::ptrdiff_t(end / 3),
                  static_cast<std::uint8_t>(mesh.drawn[i].hiding));
    }
    return kinds;
}

/// Found once a mesh, wherever it stands.
std::shared_ptr<const SilhouetteMesh> edgesOf(const CasterMesh& mesh) {
    return mesh.derived<SilhouetteMesh>([&mesh] {
        if (mesh.empty()) return std::make_shared<const SilhouetteMesh>();
        const std::vector<std::uint8_t> kinds = kindsOf(mesh);
        return std::make_shared<const SilhouetteMesh>(positionsOf(mesh), mesh.vertices->size(),
                                                      &mesh.triangles->front(), mesh.triangles->size(),
                                                      kinds.empty() ? nullptr : kinds.data());
    });
}

std::vector<VolumeCaster> castersOf(const CasterLayers& casters) {
    std::vector<VolumeCaster> all;
    for (const auto& layer : {casters.still, casters.moving})
        for (const PlacedMesh& placed : layer->meshes)
            all.push_back({edgesOf(*placed.mesh), placed.sceneFromMesh, placed.hiding});
    return all;
}

} // namespace

VolumeCache::VolumeCache() : program(shaderProgram("#define EXTRUDE\n")) {}

std::optional<SeenVolumes> VolumeCache::see(const CasterLayers& casters, const ViewFrame& view, int lightNumber,
                                            const glm::dvec4& light, const SceneFrame& scene) {
    const ReceiverBox receivers = receiversOf(view, scene);
    Lock lock(_mutex);
    const auto [known, isNew] = _entries.try_emplace({view.key, lightNumber}, Entry{receivers, {}});
    Entry& own = known->second;
    // A light that is asked for twice begins a round as well, for views may count no frames.
    if (view.frameNumber != _frame || (!isNew && own.used == _round)) ++_round;
    _frame = view.frameNumber;
    own.used = _round;
    if (!own.receivers.fits(receivers)) own.receivers = receivers.grown();
    const std::vector<VolumeCaster> all = castersOf(casters);
    own.volumes.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) update(own.volumes[i], all[i], light, own.receivers);
    dropUnused();
    return seenVolumes(own.volumes, scene.clipFromScene(view));
}

/// Those of another light give up their memory, unless they are still drawn.
void VolumeCache::update(osg::ref_ptr<LightVolumes>& volumes, const VolumeCaster& caster, const glm::dvec4& light,
                         const ReceiverBox& receivers) {
    if (volumes && volumes->are(caster, light, receivers)) return;
    if (!volumes || volumes->referenceCount() > 1) volumes = new LightVolumes;
    // Isolated: a thread that waits for others must not take up work of the caller's, which might ask in turn.
    tbb::this_task_arena::isolate([&] { volumes->set(caster, light, receivers); });
    ++_builds;
}

void VolumeCache::dropUnused() {
    for (auto entry = _entries.begin(); entry != _entries.end();)
        entry = _round - entry->second.used > longUnused ? _entries.erase(entry) : std::next(entry);
}

unsigned VolumeCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

void VolumeCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    program->resizeGLObjectBuffers(maxSize);
    for (const auto& [owner, entry] : _entries)
        for (const auto& volumes : entry.volumes) volumes->resizeGLObjectBuffers(maxSize);
}

void VolumeCache::release(osg::State* state) const {
    Lock lock(_mutex);
    program->releaseGLObjects(state);
    for (const auto& [owner, entry] : _entries)
        for (const auto& volumes : entry.volumes) volumes->releaseGLObjects(state);
}

} // namespace gnomon
