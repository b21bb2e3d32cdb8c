// SPDX-License-Identifier: MIT
#include <gnomon/geometry/NearWeld.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace gnomon {
namespace {

/// Cells of a grid by what they hold; a cell is several times as wide as what counts as one place.
class Cells {
public:
    Cells(const std::vector<glm::dvec3>& points, double reach) : _points(points), _reach(reach) {}

    /// The first of those asked for that is about a point; itself if there is none.
    unsigned placeOf(unsigned i) {
        const glm::dvec3 &p = _points[i], first = cell(p - _reach), last = cell(p + _reach);
        for (double x = first.x; x <= last.x; ++x)
            for (double y = first.y; y <= last.y; ++y)
                for (double z = first.z; z <= last.z; ++z)
                    if (const auto found = findIn({x, y, z}, p)) return *found;
        _places.emplace(keyOf(cell(p)), i);
        return i;
    }

private:
    glm::dvec3 cell(const glm::dvec3& place) const { return glm::floor(place / (16.0 * _reach)); }
    std::optional<unsigned> findIn(const glm::dvec3& cell, const glm::dvec3& place) const {
        const auto [begin, end] = _places.equal_range(keyOf(cell));
        for (auto at = begin; at != end; ++at)
            if (glm::distance(_points[at->second], place) <= _reach) return at->second;
        return std::nullopt;
    }
    static std::uint64_t keyOf(const glm::dvec3& cell) {
        const auto whole = [](double number) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(number)); };
        return (whole(cell.x) * 73856093u) ^ (whole(cell.y) * 19349663u) ^ (whole(cell.z) * 83492791u);
    }

    const std::vector<glm::dvec3>& _points;
    const double _reach;
    std::unordered_multimap<std::uint64_t, unsigned> _places;
};

/// What float can tell apart, some steps of it, where most of these are.
double roundingOf(const std::vector<glm::dvec3>& places) {
    std::vector<double> reaches;
    for (const glm::dvec3& place : places)
        reaches.push_back(std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}));
    const auto middle = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() / 2);
    std::nth_element(reaches.begin(), middle, reaches.end());
    return 4.0 * std::numeric_limits<float>::epsilon() * *middle;
}

} // namespace

std::vector<unsigned> nearlyTheSame(const std::vector<glm::dvec3>& points, double reach) {
    std::vector<unsigned> result;
    if (!(reach > 0.0)) {
        result.resize(points.size());
        std::iota(result.begin(), result.end(), 0u);
        return result;
    }
    Cells cells(points, reach);
    for (unsigned i = 0; i < points.size(); ++i) result.push_back(cells.placeOf(i));
    return result;
}

std::vector<unsigned> withoutSeams(const std::vector<unsigned>& ends, const glm::vec3* positions,
                                   std::size_t vertexCount) {
    if (ends.empty()) return {};
    std::vector<glm::dvec3> points;
    for (const unsigned end : ends) points.emplace_back(positions[end]);
    const std::vector<unsigned> same = nearlyTheSame(points, roundingOf(points));
    std::vector<unsigned> first(vertexCount);
    std::iota(first.begin(), first.end(), 0u);
    bool any = false;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        first[ends[i]] = ends[same[i]];
        any = any || same[i] != i;
    }
    return any ? first : std::vector<unsigned>();
}

} // namespace gnomon
