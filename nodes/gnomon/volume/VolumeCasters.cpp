// SPDX-License-Identifier: MIT
#include <gnomon/group/FrameCasters.h>
#include <gnomon/volume/VolumeCasters.h>

namespace gnomon {
namespace {

std::shared_ptr<const SilhouetteMesh> edgesOf(const CasterMesh& mesh) {
    static_assert(sizeof(osg::Vec3) == sizeof(glm::vec3));
    if (mesh.empty()) return std::make_shared<const SilhouetteMesh>();
    const auto* vertices = static_cast<const glm::vec3*>(mesh.vertices->getDataPointer());
    return std::make_shared<const SilhouetteMesh>(vertices, mesh.vertices->size(), &mesh.triangles->front(),
                                                  mesh.triangles->size());
}

} // namespace

std::vector<VolumeCaster> VolumeCasters::of(const FrameCasters& casters) {
    const CasterMesh& mesh = casters.mesh();
    const Entry* known = _entries.find([&](const Entry& entry) { return entry.mesh == &mesh; });
    if (!known) {
        _entries.dropIf([](const Entry& entry) { return entry.mesh->isRetired(); });
        _entries.dropOldestBeyond(most - 1);
        known = &_entries.add({&mesh, edgesOf(mesh)});
    }
    return {{known->edges, glm::dmat4(1.0)}};
}

} // namespace gnomon
