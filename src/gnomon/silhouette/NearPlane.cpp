// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/silhouette/NearPlane.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

using Corners = std::array<glm::dvec3, 4>;

/// True if all corners are on the side of a plane through `about` to which `normal` points; with `by`, clearly.
bool areBeyond(const Corners& corners, const glm::dvec3& normal, const glm::dvec3& about) {
    const double least = 1e-9 * glm::length(normal);
    return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& corner) {
        return glm::dot(normal, corner - about) > least * glm::length(corner - about);
    });
}

/// The part's bounds from the light on, in axes along the way of the light, against the near plane's.
bool areApart(const NearPlane& near, const SilhouetteMesh::Part& part, const glm::dvec4& sun) {
    const glm::dvec3 along(sun);
    const glm::dvec3 any = std::abs(along.z) < 0.7 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(any, along)), v = glm::cross(along, u);
    const glm::dvec3 middle = (glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0,
                     half = glm::dvec3(part.high) - middle;
    for (const glm::dvec3& axis : {u, v, along}) {
        const double reach = glm::dot(glm::abs(axis), half) * (1.0 + 1e-6);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const glm::dvec3& corner : near.corners) {
            const double at = glm::dot(corner - middle, axis);
            low = std::min(low, at);
            high = std::max(high, at);
        }
        if (low > reach || (high < -reach && axis != along)) return true;
    }
    return false;
}

/// The cone behind the part's sphere, against the near plane's sphere.
bool areApartFromLamp(const NearPlane& near, const SilhouetteMesh::Part& part, const glm::dvec3& lamp) {
    const glm::dvec3 middle = (glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0,
                     nearMiddle = (near.low + near.high) / 2.0;
    const double radius = glm::distance(middle, glm::dvec3(part.high)) * (1.0 + 1e-6),
                 nearRadius = glm::distance(nearMiddle, near.high);
    const double away = glm::distance(lamp, middle), nearAway = glm::distance(lamp, nearMiddle);
    if (!(away > radius && nearAway > nearRadius)) return false;
    if (nearAway + nearRadius < away - radius) return true;
    const double cosine = glm::dot(middle - lamp, nearMiddle - lamp) / (away * nearAway);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) > std::asin(radius / away) + std::asin(nearRadius / nearAway);
}

/// Whether the side behind an edge may cut the near plane.
bool mayCut(const Corners& corners, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec4& light) {
    const glm::dvec3 awayA = awayFrom(light, a), awayB = awayFrom(light, b);
    const glm::dvec3 normal = glm::cross(b - a, awayA);
    if (areBeyond(corners, normal, a) || areBeyond(corners, -normal, a)) return false;
    const glm::dvec3 before = glm::cross(awayA, normal), after = glm::cross(normal, awayB); // point away from the side
    const double turn = glm::dot(before, b - a) > 0.0 ? -1.0 : 1.0;
    if (areBeyond(corners, turn * before, a) || areBeyond(corners, turn * after, b)) return false;
    const glm::dvec3 start = glm::cross(normal, b - a);
    return !areBeyond(corners, glm::dot(start, awayA) > 0.0 ? -start : start, a);
}

struct Triangle {
    glm::dvec3 a, b, c, normal;
};

Triangle triangleOf(const SilhouetteMesh& mesh, std::size_t i) {
    const unsigned* of = mesh.corners.data() + 3 * i;
    return {glm::dvec3(mesh.vertices[of[0]]),
            glm::dvec3(mesh.vertices[of[1]]),
            glm::dvec3(mesh.vertices[of[2]]),
            {mesh.planeX[i], mesh.planeY[i], mesh.planeZ[i]}};
}

bool mayCut(const Corners& corners, const Triangle& t) {
    if (areBeyond(corners, t.normal, t.a) || areBeyond(corners, -t.normal, t.a)) return false;
    return !areBeyond(corners, glm::cross(t.b - t.a, t.normal), t.a) &&
           !areBeyond(corners, glm::cross(t.c - t.b, t.normal), t.b) &&
           !areBeyond(corners, glm::cross(t.a - t.c, t.normal), t.c);
}

/// 1 or -1: on which side of the plane through an edge and the light a place is; 0 if that is not certain.
int sideOf(const glm::dvec3& place, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec4& light) {
    const glm::dvec3 normal = glm::cross(b - a, awayFrom(light, a)), to = place - a;
    const double side = glm::dot(normal, to), least = 1e-9 * glm::length(normal) * glm::length(to);
    return side > least ? 1 : side < -least ? -1 : 0;
}

/// Whether a triangle is between the light and a place.
std::optional<bool> hides(const Triangle& t, int weight, const glm::dvec3& place, const glm::dvec4& light) {
    if (glm::dot(t.normal, place - t.a) * weight > 0.0) return false; // the light's side
    const int ab = sideOf(place, t.a, t.b, light), bc = sideOf(place, t.b, t.c, light),
              ca = sideOf(place, t.c, t.a, light);
    if (ab * bc < 0 || bc * ca < 0 || ca * ab < 0) return false;
    if (ab == 0 || bc == 0 || ca == 0) return std::nullopt;
    return true;
}

} // namespace

NearPlane::NearPlane(const glm::dmat4& clipFromMesh) {
    const glm::dmat4 meshFromClip = glm::inverse(clipFromMesh);
    for (unsigned i = 0; i < 4; ++i) {
        const glm::dvec4 corner = meshFromClip * glm::dvec4(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, -1.0, 1.0);
        corners[i] = glm::dvec3(corner) / corner.w;
        low = i ? glm::min(low, corners[i]) : corners[i];
        high = i ? glm::max(high, corners[i]) : corners[i];
    }
}

std::optional<int> volumesHolding(const NearPlane& near, const SilhouetteMesh& mesh, const ShadowVolumes& volumes,
                                  std::size_t index) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    const ShadowVolumes::Part& volume = volumes.parts[index];
    const glm::dvec4& light = volumes.light;
    const bool ends = volume.end != glm::dvec4(0.0);
    if (ends && std::any_of(near.corners.begin(), near.corners.end(),
                            [&](const glm::dvec3& corner) { return !(distance(volume.end, corner) > 0.0); }))
        return std::nullopt; // the end may be seen from below
    if (light.w == 0.0 ? areApart(near, part, light) : areApartFromLamp(near, part, glm::dvec3(light))) return 0;
    for (unsigned i = volume.firstEdge; i < volume.firstEdge + volume.edges; ++i) {
        const ShadowVolumes::Outline& edge = volumes.outline[i];
        if (mayCut(near.corners, glm::dvec3(mesh.vertices[edge.from]), glm::dvec3(mesh.vertices[edge.to]), light))
            return std::nullopt;
    }
    int count = 0;
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        const int weight = volumes.weights[i];
        if (weight == 0) continue;
        const Triangle triangle = triangleOf(mesh, i);
        const std::optional<bool> hidden = hides(triangle, weight, near.corners[0], light);
        if (!hidden || mayCut(near.corners, triangle)) return std::nullopt;
        count += *hidden;
    }
    return count;
}

} // namespace gnomon
