// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/volume/OpenCasters.h>

#include <glm/common.hpp>

#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>

namespace gnomon {
namespace {

constexpr unsigned keptRounds = 16; // views of different levels of detail take turns

/// Two numbers that stand for a place. -0 is 0.
struct PlaceKeys {
    explicit PlaceKeys(const glm::vec3& place) {
        Fingerprint key;
        for (int axis = 0; axis < 3; ++axis) key.mix(double(place[axis] + 0.0f));
        first = key.value();
        key.mix(std::uint64_t{1});
        second = key.value();
    }
    std::uint64_t first, second;
};

/// Corners of a drawable's triangles, in a mesh.
struct Share {
    const unsigned *begin, *end;
};

std::vector<Share> sharesOf(const CasterMesh& mesh) {
    const unsigned* corners = &mesh.triangles->front();
    std::vector<Share> shares{{corners, corners}};
    for (const CasterExtraction::Drawn& drawn : mesh.drawn) {
        shares.back().end = corners + drawn.first;
        shares.push_back({corners + drawn.first, nullptr});
    }
    shares.back().end = corners + mesh.triangles->size();
    return shares;
}

/// True if each edge is passed as often one way as the other: what an edge adds changes its sign with the way.
bool isClosed(const Share& share, const std::vector<PlaceKeys>& keys) {
    std::uint64_t sum = 0;
    for (const unsigned* triangle = share.begin; triangle != share.end; triangle += 3)
        for (int side = 0; side < 3; ++side) {
            const PlaceKeys &from = keys[triangle[side]], &to = keys[triangle[(side + 1) % 3]];
            sum += from.first * to.second - to.first * from.second;
        }
    return sum == 0;
}

DrawnCasters::Drawable drawableOf(const Share& share, const glm::vec3* positions) {
    DrawnCasters::Drawable result{glm::vec3(std::numeric_limits<float>::infinity()), {}, 0};
    result.high = -result.low;
    for (const unsigned* corner = share.begin; corner != share.end; ++corner) {
        result.low = glm::min(result.low, positions[*corner]);
        result.high = glm::max(result.high, positions[*corner]);
    }
    result.triangles = static_cast<std::size_t>(share.end - share.begin) / 3;
    return result;
}

/// @param places  three a triangle.
std::shared_ptr<const SilhouetteMesh> edgesOf(const std::vector<glm::vec3>& places) {
    if (places.empty() || places.size() > 3 * OpenCasters::mostTriangles) return nullptr;
    std::vector<unsigned> corners(places.size());
    std::iota(corners.begin(), corners.end(), 0u);
    return std::make_shared<const SilhouetteMesh>(places.data(), places.size(), corners.data(), corners.size());
}

DrawnCasters find(const CasterMesh& mesh) {
    DrawnCasters result;
    if (mesh.empty()) return result;
    const glm::vec3* positions = positionsOf(mesh);
    const std::vector<PlaceKeys> keys(positions, positions + mesh.vertices->size());
    std::vector<glm::vec3> places; // of the open ones
    for (const Share& share : sharesOf(mesh)) {
        if (share.begin == share.end) continue;
        const bool closed = isClosed(share, keys);
        (closed ? result.closed : result.open).push_back(drawableOf(share, positions));
        for (const unsigned* corner = share.begin; !closed && corner != share.end; ++corner)
            places.push_back(positions[*corner]);
    }
    result.openEdges = edgesOf(places);
    return result;
}

} // namespace

std::size_t DrawnCasters::openTriangles() const {
    std::size_t sum = 0;
    for (const Drawable& each : open) sum += each.triangles;
    return sum;
}

void OpenCasters::startRound() {
    ++_round;
    for (auto entry = _entries.begin(); entry != _entries.end();) {
        const bool isOld = _round - entry->second.used > keptRounds || !entry->second.mesh.valid();
        entry = isOld ? _entries.erase(entry) : std::next(entry);
    }
}

DrawnCasters& OpenCasters::of(const CasterMesh& mesh) {
    Entry& entry = _entries[&mesh];
    if (!entry.mesh.valid()) entry = {&mesh, find(mesh), 0};
    entry.used = _round;
    return entry.drawn;
}

} // namespace gnomon
