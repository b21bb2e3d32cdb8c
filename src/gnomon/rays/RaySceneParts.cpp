// SPDX-License-Identifier: MIT
#include <gnomon/rays/Placement.h>
#include <gnomon/rays/RayScene-inl.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>

#include <stdexcept>

namespace gnomon {

RayScene::Embree::Part::Part(const PlacedRayScene& given, unsigned itsIndex)
    : scene(given.scene),
      index(itsIndex),
      stretched(stretch(given.outerFromInner)),
      outerFromPart(glm::translate(given.outerFromInner, given.scene->_embree->origin)),
      partFromOuter(glm::inverse(outerFromPart)) {}

LocalRay RayScene::Embree::Part::inside(const LocalRay& ray) const {
    return {glm::dvec3(partFromOuter * glm::dvec4(ray.start, 1.0)), glm::dmat3(partFromOuter) * ray.along, ray.reach,
            ray.endSize / stretched};
}

void RayScene::Embree::take(const std::vector<PlacedRayScene>& given) {
    for (unsigned i = 0; i < given.size(); ++i) {
        if (!given[i].scene || !given[i].scene->_embree->parts.empty())
            throw std::invalid_argument("gnomon::RayScene: a part must be a scene that has no parts of its own.");
        const Embree& inner = *given[i].scene->_embree;
        leftOut += inner.leftOut;
        if (!isPlacement(given[i].outerFromInner)) leftOut += inner.kept.size();
        if (inner.kept.empty() || !isPlacement(given[i].outerFromInner)) continue;
        parts.emplace_back(given[i], i);
        const RTCGeometry instance = rtcNewGeometry(embreeDevice(), RTC_GEOMETRY_TYPE_INSTANCE);
        const glm::mat4x3 matrix(parts.back().outerFromPart);
        rtcSetGeometryInstancedScene(instance, inner.scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &matrix[0][0]);
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(scene, instance, static_cast<unsigned>(parts.size() - 1));
        rtcReleaseGeometry(instance);
    }
}

/// As measure(), of triangles where they are.
void RayScene::Embree::measureParts() {
    std::size_t triangles = 0;
    for (const Part& part : parts) triangles += part.scene->_embree->kept.size();
    const std::size_t every = triangles / 1000 + 1;
    std::vector<double> distances;
    std::size_t next = 0; // of the part's
    for (const Part& part : parts) {
        const Embree& inner = *part.scene->_embree;
        longest = std::max(longest, part.stretched * inner.longest);
        const auto distance = [&](int i) {
            return largestOf(glm::dvec3(part.outerFromPart * glm::dvec4(inner.corner(next, i), 1.0)));
        };
        for (; next < inner.kept.size(); next += every)
            distances.push_back(std::max({distance(0), distance(1), distance(2)}));
        next -= inner.kept.size();
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    size = *middle;
}

/// Distances along a ray are the same in every frame. A normal is turned as planes are.
RayHit RayScene::Embree::refined(const Cast& cast, const RTCHit& hit) const {
    if (parts.empty()) return refined(cast.local, hit.primID);
    const Part& part = parts[hit.instID[0]];
    RayHit result = part.scene->_embree->refined(part.inside(cast.local), hit.primID);
    result.part = part.index;
    result.normal = glm::normalize(glm::transpose(glm::dmat3(part.partFromOuter)) * result.normal);
    return result;
}

} // namespace gnomon
