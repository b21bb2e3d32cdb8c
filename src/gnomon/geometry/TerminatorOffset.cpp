// SPDX-License-Identifier: MIT
#include <gnomon/geometry/MeshEdges.h>
#include <gnomon/geometry/TerminatorOffset.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr double leastCosine = 0.9063078; // of 25 degrees
constexpr double leastTurn = 1e-4;        // radians: less is the rounding of normals

struct Bend {
    double offset = 0.0, turn = 0.0;
};

/// Of a triangle, if its normals are near that of its plane, whichever way they point.
Bend bendOf(const glm::dvec3 (&at)[3], const glm::dvec3 (&normals)[3]) {
    const glm::dvec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
    const double least = leastCosine * glm::length(across);
    const auto isNear = [&](double sign) {
        return std::all_of(std::begin(normals), std::end(normals),
                           [&](const glm::dvec3& normal) { return sign * glm::dot(normal, across) >= least; });
    };
    Bend bend;
    if (!(least > 0.0) || !(isNear(1.0) || isNear(-1.0))) return bend;
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        const glm::dvec3 change = normals[next] - normals[i];
        const double turn = glm::length(change);
        if (!(turn > leastTurn)) continue;
        bend.offset = std::max(bend.offset, std::abs(glm::dot(at[next] - at[i], change)) / turn);
        bend.turn = std::max(bend.turn, turn);
    }
    return bend;
}

glm::dvec3 unit(const glm::vec3& v) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0.0 && std::isfinite(length) ? glm::dvec3(v) / length : glm::dvec3(0.0);
}

} // namespace

std::vector<glm::vec4> terminatorOffsets(const std::vector<glm::dvec3>& positions,
                                         const std::vector<glm::vec3>& normals, const std::vector<unsigned>& corners) {
    std::vector<Bend> bends;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        const unsigned* of = corners.data() + i;
        const Bend bend = bendOf({positions[of[0]], positions[of[1]], positions[of[2]]},
                                 {unit(normals[of[0]]), unit(normals[of[1]]), unit(normals[of[2]])});
        if (!(bend.offset > 0.0)) continue;
        bends.resize(positions.size());
        for (int corner = 0; corner < 3; ++corner) {
            Bend& all = bends[of[corner]];
            all = {std::max(all.offset, bend.offset), std::max(all.turn, bend.turn)};
        }
    }
    if (bends.empty()) return {};
    const std::vector<unsigned> first = weld(positions.data(), positions.size());
    std::vector<unsigned> source(first); // at each place, of the largest offset
    for (unsigned i = 0; i < first.size(); ++i) {
        const Bend& bend = bends[i];
        if (bend.offset > bends[source[first[i]]].offset) source[first[i]] = i;
    }
    std::vector<glm::vec4> offsets(positions.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        const Bend& bend = bends[source[first[i]]];
        if (bend.offset > 0.0)
            offsets[i] = glm::vec4(glm::vec3(unit(normals[source[first[i]]]) / bend.turn), float(bend.offset));
    }
    return offsets;
}

} // namespace gnomon
