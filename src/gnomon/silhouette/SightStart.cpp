// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/silhouette/SightStart.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// True if all points are on the side of a plane through `about` to which `normal` points.
bool areBeyond(const std::vector<glm::dvec3>& points, const glm::dvec3& normal, const glm::dvec3& about) {
    const double least = 1e-9 * glm::length(normal);
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
        return glm::dot(normal, point - about) > least * glm::length(point - about);
    });
}

/// Whether a sun's volume of the part's bounds is nowhere near the eye.
bool areApart(const glm::dvec3& eye, const SilhouetteMesh::Part& part, const glm::dvec3& sun) {
    const auto [u, v] = across(sun);
    const glm::dvec3 middle = (glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0, to = eye - middle;
    const glm::dvec3 half = (glm::dvec3(part.high) - middle) * (1.0 + 1e-6);
    const auto reach = [&half](const glm::dvec3& axis) { return glm::dot(glm::abs(axis), half); };
    return std::abs(glm::dot(to, u)) > reach(u) || std::abs(glm::dot(to, v)) > reach(v) ||
           glm::dot(to, sun) > reach(sun);
}

/// The same of a lamp's, behind the sphere about the part.
bool areApartFromLamp(const glm::dvec3& eye, const SilhouetteMesh::Part& part, const glm::dvec3& lamp) {
    const glm::dvec3 middle = (glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0, to = middle - lamp;
    const double radius = glm::distance(middle, glm::dvec3(part.high)) * (1.0 + 1e-6);
    const double away = glm::length(to), eyeAway = glm::distance(lamp, eye);
    if (!(away > radius && eyeAway > 0.0)) return false;
    if (eyeAway < away - radius) return true;
    const double cosine = glm::dot(to, eye - lamp) / (away * eyeAway);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) > std::asin(radius / away);
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

/// False if a plane is between them.
bool mayMeet(const std::vector<glm::dvec3>& body, const Triangle& t) {
    return !areBeyond(body, t.normal, t.a) && !areBeyond(body, -t.normal, t.a) &&
           !areBeyond(body, glm::cross(t.b - t.a, t.normal), t.a) &&
           !areBeyond(body, glm::cross(t.c - t.b, t.normal), t.b) &&
           !areBeyond(body, glm::cross(t.a - t.c, t.normal), t.c);
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

SightStart::SightStart(const glm::dmat4& clipFromMesh, const glm::dvec3& low, const glm::dvec3& high)
    : towardsEye(eyeIn(clipFromMesh)) {
    const glm::dmat4 meshFromClip = glm::inverse(clipFromMesh);
    for (unsigned i = 0; i < 4; ++i) {
        const glm::dvec4 corner = meshFromClip * glm::dvec4(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, -1.0, 1.0);
        cutAway.push_back(glm::dvec3(corner) / corner.w);
    }
    if (towardsEye.w != 0.0) {
        eye = glm::dvec3(towardsEye) / towardsEye.w;
        cutAway.push_back(eye);
        return;
    }
    const double far = 10.0 * (glm::distance(low, high) + glm::distance(cutAway[0], (low + high) / 2.0));
    const glm::dvec3 there = far * glm::normalize(glm::dvec3(towardsEye));
    for (unsigned i = 0; i < 4; ++i) cutAway.push_back(cutAway[i] + there);
    eye = (cutAway[4] + cutAway[7]) / 2.0;
}

std::optional<int> volumesHolding(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes,
                                  std::size_t index, bool mayBeCut) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    const glm::dvec4 &light = volumes.light, &end = volumes.parts[index].end;
    if (end != glm::dvec4(0.0) && !(glm::dot(end, start.towardsEye) > 0.0)) return std::nullopt;
    const bool apart = light.w == 0.0 ? areApart(start.eye, part, glm::dvec3(light))
                                      : areApartFromLamp(start.eye, part, glm::dvec3(light));
    if (apart && !mayBeCut) return 0;
    int count = 0;
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        const int weight = volumes.weights[i];
        if (weight == 0) continue;
        const Triangle triangle = triangleOf(mesh, i);
        if (mayBeCut && mayMeet(start.cutAway, triangle)) return std::nullopt;
        if (apart) continue;
        const std::optional<bool> hidden = hides(triangle, weight, start.eye, light);
        if (!hidden) return std::nullopt;
        count += *hidden;
    }
    return count;
}

bool mayShowBack(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index,
                 bool mayBeCut) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    const bool outside = part.closed && !mayBeCut && !part.boundsHold(start.eye);
    if (outside && (volumes.light.w == 0.0 || !part.boundsHold(glm::dvec3(volumes.light)))) return false;
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        if (outside && (volumes.weights[i] > 0) != part.inward) continue; // the light is outside of it, too
        const glm::dvec4 plane(mesh.planeX[i], mesh.planeY[i], mesh.planeZ[i], mesh.planeD[i]);
        if (volumes.weights[i] * glm::dot(plane, start.towardsEye) < 0.0) return true;
    }
    return false;
}

} // namespace gnomon
