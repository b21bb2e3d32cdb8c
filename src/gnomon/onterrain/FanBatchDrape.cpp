// SPDX-License-Identifier: MIT
// FanBatch: shadows as the ground's triangles.
#include <gnomon/onterrain/FanBatch.h>

#include <glm/common.hpp>

#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

/// Where on the grid the shadow can be at most, about the anchor: no ground there is lower than the lowest in what was found
/// before. @return false if the light is not above all of the part.
bool FanBatch::findReach(std::size_t i, glm::dvec2& low, glm::dvec2& high) const {
    const Entry& entry = _entries[i];
    double bottom = _grid->range().low;
    for (int step = 0; step < 3; ++step) {
        low = glm::dvec2(infinite);
        high = -low;
        for (std::size_t e = 0; e < fanOf(entry).edges; ++e) {
            const glm::dvec3 corner = silhouette(entry, e);
            const double down = std::max(0.0, corner.z + entry.anchor.z - bottom);
            const glm::dvec2 end = glm::dvec2(corner) + down * wayOf(entry, corner);
            low = glm::min(low, glm::min(glm::dvec2(corner), end));
            high = glm::max(high, glm::max(glm::dvec2(corner), end));
            if (!(end.x + end.y > -infinite)) return false;
        }
        const auto range = _grid->range(glm::dvec2(entry.anchor) + low, glm::dvec2(entry.anchor) + high);
        if (!range || range->low <= bottom) break;
        bottom = range->low;
    }
    return true;
}

void FanBatch::takePlanes(std::size_t i) {
    const Entry& entry = _entries[i];
    _planes.anchor = entry.anchor;
    _planes.about.clear();
    for (std::size_t f = 0; f < fanOf(entry).faces; ++f) _planes.about.push_back(facePlane(entry, f));
    for (std::size_t e = 0; e < fanOf(entry).edges; ++e) _planes.about.push_back(edgePlane(entry, e));
}

const DrapeMesh& FanBatch::drape(std::size_t i, double error) {
    const Entry& entry = _entries[i];
    glm::dvec2 low, high;
    if (_grid && findReach(i, low, high)) {
        takePlanes(i);
        if (const DrapeMesh* found = _gridDrape.drape(*_grid, _planes, low, high, error, entry.tangent, *_kernel))
            return *found;
    }
    const ConvexShadow all = shadow(i);
    const double slope = error > 0.0 ? _ground->steepest(all.planes) : 0.0;
    return meshOf(gnomon::drape(*_ground, all, heightError(error, entry.tangent, slope)), entry.anchor);
}

const DrapeMesh& FanBatch::allGround(std::size_t i) {
    return meshOf(gnomon::drape(*_ground, {}, 0.0), _entries[i].anchor);
}

/// Corners at one place are one.
const DrapeMesh& FanBatch::meshOf(const Drape& triangles, const glm::dvec3& anchor) {
    _numbers.clear(triangles.size());
    _mesh.indices.clear();
    for (const glm::dvec3& corner : triangles) _mesh.indices.push_back(_numbers.of(corner - anchor + 0.0)); // no -0
    _mesh.corners = _numbers.keys;
    return _mesh;
}

} // namespace gnomon
