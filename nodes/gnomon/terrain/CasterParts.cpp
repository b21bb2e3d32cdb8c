// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/terrain/CasterParts.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace gnomon {
namespace {

/// Triangles of all drawables but these.
std::vector<unsigned> trianglesWithout(const CasterMesh& mesh, const std::set<const osg::Drawable*>& terrain) {
    std::vector<unsigned> result;
    const osg::DrawElementsUInt& all = *mesh.triangles;
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        if (terrain.count(mesh.drawn[i].drawable)) continue;
        const std::size_t end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : all.size();
        result.insert(result.end(), all.begin() + std::ptrdiff_t(mesh.drawn[i].first),
                      all.begin() + std::ptrdiff_t(end));
    }
    return result;
}

void move(glm::dvec4& plane, const glm::dvec3& by) { plane.w -= glm::dot(glm::dvec3(plane), by); }

void move(ConvexPart& part, const glm::dvec3& by) {
    for (glm::dvec3& vertex : part.hull.vertices) vertex += by;
    for (ConvexHull::Face& face : part.hull.faces) move(face.plane, by);
    if (part.front) move(*part.front, by);
}

/// Whether people should know.
bool isNews(TerrainOutcome outcome) {
    constexpr TerrainOutcome asAsked[] = {TerrainOutcome::fan,        TerrainOutcome::draped, TerrainOutcome::block,
                                          TerrainOutcome::turnedAway, TerrainOutcome::edgeOn, TerrainOutcome::buried};
    return std::find(std::begin(asAsked), std::end(asAsked), outcome) == std::end(asAsked);
}

} // namespace

std::vector<ConvexPart> partsOf(const CasterMesh& mesh, const std::set<const osg::Drawable*>& terrain) {
    const std::vector<unsigned> indices = trianglesWithout(mesh, terrain);
    std::vector<ConvexPart> parts =
        convexParts(positionsOf(mesh), mesh.vertices->size(), indices.data(), indices.size());
    for (ConvexPart& part : parts) move(part, toGlm(mesh.origin));
    return parts;
}

std::vector<BoxCaster> boxCastersOf(const CasterMesh& mesh, const std::set<const osg::Drawable*>& terrain,
                                    const osg::BoundingBoxd& box) {
    const std::vector<unsigned> indices = trianglesWithout(mesh, terrain);
    std::vector<BoxCaster> casters;
    for (std::vector<glm::dvec3>& points :
         connectedPoints(positionsOf(mesh), mesh.vertices->size(), indices.data(), indices.size())) {
        for (glm::dvec3& point : points) point += toGlm(mesh.origin);
        casters.push_back(box.valid() ? boxCaster(points, toGlm(box._min), toGlm(box._max)) : boxCaster(points));
    }
    return casters;
}

TerrainShadow boxShadowOf(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light) {
    if (light.w == 0.0 && !(light.z > 0.0)) return {{}, TerrainOutcome::lightBelow};
    auto box = boxShadow(ground, caster, light);
    if (!box) return {{}, TerrainOutcome::noGround};
    return {std::move(*box), isBoxOutline(ground, caster, light) ? TerrainOutcome::block : TerrainOutcome::boxed};
}

void OutcomeCounts::add(const OutcomeCounts& other) {
    for (std::size_t i = 0; i < _counts.size(); ++i) _counts[i] += other._counts[i];
}

std::vector<std::string> OutcomeCounts::causes() const {
    const std::size_t all = std::accumulate(_counts.begin(), _counts.end(), std::size_t{0});
    if (all == 0)
        return {
            "every caster is part of the receiver, so nothing casts on it. Name the terrain alone with setReceiver()."};
    std::vector<std::string> causes;
    for (std::size_t i = 0; i < _counts.size(); ++i) {
        const auto outcome = static_cast<TerrainOutcome>(i);
        if (_counts[i] > 0 && isNews(outcome))
            causes.push_back(std::to_string(_counts[i]) + " of " + std::to_string(all) +
                             " casters: " + sentence(outcome));
    }
    return causes;
}

} // namespace gnomon
