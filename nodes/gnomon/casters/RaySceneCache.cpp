// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/RaySceneCache.h>

#include <OpenThreads/ScopedLock>

#include <algorithm>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// Tells what alpha tests leave of a mesh's triangles. What only its own drawing can tell counts as solid.
class SolidPoints {
public:
    explicit SolidPoints(const CasterMesh& mesh) : _mesh(&mesh) {
        for (const CasterExtraction::Cutout& cutout : mesh.cutouts) {
            if (cutout.selfDrawn || !cutout.test.isKnown()) continue;
            const std::size_t next = cutout.drawn + 1;
            const std::size_t end = next < mesh.drawn.size() ? mesh.drawn[next].first : mesh.triangles->size();
            _spans.push_back({mesh.drawn[cutout.drawn].first / 3, end / 3, &cutout});
        }
    }

    bool empty() const { return _spans.empty(); }

    bool operator()(unsigned triangle, double u, double v) const {
        const auto span = std::upper_bound(_spans.begin(), _spans.end(), std::size_t{triangle},
                                           [](std::size_t place, const Span& each) { return place < each.end; });
        if (span == _spans.end() || triangle < span->first) return true;
        const auto corner = [&](unsigned i) {
            const unsigned vertex = (*_mesh->triangles)[3 * std::size_t{triangle} + i];
            return osg::Vec3d(span->cutout->coordinates[vertex - span->cutout->firstVertex]);
        };
        return span->cutout->test.sampled(corner(0) * (1.0 - u - v) + corner(1) * u + corner(2) * v);
    }

private:
    /// Triangles of a drawable that is cut.
    struct Span {
        std::size_t first, end;
        const CasterExtraction::Cutout* cutout; ///< of the mesh.
    };
    osg::ref_ptr<const CasterMesh> _mesh;
    std::vector<Span> _spans; ///< in their order.
};

/// @param wasBuilt  set if it was not there yet.
std::shared_ptr<const RayScene> treeOf(const CasterMesh& mesh, const std::string& name, bool& wasBuilt) {
    return mesh.lent<RayScene>([&] {
        wasBuilt = true;
        ProgressLine progress("gnomon: " + name + " builds a tree of " + std::to_string(mesh.triangles->size() / 3) +
                              " triangles");
        return std::make_shared<const RayScene>(soupOf(mesh), [&progress](double share) { progress.show(share); });
    });
}

} // namespace

TriangleSoup soupOf(const CasterMesh& mesh) {
    TriangleSoup soup;
    soup.vertices = positionsOf(mesh);
    soup.vertexCount = mesh.vertices->size();
    soup.indices = mesh.triangles->empty() ? nullptr : &mesh.triangles->front();
    soup.indexCount = mesh.triangles->size();
    soup.terminatorOffsets = offsetsOf(mesh);
    if (SolidPoints solid(mesh); !solid.empty()) soup.solidAt = std::move(solid);
    return soup;
}

std::shared_ptr<const RayScene> RaySceneCache::of(const Casters& casters, const std::string& name) {
    if (const auto known = find(casters)) return known;
    const std::vector<PlacedMesh> meshes = casters.layers().meshes();
    std::vector<std::shared_ptr<const RayScene>> there; // held, for others may go before more are built
    for (const PlacedMesh& placed : meshes) there.push_back(placed.mesh->known<RayScene>());
    dropOld();
    std::vector<PlacedRayScene> parts;
    bool anyBuilt = false;
    for (const PlacedMesh& placed : meshes)
        parts.push_back({treeOf(*placed.mesh, name, anyBuilt), placed.sceneFromMesh});
    const bool isOne = parts.size() == 1 && parts.front().outerFromInner == glm::dmat4(1.0);
    const auto scene = isOne ? parts.front().scene : std::make_shared<const RayScene>(parts);
    dropOld(); // others may have added theirs
    Lock lock(_mutex);
    _builds += anyBuilt;
    return _entries.add({casters.retired(), scene}).scene;
}

std::shared_ptr<const RayScene> RaySceneCache::find(const Casters& casters) {
    Lock lock(_mutex);
    const Entry* known = _entries.find([&](const Entry& entry) { return entry.casters == casters.retired(); });
    return known ? known->scene : nullptr;
}

void RaySceneCache::dropOld() {
    Lock lock(_mutex);
    _entries.dropIf([](const Entry& entry) { return entry.casters->load(); });
    _entries.dropOldestBeyond(most - 1);
}

unsigned RaySceneCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

} // namespace gnomon
