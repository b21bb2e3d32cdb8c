// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/group/StageLeaves.h>
#include <gnomon/volume/VolumeCache.h>

#include <OpenThreads/ScopedLock>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

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
        return std::make_shared<const SilhouetteMesh>(
            SilhouetteMesh::Source{positionsOf(mesh), mesh.vertices->size(), &mesh.triangles->front(),
                                   mesh.triangles->size(), kinds.empty() ? nullptr : kinds.data(), offsetsOf(mesh)});
    });
}

std::vector<VolumeCaster> volumeCastersOf(const CasterLayers& casters) {
    std::vector<VolumeCaster> all;
    for (const auto& layer : {casters.still, casters.moving})
        for (const PlacedMesh& placed : layer->meshes)
            all.push_back({edgesOf(*placed.mesh), placed.sceneFromMesh, placed.hiding});
    return all;
}

/// Least w of what is drawn.
double nearOf(const osg::Matrixd& projection) {
    return projection(3, 3) != 0.0 ? 1.0 : projection(3, 2) / (projection(2, 2) - 1.0);
}

} // namespace

VolumeCache::VolumeCache() : program(shaderProgram("#define EXTRUDE\n")), edges(new MarkEdges(MarkEdges::Of::Sides)) {}

std::shared_ptr<const SeenVolumes> VolumeCache::see(const CasterLayers& casters, const ViewFrame& view, int lightNumber,
                                                    const glm::dvec4& light, const SceneFrame& scene) {
    Lock lock(_mutex);
    Found& found = _found.of(view.key, lightNumber, view.frameNumber);
    const bool sameReceivers = found.receivers && view.seenValue != 0 && found.seenValue == view.seenValue &&
                               found.origin == scene.origin && hasSameBits(found.eyeFromGroup, view.eyeFromGroup);
    if (!sameReceivers) {
        const ReceiverBox receivers = receiverBoxOf(view, scene);
        if (!found.receivers)
            found.receivers = receivers;
        else if (!found.receivers->fits(receivers))
            found.receivers = receivers.grown();
        found.seenValue = view.seenValue;
        found.origin = scene.origin;
        found.eyeFromGroup = view.eyeFromGroup;
    }
    const bool same = follow(found, volumeCastersOf(casters), light);
    const glm::dmat4 clipFromScene = scene.clipFromScene(view);
    const std::uint64_t standing = view.drawn ? view.drawn->standingValue() : 0;
    if (same && sameReceivers && clipFromScene == found.clipFromScene && standing == found.standingValue)
        return found.seen;
    found.seen = nullptr; // whose caps may be given up
    found.clipFromScene = clipFromScene;
    found.standingValue = standing;
    return found.seen = seenVolumes(found.volumes, clipFromScene, nearOf(view.projection), found.rounds,
                                    unseenCasters(casters, view, scene));
}

/// @return true if all volumes are those that were found before.
bool VolumeCache::follow(Found& found, const std::vector<VolumeCaster>& casters, const glm::dvec4& light) {
    const auto are = [&](const osg::ref_ptr<LightVolumes>& volumes, const VolumeCaster& caster) {
        return volumes->are(caster, light, *found.receivers);
    };
    if (found.rounds && std::equal(found.volumes.begin(), found.volumes.end(), casters.begin(), casters.end(), are))
        return true;
    found.seen = nullptr; // whose volumes may be given up
    found.volumes.resize(casters.size());
    for (std::size_t i = 0; i < casters.size(); ++i) update(found.volumes[i], casters[i], light, *found.receivers);
    found.rounds = new VolumeRounds(found.volumes);
    return false;
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

unsigned VolumeCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

void VolumeCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    program->resizeGLObjectBuffers(maxSize);
    edges->resizeGLObjectBuffers(maxSize);
    for (const auto& entry : _found)
        for (const auto& volumes : entry->value.volumes) volumes->resizeGLObjectBuffers(maxSize);
}

void VolumeCache::release(osg::State* state) const {
    Lock lock(_mutex);
    program->releaseGLObjects(state);
    edges->releaseGLObjects(state);
    for (const auto& entry : _found)
        for (const auto& volumes : entry->value.volumes) volumes->releaseGLObjects(state);
}

} // namespace gnomon
