// SPDX-License-Identifier: MIT
#include <metrics/Confusion.h>
#include <metrics/EdgeCrawl.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace gnomon::metrics {
namespace {

constexpr int reach = 2;            // px: of the slope
constexpr double squares = 50.0;    // sum of i² over the 5 x 5 pixels
constexpr double leastLength = 1.0; // px; shorter edges are a pixel's chance

/// The slope of T_a. Its length summed over pixels is the length of the edges.
glm::dvec2 slopeOf(const TruthMaps& truth, const Mask& facing, int x, int y) {
    glm::dvec2 slope(0.0);
    const double here = truth.lit.at(x, y);
    for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
            if (facing.holds(x + i, y + j) && facing.at(x + i, y + j) &&
                truth.receiver.at(x + i, y + j) == truth.receiver.at(x, y))
                slope += (truth.lit.at(x + i, y + j) - here) * glm::dvec2(i, j);
    return slope / squares;
}

} // namespace

void EdgeCrawl::add(const Picture& visibility, const TruthMaps& truth, const Mask& facing) {
    Frame frame;
    for (int y = 0; y < facing.height; ++y)
        for (int x = 0; x < facing.width; ++x) {
            if (!facing.at(x, y) || (!truth.undecided.empty() && truth.undecided.at(x, y))) continue;
            const glm::dvec2 slope = slopeOf(truth, facing, x, y);
            if (slope == glm::dvec2(0.0)) continue;
            const std::size_t quarter = (slope.x > 0.0 ? 1u : 0u) + (slope.y > 0.0 ? 2u : 0u);
            const double lit = truth.lit.at(x, y);
            frame.length[quarter] += glm::length(slope);
            frame.drawn[quarter] += lit - (isShadowed(visibility.at(x, y)) ? 0.0 : 1.0);
            frame.rays[quarter] += lit - truth.litCentre.at(x, y);
        }
    const double length = std::accumulate(frame.length.begin(), frame.length.end(), 0.0);
    if (length >= leastLength) _frames.push_back(frame);
}

/// Of the offsets, px²: the mean over the quarters, weighted by their lengths.
template <typename AreaOf>
double EdgeCrawl::variance(AreaOf areaOf) const {
    double sum = 0.0, lengths = 0.0;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
        double length = 0.0, area = 0.0, squared = 0.0;
        for (const Frame& frame : _frames) {
            length += frame.length[quarter] / double(_frames.size());
            area += areaOf(frame, quarter) / double(_frames.size());
        }
        if (length < leastLength) continue;
        for (const Frame& frame : _frames)
            squared += std::pow(areaOf(frame, quarter) - area, 2) / double(_frames.size());
        sum += squared / length; // = length * squared / length²
        lengths += length;
    }
    return lengths > 0.0 ? sum / lengths : 0.0;
}

std::optional<double> EdgeCrawl::ofRays() const {
    if (_frames.size() < 2) return std::nullopt;
    return std::sqrt(variance([](const Frame& frame, std::size_t quarter) { return frame.rays[quarter]; }));
}

std::optional<double> EdgeCrawl::beyondRays() const {
    const std::optional<double> rays = ofRays();
    if (!rays) return std::nullopt;
    const double drawn = variance([](const Frame& frame, std::size_t quarter) { return frame.drawn[quarter]; });
    const double apart =
        variance([](const Frame& frame, std::size_t quarter) { return frame.drawn[quarter] - frame.rays[quarter]; });
    return std::sqrt(std::min(std::max(0.0, drawn - *rays * *rays), apart));
}

} // namespace gnomon::metrics
