// SPDX-License-Identifier: MIT
#include <gnomon/silhouette/StencilBatches.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

using gnomon::LayerSlice;
using gnomon::PrismLayers;
using gnomon::stencilBatches;

namespace {

using Rounds = std::vector<std::vector<LayerSlice>>;

bool holds(const PrismLayers& tile, const glm::dvec2& p) {
    return tile.low.x <= p.x && p.x <= tile.high.x && tile.low.y <= p.y && p.y <= tile.high.y;
}

/// Of all corners of all pairs of rectangles, where as many overlap as anywhere.
unsigned mostOver(const std::vector<PrismLayers>& tiles, const std::vector<LayerSlice>& round) {
    unsigned most = 0;
    for (const PrismLayers& x : tiles)
        for (const PrismLayers& y : tiles) {
            unsigned over = 0;
            for (const LayerSlice& slice : round) {
                const PrismLayers& tile = tiles[slice.tile];
                const unsigned prisms = slice.count == tile.layers ? tile.mostOver : slice.count;
                if (holds(tile, {x.low.x, y.low.y})) over += prisms;
            }
            most = std::max(most, over);
        }
    return most;
}

std::vector<PrismLayers> someTiles(unsigned count) {
    std::mt19937 dice(7);
    std::vector<PrismLayers> tiles;
    for (unsigned i = 0; i < count; ++i) {
        const glm::dvec2 low(dice() % 100, dice() % 100), size(1 + dice() % 30, 1 + dice() % 30);
        const unsigned layers = 1u + unsigned(dice() % 9);
        tiles.push_back({low, low + size, layers, std::min(layers, 1u + unsigned(dice() % 9))});
    }
    return tiles;
}

} // namespace

TEST(StencilRounds, TakeAllInOneWhereCountersAreWideEnough) {
    const std::vector<PrismLayers> tiles = {{{0, 0}, {2, 2}, 3, 3}, {{1, 1}, {3, 3}, 4, 4}, {{9, 9}, {10, 10}, 7, 7}};
    const Rounds rounds = stencilBatches(tiles, 7);
    ASSERT_EQ(rounds.size(), 1u);
    EXPECT_EQ(rounds[0].size(), 3u);
    EXPECT_EQ(stencilBatches(tiles, 6).size(), 2u) << "3 and 4 lie over one another";
    EXPECT_EQ(stencilBatches(tiles, 1).size(), 7u);
    EXPECT_TRUE(stencilBatches({}, 7).empty());
}

/// As of sheets in one plane under a sun in that plane.
TEST(StencilRounds, OfTilesWithoutExtentAreAsOfOthers) {
    const std::vector<PrismLayers> apart = {{{0, 0}, {0, 1}, 1, 1}, {{0, 2}, {0, 3}, 1, 1}},
                                   points(3, {{1, 1}, {1, 1}, 1, 1});
    EXPECT_EQ(stencilBatches(apart, 1).size(), 1u);
    EXPECT_EQ(stencilBatches(points, 1).size(), 3u);
    EXPECT_EQ(stencilBatches(points, 3).size(), 1u);
}

TEST(StencilRounds, CountNoPointTooHighAndEachLayerOnce) {
    const std::vector<PrismLayers> tiles = someTiles(120);
    for (const unsigned capacity : {1u, 3u, 7u, 31u, 63u}) {
        std::map<std::pair<std::size_t, unsigned>, int> times;
        for (const auto& round : stencilBatches(tiles, capacity)) {
            EXPECT_FALSE(round.empty());
            EXPECT_LE(mostOver(tiles, round), capacity);
            for (const LayerSlice& slice : round)
                for (unsigned layer = 0; layer < slice.count; ++layer) ++times[{slice.tile, slice.first + layer}];
        }
        for (std::size_t i = 0; i < tiles.size(); ++i)
            for (unsigned layer = 0; layer < tiles[i].layers; ++layer) EXPECT_EQ((times[{i, layer}]), 1) << i;
    }
}

TEST(StencilRounds, TouchingTilesAreTakenForOverlapping) {
    EXPECT_EQ(stencilBatches({{{0, 0}, {1, 1}, 1, 1}, {{1, 1}, {2, 2}, 1, 1}}, 1).size(), 2u);
    EXPECT_EQ(stencilBatches({{{0, 0}, {1, 1}, 1, 1}, {{0, 1.5}, {1, 2}, 1, 1}}, 1).size(), 1u);
}
