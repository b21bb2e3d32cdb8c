// SPDX-License-Identifier: MIT
#include <gnomon/PlanarShadow.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace gnomon {
namespace {

constexpr double lowestSun = 1e-4;       // sine of the elevation
constexpr double belowLampMargin = 1e-3; // of the lamp's height

/// The same light with |L| = 1 and w >= 0: L and -L are one point, but only one of them is in front of the plane.
glm::dvec4 unitLight(const glm::dvec4& light) {
    const double length = std::hypot(std::hypot(light.x, light.y, light.z), light.w);
    return (light.w < 0.0 ? -light : light) / length;
}

/// What P·L must exceed for a shadow to exist.
double threshold(const glm::dvec4& plane, const glm::dvec4& unit) {
    if (unit.w == 0.0) return lowestSun;
    // Four products of rounded factors, added: their error, twice over.
    return 8.0 * std::numeric_limits<double>::epsilon() * (1.0 + std::abs(plane.w * unit.w));
}

bool isFinite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

} // namespace

std::optional<glm::dmat4> planarShadowMatrix(const glm::dvec4& plane, const glm::dvec4& light) {
    const glm::dvec4 unit = unitLight(light);
    const double height = glm::dot(plane, unit);
    if (!(height > threshold(plane, unit))) return std::nullopt;
    const glm::dmat4 matrix = glm::dmat4(height) - glm::outerProduct(unit, plane);
    return isFinite(matrix) ? std::optional(matrix) : std::nullopt;
}

PlanarClipPlanes planarClipPlanes(const glm::dvec4& plane, const glm::dvec4& light) {
    // s = P·L is w times the light's height, so s (1 - margin) - w (P·v) >= 0 needs no division by w.
    const glm::dvec4 unit = unitLight(light);
    const double height = glm::dot(plane, unit);
    return {plane, glm::dvec4(0.0, 0.0, 0.0, height * (1.0 - belowLampMargin)) - unit.w * plane};
}

} // namespace gnomon
