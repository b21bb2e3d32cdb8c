// SPDX-License-Identifier: MIT
#include <gnomon/geometry/DrawnError.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace gnomon {
namespace {

constexpr double cuts = 2.0 / (1 << 24); // of a polygon's side: what its cut at the near plane loses
constexpr double products = 8.0;         // of a matrix times a vector, in the vector's own rounding

} // namespace

DrawnError drawnError(const glm::dmat4& clipFromScene, double width, double rounding, double longestSide) {
    const auto scale = [&](int row) { return glm::length(glm::dvec3(glm::row(clipFromScene, row))); };
    const double off = cuts * longestSide + products * rounding;
    return {0.5 * off * (scale(2) + scale(3)), 0.5 * off * width * (scale(0) + scale(3))};
}

} // namespace gnomon
