// SPDX-License-Identifier: MIT
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <metrics/BoundaryDistance.h>
#include <metrics/Flicker.h>
#include <metrics/PixelSets.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gnomon::metrics {
namespace {

constexpr int reach = 2;              // px: of the slope
constexpr double sumOfSquares = 50.0; // sum of i² over the 5 x 5 pixels
constexpr double leastLength = 1.0;   // px; shorter edges are a pixel's chance

/// The slope of T_a. Its length summed over pixels is the length of the edges.
glm::dvec2 slopeOf(const TruthMaps& truth, const Mask& facing, int x, int y) {
    glm::dvec2 slope(0.0);
    const double here = truth.lit.at(x, y);
    for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
            if (facing.holds(x + i, y + j) && facing.at(x + i, y + j) &&
                truth.receiver.at(x + i, y + j) == truth.receiver.at(x, y))
                slope += (truth.lit.at(x + i, y + j) - here) * glm::dvec2(i, j);
    return slope / sumOfSquares;
}

constexpr double flickering = 0.25;
constexpr double onCentre = 1e-6; // px: rounding of a reprojection; such a place is its pixel's centre

/// Where a pixel was one frame before: up to four pixels and their weights.
struct Fetch {
    std::array<std::size_t, 4> pixel{};
    std::array<double, 4> weight{};
    bool known = false;

    template <typename T>
    double of(const Grid<T>& grid) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < 4; ++i)
            if (weight[i] > 0.0) sum += weight[i] * static_cast<double>(grid.cells[pixel[i]]);
        return sum;
    }
};

/// In px, with pixel centres at whole numbers; NaN behind the eye.
glm::dvec2 placeIn(const FlickerFrame& frame, const glm::dvec3& position) {
    const glm::dvec4 clip = frame.clipFromPosition * glm::dvec4(position, 1.0);
    if (!(clip.w > 0.0)) return glm::dvec2(std::nan(""));
    const glm::dvec2 size(frame.facing.width, frame.facing.height);
    glm::dvec2 place = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size - 0.5;
    for (int axis = 0; axis < 2; ++axis)
        if (std::abs(place[axis] - std::round(place[axis])) < onCentre) place[axis] = std::round(place[axis]);
    return place;
}

bool isInside(const glm::dvec2& place, const Mask& mask) {
    return place.x >= 0.0 && place.y >= 0.0 && place.x <= mask.width - 1 && place.y <= mask.height - 1;
}

bool isUndecided(const TruthMaps& truth, std::size_t pixel) {
    return !truth.undecided.empty() && truth.undecided.cells[pixel];
}

/// Adds one of the four pixels; false if it is not the same surface, or undecided.
bool addPixel(const FlickerFrame& last, int receiver, int x, int y, double weight, std::size_t slot, Fetch& fetch) {
    if (!(weight > 0.0)) return true;
    fetch.pixel[slot] =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(last.facing.width) + static_cast<std::size_t>(x);
    fetch.weight[slot] = weight;
    return last.facing.cells[fetch.pixel[slot]] && last.truth.receiver.cells[fetch.pixel[slot]] == receiver &&
           !isUndecided(last.truth, fetch.pixel[slot]);
}

Fetch fetchFrom(const FlickerFrame& last, const FlickerFrame& frame, std::size_t pixel) {
    Fetch fetch;
    const glm::dvec2 place = placeIn(last, frame.truth.position.cells[pixel]);
    if (!isInside(place, last.facing)) return fetch;
    const int x = static_cast<int>(place.x), y = static_cast<int>(place.y);
    const double fx = place.x - x, fy = place.y - y;
    const int id = frame.truth.receiver.cells[pixel];
    fetch.known = addPixel(last, id, x, y, (1 - fx) * (1 - fy), 0, fetch) &&
                  addPixel(last, id, x + 1, y, fx * (1 - fy), 1, fetch) &&
                  addPixel(last, id, x, y + 1, (1 - fx) * fy, 2, fetch) &&
                  addPixel(last, id, x + 1, y + 1, fx * fy, 3, fetch);
    return fetch;
}

/// |V_k(p) - V_{k-1}(p')|, negative where p' is not known, and how the truth changed there.
struct Changes {
    Picture shown, truth;
};

Changes changesBetween(const FlickerFrame& last, const FlickerFrame& frame) {
    Changes changes{Picture(frame.facing.width, frame.facing.height, -1.0),
                    Picture(frame.facing.width, frame.facing.height)};
    for (std::size_t i = 0; i < frame.facing.cells.size(); ++i) {
        const bool counts = frame.facing.cells[i] && !isUndecided(frame.truth, i);
        const Fetch fetch = counts ? fetchFrom(last, frame, i) : Fetch();
        if (!fetch.known) continue;
        changes.shown.cells[i] = std::abs(frame.visibility.cells[i] - fetch.of(last.visibility));
        changes.truth.cells[i] = std::max(std::abs(frame.truth.lit.cells[i] - fetch.of(last.truth.lit)),
                                          std::abs(frame.truth.litCentre.cells[i] - fetch.of(last.truth.litCentre)));
    }
    return changes;
}

double greatestAround(const Picture& picture, int x, int y) {
    double greatest = 0.0;
    for (int ny = y - 1; ny <= y + 1; ++ny)
        for (int nx = x - 1; nx <= x + 1; ++nx)
            if (picture.holds(nx, ny)) greatest = std::max(greatest, picture.at(nx, ny));
    return greatest;
}

std::optional<double> ratio(double part, std::size_t whole) {
    return whole ? std::optional(part / static_cast<double>(whole)) : std::nullopt;
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

void FlickerMeter::compare(const FlickerFrame& frame) {
    const Changes changes = changesBetween(_last, frame);
    Picture beyond(frame.facing.width, frame.facing.height);
    double sum = 0.0;
    for (int y = 0; y < frame.facing.height; ++y)
        for (int x = 0; x < frame.facing.width; ++x) {
            if (changes.shown.at(x, y) < 0.0) continue;
            const double e = std::max(0.0, changes.shown.at(x, y) - greatestAround(changes.truth, x, y));
            ++_known;
            sum += beyond.at(x, y) = e;
            _flickering += e > flickering;
        }
    _sum += sum;
    if (sum > _worstSum) {
        _worstSum = sum;
        _worst = {_last.visibility, frame.visibility, std::move(beyond)};
    }
    _facing += count(frame.facing);
}

void FlickerMeter::add(FlickerFrame frame) {
    if (_frames > 0) compare(frame);
    ++_frames;
    const std::optional<BoundaryDistance> boundary = boundaryDistance(frame.visibility, frame.truth.lit, frame.facing);
    if (boundary) _offsets.push_back(boundary->signedMean);
    _edges.add(frame.visibility, frame.truth, frame.facing);
    _last = std::move(frame);
}

std::optional<double> FlickerMeter::energy() const { return ratio(_sum, _known); }
std::optional<double> FlickerMeter::share() const { return ratio(static_cast<double>(_flickering), _facing); }

std::optional<double> FlickerMeter::crawl() const {
    if (_offsets.size() < 2) return std::nullopt;
    const double size = static_cast<double>(_offsets.size());
    double mean = 0.0, squares = 0.0;
    for (const double offset : _offsets) mean += offset / size;
    for (const double offset : _offsets) squares += (offset - mean) * (offset - mean);
    return std::sqrt(squares / size);
}

} // namespace gnomon::metrics
