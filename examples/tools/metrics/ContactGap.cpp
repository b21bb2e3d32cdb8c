// SPDX-License-Identifier: MIT
#include <metrics/Components.h>
#include <metrics/ContactGap.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace gnomon::metrics {
namespace {

using glm::dvec3;

/// Area and breadth of one gap.
struct Extent {
    double area = 0.0; ///< m²
    double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// How far the surface goes from one pixel to the next along (dx, dy): towards a neighbour of the same receiver.
dvec3 stepOf(const TruthMaps& truth, int x, int y, int dx, int dy) {
    for (const int sign : {1, -1}) {
        const int nx = x + sign * dx, ny = y + sign * dy;
        if (truth.receiver.holds(nx, ny) && truth.receiver.at(nx, ny) == truth.receiver.at(x, y))
            return static_cast<double>(sign) * (truth.position.at(nx, ny) - truth.position.at(x, y));
    }
    return dvec3(0.0);
}

void addPixel(const TruthMaps& truth, const dvec3& across, int x, int y, Extent& extent) {
    const dvec3 right = stepOf(truth, x, y, 1, 0), upwards = stepOf(truth, x, y, 0, 1);
    const double half = 0.5 * (std::abs(glm::dot(right, across)) + std::abs(glm::dot(upwards, across)));
    const double place = glm::dot(truth.position.at(x, y), across);
    extent.area += std::abs(glm::dot(glm::cross(right, upwards), truth.up));
    extent.low = std::min(extent.low, place - half);
    extent.high = std::max(extent.high, place + half);
}

std::vector<Extent> extentsOf(const Mask& gaps, const TruthMaps& truth, const dvec3& across) {
    const Components parts = components(gaps);
    std::vector<Extent> extents(static_cast<std::size_t>(parts.count));
    for (int y = 0; y < gaps.height; ++y)
        for (int x = 0; x < gaps.width; ++x)
            if (gaps.at(x, y)) addPixel(truth, across, x, y, extents[static_cast<std::size_t>(parts.part.at(x, y))]);
    return extents;
}

} // namespace

std::optional<double> contactGap(const Mask& peterPanning, const TruthMaps& truth) {
    const dvec3 sideways = glm::cross(truth.up, truth.towardsLight);
    if (truth.position.empty() || !(glm::length(sideways) > 0.0)) return std::nullopt;
    double area = 0.0, breadth = 0.0;
    for (const Extent& extent : extentsOf(peterPanning, truth, glm::normalize(sideways))) {
        area += extent.area;
        breadth += extent.high - extent.low;
    }
    return breadth > 0.0 ? std::optional(area / breadth) : std::nullopt;
}

} // namespace gnomon::metrics
