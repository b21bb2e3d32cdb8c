// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/PackedParts.h>

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gnomon {

PackedParts::PackedParts(const std::vector<ConvexPart>& parts) {
    for (const ConvexPart& part : parts) add(part);
}

void PackedParts::add(const ConvexPart& part) {
    const ArrangedHull hull(part.hull, part.front ? &*part.front : nullptr);
    _kinds.push_back(kindOf(hull.topology));
    _anchors.push_back(hull.corners.front());
    for (std::size_t i = 1; i < hull.corners.size(); ++i) addOther(glm::vec3(hull.corners[i] - _anchors.back()));
    _ends.push_back(static_cast<unsigned>(_others.size()));
}

void PackedParts::add(const PackedParts& from, std::size_t part) {
    const std::vector<glm::vec3> others(from.others(part), from.others(part) + (from._ends[part] - from.begin(part)));
    const glm::dvec3 anchor = from._anchors[part];
    _kinds.push_back(kindOf(from._topologies[from._kinds[part]]));
    _anchors.push_back(anchor);
    for (const glm::vec3& corner : others) addOther(corner);
    _ends.push_back(static_cast<unsigned>(_others.size()));
}

void PackedParts::addOther(const glm::vec3& corner) {
    _others.push_back(corner);
    bound(corner);
}

void PackedParts::bound(const glm::vec3& corner) {
    _low = glm::min(_low, corner);
    _high = glm::max(_high, corner);
}

void PackedParts::makeRoom(std::size_t part, std::size_t corners) {
    const std::size_t had = _ends[part] - begin(part);
    const auto end = _others.begin() + std::ptrdiff_t(_ends[part]);
    if (corners > had) _others.insert(end, corners - had, glm::vec3(0.0f));
    if (corners < had) _others.erase(end - std::ptrdiff_t(had - corners), end);
    for (std::size_t i = part; i < size(); ++i) _ends[i] = unsigned(_ends[i] + corners - had);
}

void PackedParts::remove(std::size_t at) {
    const std::size_t last = size() - 1;
    const std::vector<glm::vec3> moved(others(last), others(last) + (_ends[last] - begin(last)));
    if (at != last) {
        makeRoom(at, moved.size());
        std::copy(moved.begin(), moved.end(), _others.begin() + begin(at));
        _anchors[at] = _anchors[last];
        _kinds[at] = _kinds[last];
    }
    makeRoom(last, 0);
    _anchors.pop_back();
    _ends.pop_back();
    _kinds.pop_back();
    _low = _high = glm::vec3(0.0f);
    for (const glm::vec3& corner : _others) bound(corner);
}

/// A caster that turns may hang together otherwise each time, by rounding.
std::uint16_t PackedParts::kindOf(std::shared_ptr<const HullTopology> topology) {
    const auto known = std::find(_topologies.begin(), _topologies.end(), topology);
    if (known != _topologies.end()) return std::uint16_t(known - _topologies.begin());
    if (_topologies.size() > 2 * size() + 16) forgetUnused();
    if (_topologies.size() > std::numeric_limits<std::uint16_t>::max())
        throw std::length_error("packed parts hold at most 65536 kinds.");
    _topologies.push_back(std::move(topology));
    return std::uint16_t(_topologies.size() - 1);
}

void PackedParts::forgetUnused() {
    std::vector<std::shared_ptr<const HullTopology>> used;
    for (std::uint16_t& kind : _kinds) {
        const auto known = std::find(used.begin(), used.end(), _topologies[kind]);
        if (known == used.end()) used.push_back(_topologies[kind]);
        kind = std::uint16_t(std::find(used.begin(), used.end(), _topologies[kind]) - used.begin());
    }
    _topologies = std::move(used);
}

std::size_t PackedParts::bytes() const {
    return _anchors.size() * sizeof(glm::dvec3) + _others.size() * sizeof(glm::vec3) + _ends.size() * sizeof(unsigned) +
           _kinds.size() * sizeof(std::uint16_t);
}

} // namespace gnomon
