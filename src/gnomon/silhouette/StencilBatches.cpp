// SPDX-License-Identifier: MIT
#include <gnomon/silhouette/StencilBatches.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon {
namespace {

/// What a tile adds to a round.
struct Load {
    std::size_t round;
    unsigned prisms;
};

struct Placed {
    std::size_t tile;
    std::vector<Load> loads;
};

/// A slice, and how many of its prisms hold one point at most.
struct Weighed {
    LayerSlice slice;
    unsigned prisms;
};

std::vector<Weighed> slicesOf(const PrismLayers& tile, std::size_t index, unsigned capacity) {
    if (tile.mostOver <= capacity) return {{{index, 0, tile.layers}, tile.mostOver}};
    std::vector<Weighed> slices;
    for (unsigned first = 0; first < tile.layers; first += capacity) {
        const unsigned count = std::min(capacity, tile.layers - first);
        slices.push_back({{index, first, count}, count});
    }
    return slices;
}

std::vector<std::size_t> fromTheLeft(const std::vector<PrismLayers>& tiles) {
    std::vector<std::size_t> order(tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return tiles[a].low.x < tiles[b].low.x; });
    return order;
}

/// The round's number in `loads` grows as needed.
std::size_t firstWithRoom(std::vector<unsigned>& loads, unsigned prisms, unsigned capacity) {
    std::size_t round = 0;
    while (round < loads.size() && loads[round] + prisms > capacity) ++round;
    if (round == loads.size()) loads.push_back(0);
    loads[round] += prisms;
    return round;
}

/// True if no cell of a grid is reached by more than `capacity` prisms, so that no point is held by more; false says nothing.
bool fitInOne(const std::vector<PrismLayers>& tiles, unsigned capacity) {
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const PrismLayers& tile : tiles) {
        low = glm::min(low, tile.low);
        high = glm::max(high, tile.high);
    }
    const int cells = std::clamp(int(2.0 * std::sqrt(double(tiles.size()))), 4, 256);
    const glm::dvec2 scale = double(cells) / glm::max(high - low, 1e-300); // finite, of no extent, too
    const auto cellOf = [&](const glm::dvec2& at) { return glm::ivec2(glm::min((at - low) * scale, cells - 1.0)); };
    std::vector<unsigned> reaching(std::size_t(cells * cells));
    for (const PrismLayers& tile : tiles) {
        const glm::ivec2 first = cellOf(tile.low), last = cellOf(tile.high);
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                if ((reaching[std::size_t(y * cells + x)] += tile.mostOver) > capacity) return false;
    }
    return true;
}

} // namespace

/// Whatever holds a point in one round overlaps there pairwise: the one placed last has counted all the others.
std::vector<std::vector<LayerSlice>> stencilBatches(const std::vector<PrismLayers>& tiles, unsigned capacity) {
    std::vector<std::vector<LayerSlice>> rounds;
    if (!tiles.empty() && fitInOne(tiles, capacity)) {
        rounds.emplace_back();
        for (std::size_t i = 0; i < tiles.size(); ++i) rounds.front().push_back({i, 0, tiles[i].layers});
        return rounds;
    }
    std::vector<Placed> about; // reach as far to the right as the next one begins
    for (const std::size_t i : fromTheLeft(tiles)) {
        const PrismLayers& tile = tiles[i];
        const auto isLeft = [&](const Placed& other) { return tiles[other.tile].high.x < tile.low.x; };
        about.erase(std::remove_if(about.begin(), about.end(), isLeft), about.end());
        std::vector<unsigned> loads(rounds.size());
        for (const Placed& other : about)
            if (tiles[other.tile].low.y <= tile.high.y && tile.low.y <= tiles[other.tile].high.y)
                for (const Load& load : other.loads) loads[load.round] += load.prisms;
        Placed& placed = about.emplace_back(Placed{i, {}});
        for (const Weighed& weighed : slicesOf(tile, i, capacity)) {
            const std::size_t round = firstWithRoom(loads, weighed.prisms, capacity);
            if (rounds.size() <= round) rounds.resize(round + 1);
            rounds[round].push_back(weighed.slice);
            placed.loads.push_back({round, weighed.prisms});
        }
    }
    return rounds;
}

} // namespace gnomon
