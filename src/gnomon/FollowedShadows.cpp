// SPDX-License-Identifier: MIT
#include <gnomon/FollowedShadows.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// By how much in plan one has to be moved to be the other, corner by corner, and with it all that is between them: infinite
/// where they are not made of the same triangles.
double apart(const PackedShadow& a, const PackedShadow& b) {
    if (a.isFan() != b.isFan() || a.cornerCount != b.cornerCount || a.indexCount != b.indexCount) return infinite;
    if (!std::equal(a.indices, a.indices + a.indexCount, b.indices)) return infinite;
    double most = 0.0;
    for (std::size_t i = 0; i < a.cornerCount; ++i)
        most = std::max(most, glm::length(glm::dvec2(a.corners[i]) - glm::dvec2(b.corners[i])));
    return most;
}

} // namespace

void FollowedShadows::begin(const std::vector<ShadowMotion>& motions, const glm::dvec4& sun) {
    _parts.clear();
    for (const ShadowMotion& motion : motions) _parts.push_back({motion, wayOf(sun), 0.0});
}

double FollowedShadows::offBy(const glm::dvec4& sun) const {
    double most = 0.0;
    for (const Part& part : _parts) most = std::max(most, part.offBy(wayOf(sun)));
    return most;
}

void FollowedShadows::look(const Ground& ground, const PackedParts& parts, const PackedShadows& shown,
                           const glm::dvec4& sun, TerrainMethod method, double error, double most) {
    thread_local std::vector<std::size_t> places; // memory that is used again
    thread_local PackedShadows found;
    thread_local std::vector<ShadowMotion> motions;
    const glm::dvec2 way = wayOf(sun);
    places.clear();
    for (std::size_t i = 0; i < _parts.size(); ++i)
        if (!(_parts[i].offBy(way) <= most)) places.push_back(i);
    if (2 * places.size() > _parts.size()) return;
    PackedParts again;
    for (const std::size_t i : places) again.add(parts, i);
    packedShadows(ground, again, sun, method, error, shown.origin, found, &motions);
    for (std::size_t k = 0; k < places.size(); ++k)
        _parts[places[k]] = {motions[k], way, apart(shown[places[k]], found[k])};
}

} // namespace gnomon
