// SPDX-License-Identifier: MIT
#include <gnomon/geometry/NearWeld.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cstdint>
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

} // namespace gnomon
