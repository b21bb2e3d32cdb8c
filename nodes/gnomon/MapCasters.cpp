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
        const glm::dvec3 vertex = toGlm(osg::Vec3d((*mesh.vertices)[(*mesh.triangles)[i]]));
        box.low = glm::min(box.low, vertex);
        box.high = glm::max(box.high, vertex);
    }
    return box;
}

bool isFlat(const MapCasters::Box& box) {
    const glm::dvec3 size = box.high - box.low;
    return std::min({size.x, size.y, size.z}) == 0.0;
}

void sortBySize(std::vector<MapCasters::Box>& boxes) {
    std::sort(boxes.begin(), boxes.end(),
              [](const auto& a, const auto& b) { return glm::distance(a.low, a.high) > glm::distance(b.low, b.high); });
}

} // namespace

MapCasters::MapCasters(const CasterMesh& casters)
    : mesh(&casters),
      all(casterGeometry(casters, casters.triangles.get())),
      reach(toGlm(casters.bounds._max - casters.bounds._min) / 2.0) {
    osg::ref_ptr<osg::DrawElementsUInt> rest = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
    for (std::size_t i = 0; i < casters.drawn.size(); ++i) {
        const std::size_t first = casters.drawn[i].first,
                          end = i + 1 < casters.drawn.size() ? casters.drawn[i + 1].first : casters.triangles->size();
        if (first == end) continue;
        const Box box = boxOf(casters, first, end);
        (isFlat(box) ? flatBoxes : bodyBoxes).push_back(box);
        if (!isFlat(box))
            rest->insert(rest->end(), &(*casters.triangles)[first], &(*casters.triangles)[first] + (end - first));
    }
    if (flatBoxes.empty())
        bodies = all;
    else if (!rest->empty())
        bodies = casterGeometry(casters, rest);
    sortBySize(bodyBoxes);
    sortBySize(flatBoxes);
}

void MapCasters::resizeGLObjectBuffers(unsigned maxSize) const {
    all->resizeGLObjectBuffers(maxSize);
    if (bodies) bodies->resizeGLObjectBuffers(maxSize);
}

void MapCasters::releaseGLObjects(osg::State* state) const {
    all->releaseGLObjects(state);
    if (bodies) bodies->releaseGLObjects(state);
}

} // namespace gnomon
