// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/MapCasters.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

MapCasters::Box boxOf(const CasterMesh& mesh, std::size_t first, std::size_t end) {
    MapCasters::Box box{glm::dvec3(std::numeric_limits<double>::infinity()), {}};
    box.high = -box.low;
    for (std::size_t i = first; i < end; ++i) {
        const glm::dvec3 vertex = toGlm(osg::Vec3d((*mesh.vertices)[(*mesh.triangles)[static_cast<unsigned>(i)]]));
        box.low = glm::min(box.low, vertex);
        box.high = glm::max(box.high, vertex);
    }
    return box;
}

std::vector<MapCasters::Box> boxesOf(const CasterMesh& mesh) {
    std::vector<MapCasters::Box> boxes;
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        const std::size_t end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : mesh.triangles->size();
        if (mesh.drawn[i].first < end) boxes.push_back(boxOf(mesh, mesh.drawn[i].first, end));
    }
    std::sort(boxes.begin(), boxes.end(),
              [](const auto& a, const auto& b) { return glm::distance(a.low, a.high) > glm::distance(b.low, b.high); });
    return boxes;
}

} // namespace

MapCasters::MapCasters(const CasterMesh& casters)
    : mesh(&casters),
      geometry(casterGeometry(casters, casters.triangles.get())),
      boxes(boxesOf(casters)),
      reach(toGlm(casters.bounds._max - casters.bounds._min) / 2.0) {}

} // namespace gnomon
