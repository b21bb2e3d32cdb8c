// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/Plane.h>
#include <gnomon/auto/ConvexBodies.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/geometry/ConvexParts.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace gnomon {
namespace {

constexpr std::size_t mostTriangles = 4000; // of a drawable that is looked at: more would take 5 ms and more
constexpr double touching = 1e-6;           // of a body's size: so close counts as beside it

ConvexBody bodyOf(const ConvexHull& hull, const glm::dvec3& origin) {
    ConvexBody body;
    for (const glm::dvec3& vertex : hull.vertices) body.corners.push_back(vertex + origin);
    for (const ConvexHull::Face& face : hull.faces) {
        const glm::dvec4 plane(glm::dvec3(face.plane), face.plane.w - glm::dot(glm::dvec3(face.plane), origin));
        const auto same = [&](const glm::dvec4& other) { return glm::dvec3(other) == glm::dvec3(plane); };
        if (std::none_of(body.planes.begin(), body.planes.end(), same)) body.planes.push_back(plane);
    }
    return body;
}

/// For what is not known better.
ConvexBody boxOf(const osg::BoundingBoxd& bounds) {
    ConvexBody body;
    for (unsigned i = 0; i < 8; ++i) body.corners.push_back(toGlm(osg::Vec3d(bounds.corner(i))));
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            glm::dvec4 plane(0.0);
            plane[axis] = side;
            plane.w = -side * (side > 0.0 ? bounds._max : bounds._min)[axis];
            body.planes.push_back(plane);
        }
    return body;
}

DrawableBodies look(const CasterDrawable& piece) {
    DrawableBodies result;
    result.looked = piece.triangles <= mostTriangles && hasPart(OptionalPart::Terrain);
    if (result.looked) {
        const osg::ref_ptr<const CasterMesh> mesh = meshOf({&piece});
        const glm::vec3* positions = positionsOf(*mesh);
        const std::size_t corners = mesh->vertices->size();
        const unsigned* indices = mesh->triangles->empty() ? nullptr : &mesh->triangles->front();
        const std::size_t count = mesh->triangles->size();
        const std::vector<ConvexPart> parts = convexParts(positions, corners, indices, count);
        const auto bounds = [](const ConvexPart& part) { return part.front.has_value(); };
        result.convex = std::none_of(parts.begin(), parts.end(), bounds) &&
                        parts.size() == connectedPoints(positions, corners, indices, count).size();
        if (result.convex)
            for (const ConvexPart& part : parts) result.bodies.push_back(bodyOf(part.hull, toGlm(mesh->origin)));
    }
    result.convex = result.convex && result.looked;
    if (!result.convex) result.bodies = {boxOf(piece.bounds)};
    return result;
}

double sizeOf(const ConvexBody& body) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& corner : body.corners) low = glm::min(low, corner), high = glm::max(high, corner);
    return body.corners.empty() ? 0.0 : glm::distance(low, high);
}

/// True if all of the body is on the outer side of the plane, or in it.
bool isOutside(const ConvexBody& body, const glm::dvec4& plane, double tolerance) {
    return std::all_of(body.corners.begin(), body.corners.end(),
                       [&](const glm::dvec3& corner) { return distance(plane, corner) >= -tolerance; });
}

/// How far along a way a body reaches.
struct Reach {
    Reach(const ConvexBody& body, const glm::dvec3& way) {
        for (const glm::dvec3& corner : body.corners) {
            low = std::min(low, glm::dot(corner, way));
            high = std::max(high, glm::dot(corner, way));
        }
    }
    double low = std::numeric_limits<double>::infinity(), high = -low;
};

bool missSun(const ConvexBody& caster, const ConvexBody& body, const glm::dvec3& sun, double tolerance) {
    if (Reach(caster, sun).high <= Reach(body, sun).low + tolerance) return true; // all of it is behind the body
    const auto [u, v] = across(sun);
    for (const glm::dvec3& way : {u, v, (u + v) * std::sqrt(0.5), (u - v) * std::sqrt(0.5)}) {
        const Reach a(caster, way), b(body, way);
        if (a.high <= b.low + tolerance || b.high <= a.low + tolerance) return true;
    }
    return false;
}

} // namespace

const DrawableBodies& ConvexBodies::of(const CasterDrawable& piece) {
    const auto known = _known.find(&piece);
    return known != _known.end() ? known->second : _known.emplace(&piece, look(piece)).first->second;
}

void ConvexBodies::keepMostly(const CasterDrawables& casters) {
    constexpr std::size_t few = 64; // views of different levels of detail take turns
    if (_known.size() <= 2 * casters.list.size() + few) return;
    std::set<const CasterDrawable*> current;
    for (const auto& piece : casters.list) current.insert(piece.get());
    for (auto entry = _known.begin(); entry != _known.end();)
        entry = current.count(entry->first.get()) ? std::next(entry) : _known.erase(entry);
}

/// A plane between the two that the light is on the right side of tells that no ray meets both.
bool mayShadow(const ConvexBody& caster, const ConvexBody& body, const glm::dvec4& light) {
    const double tolerance = touching * std::max(sizeOf(caster), sizeOf(body));
    for (const glm::dvec4& plane : caster.planes)
        if (glm::dot(plane, light) >= 0.0 && isOutside(body, plane, tolerance)) return false;
    for (const glm::dvec4& plane : body.planes)
        if (glm::dot(plane, light) <= 0.0 && isOutside(caster, plane, tolerance)) return false;
    return light.w != 0.0 || !missSun(caster, body, glm::dvec3(light), tolerance);
}

} // namespace gnomon
