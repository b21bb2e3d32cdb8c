// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace gnomon {

/// True if a matrix places a body: affine, finite, and not so flat that floats could not invert it. False for NaN too.
inline bool isPlacement(const glm::dmat4& matrix) {
    constexpr double flattest = 1e-4; // of the volume that the axes would span at right angles
    const glm::dmat3 axes(matrix);
    const double box = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    const glm::dvec3 offset(matrix[3]);
    return matrix[0][3] == 0.0 && matrix[1][3] == 0.0 && matrix[2][3] == 0.0 && matrix[3][3] == 1.0 && box > 0.0 &&
           std::abs(glm::determinant(axes)) >= flattest * box && std::isfinite(box) &&
           std::isfinite(offset.x + offset.y + offset.z);
}

/// The most by which a matrix lengthens anything; at most twice that of one whose axes are not at right angles.
inline double stretch(const glm::dmat4& matrix) {
    const glm::dmat3 axes(matrix);
    const double a = glm::dot(axes[0], axes[0]), b = glm::dot(axes[1], axes[1]), c = glm::dot(axes[2], axes[2]);
    const double most = std::max({a, b, c});
    const double skew = std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                                  std::abs(glm::dot(axes[2], axes[0]))});
    return std::sqrt(skew <= 1e-9 * most ? most : a + b + c);
}

} // namespace gnomon
