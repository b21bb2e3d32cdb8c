// SPDX-License-Identifier: MIT
#include <gnomon/geometry/DrawnError.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

constexpr double cuts = 2.0 / (1 << 24);     // of a polygon's side: what its cut at the near plane loses
constexpr double products = 8.0;             // of a matrix times a vector, in the vector's own rounding
constexpr double matrices = 1.0 / (1 << 24); // of the terms of a product of two matrices

} // namespace

DrawnError drawnError(const glm::dmat4& clipFromScene, const glm::dmat4& projection, double width, double rounding,
                      double longestSide) {
    const glm::dvec4 origin = glm::abs(glm::inverse(projection) * clipFromScene[3]); // of the scene, from the eye
    const double off = cuts * longestSide + products * rounding;
    const auto lost = [&](int row) {
        return off * glm::length(glm::dvec3(glm::row(clipFromScene, row))) +
               matrices * glm::dot(glm::abs(glm::row(projection, row)), origin);
    };
    return {0.5 * (lost(2) + lost(3)), 0.5 * width * (lost(0) + lost(3))};
}

} // namespace gnomon
