// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

namespace gnomon {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double norm(const glm::dvec3& v) { return std::hypot(v.x, v.y, v.z); } // no overflow on the way, unlike sqrt(v·v)

double largest(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    return glm::max(size.x, glm::max(size.y, size.z));
}

bool isFinite(const glm::dvec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// The power of two at or below `size`: dividing by it rounds nothing. 1 for 0 and for what is not finite.
double powerOfTwoIn(double size) { return size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, std::ilogb(size)) : 1.0; }

/// det(A) A^{-T}, for the matrix A of these columns.
glm::dmat3 cofactors(const glm::dmat3& a) {
    return {glm::cross(a[1], a[2]), glm::cross(a[2], a[0]), glm::cross(a[0], a[1])};
}

} // namespace

std::optional<glm::dvec4> planeFromPoints(const glm::dvec3& p1, const glm::dvec3& p2, const glm::dvec3& p3) {
    const double size = glm::max(largest(p1), glm::max(largest(p2), largest(p3)));
    const double unit = powerOfTwoIn(size);
    const glm::dvec3 edge12 = p2 / unit - p1 / unit;
    const glm::dvec3 edge23 = p3 / unit - p2 / unit;
    const glm::dvec3 normal = glm::cross(edge12, edge23);
    // Each edge is known to an ulp of the largest coordinate (size / unit < 2), which moves the cross product by that
    // times the other edge.
    const double rounding = 8.0 * epsilon * (norm(edge12) + norm(edge23));
    if (!(norm(normal) > rounding)) return std::nullopt;
    const glm::dvec3 n = normal / norm(normal);
    const glm::dvec4 plane(n, -glm::dot(n, p3));
    return isFinite(plane) ? std::optional(plane) : std::nullopt;
}

std::optional<glm::dvec4> normalizedPlane(const glm::dvec4& plane) {
    const glm::dvec4 normalized = plane / norm(glm::dvec3(plane));
    return isFinite(normalized) ? std::optional(normalized) : std::nullopt;
}

double distance(const glm::dvec4& plane, const glm::dvec3& point) {
    return glm::dot(glm::dvec3(plane), point) + plane.w;
}

std::optional<glm::dvec4> transformedPlane(const glm::dmat4& targetFromSource, const glm::dvec4& plane) {
    // A plane is a covector: its normal goes by A^{-T}. Columns of unit length first, so that the determinant measures
    // how far the axes are from lying in one plane, whatever the scales.
    glm::dmat3 axes(targetFromSource);
    glm::dvec3 normal(plane);
    for (int i = 0; i < 3; ++i) {
        const double scale = norm(axes[i]);
        axes[i] /= scale;
        normal[i] /= scale;
    }
    const double determinant = glm::dot(axes[0], glm::cross(axes[1], axes[2]));
    if (!(std::abs(determinant) > 8.0 * epsilon)) return std::nullopt; // rounding of a triple product of unit vectors
    const glm::dvec3 turned = cofactors(axes) * normal / determinant;
    return normalizedPlane({turned, plane.w - glm::dot(turned, glm::dvec3(targetFromSource[3]))});
}

} // namespace gnomon
