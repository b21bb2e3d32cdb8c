// SPDX-License-Identifier: MIT
// Shadows of a town's houses on hills with posts every 10 m: houses a second, a step of the sun, memory. Each run's result is
// checked before it is timed.
#include <support/TerrainTrial.h>

#include <gnomon/ground/HullSolids.h>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <map>
#include <random>

namespace {

constexpr int posts = 513, tileSize = 256;

const gnomon::HeightPyramid& ground() {
    static const gnomon::HeightPyramid pyramid = test::groundOf(test::hills, posts);
    return pyramid;
}

struct Tile {
    std::vector<gnomon::HullPart> parts;
    gnomon::HullSolids solids;
    glm::dvec3 origin{0.0};
};

struct Town {
    std::vector<Tile> tiles;
    std::vector<test::Prism> prisms; ///< of the first tile.
    std::size_t size = 0;
};

test::Prism houseNear(const glm::dvec2& middle, std::mt19937& random) {
    std::uniform_real_distribution<double> unit;
    const glm::dvec2 half = 4.0 + 8.0 * test::drawn(unit, random);
    const double turn = 180.0 * test::degree * unit(random), above = 5.0 + 25.0 * unit(random);
    const double height = *ground().height(middle.x, middle.y);
    return test::boxAt(middle, half, turn, height - 40.0, height + above);
}

/// Turned houses of 8 to 24 m, 5 to 30 m high, in tiles in rows over the ground, at least 300 m from its borders; the more,
/// the nearer to one another.
Town townOf(std::size_t count) {
    Town town;
    std::mt19937 random(5);
    const std::size_t tiles = (count + tileSize - 1) / tileSize,
                      side = std::size_t(std::ceil(std::sqrt(double(tiles))));
    const double width = ((posts - 1) * test::pitch - 600.0) / double(side);
    std::uniform_real_distribution<double> within(0.0, width);
    for (std::size_t t = 0; t < tiles; ++t) {
        const glm::dvec2 corner(300.0 + width * double(t % side), 300.0 + width * double(t / side));
        Tile tile;
        tile.origin = glm::dvec3(corner, *ground().height(corner.x, corner.y));
        for (std::size_t i = 0; i < tileSize && town.size < count; ++i, ++town.size) {
            const test::Prism house = houseNear(corner + test::drawn(within, random), random);
            if (t == 0) town.prisms.push_back(house);
            tile.parts.emplace_back(house.parts().front());
        }
        town.tiles.push_back(std::move(tile));
    }
    return town;
}

Town& town(std::size_t count) {
    static std::map<std::size_t, Town> towns;
    const auto known = towns.find(count);
    return known != towns.end() ? known->second : towns.emplace(count, townOf(count)).first->second;
}

glm::dvec4 sunAt(double azimuth) { return {test::sunAt(azimuth, 30.0), 0.0}; }

void step(Town& town, const glm::dvec4& sun) {
    const gnomon::HullGround on(ground());
    tbb::parallel_for(std::size_t{0}, town.tiles.size(), [&](std::size_t i) {
        Tile& tile = town.tiles[i];
        tile.solids = hullSolids(on, tile.parts, sun, tile.origin);
    });
}

/// Intersection over union with rays at the houses of the first tile.
double quality(const Town& town, const glm::dvec4& sun) {
    std::vector<test::Share> shares;
    for (std::size_t i = 0; i < town.prisms.size(); i += 8)
        shares.push_back(judge(ground(), town.prisms[i], sun, {{"hull", test::hullMethod()}}, 1000)[0]);
    return tally(shares).pooled;
}

/// A step of the sun over all of the town. Arguments: houses, threads.
void sunStep(benchmark::State& state) {
    Town& houses = town(std::size_t(state.range(0)));
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, std::size_t(state.range(1)));
    double azimuth = 100.0;
    step(houses, sunAt(azimuth));
    if (!(quality(houses, sunAt(azimuth)) > 0.99)) return state.SkipWithError("the shadows are wrong.");
    std::size_t triangles = 0, kept = 0;
    for (auto _ : state) step(houses, sunAt(azimuth += 0.25));
    for (const Tile& tile : houses.tiles) {
        for (const gnomon::HullPart& part : tile.parts)
            kept += sizeof part + part.corners.size() * sizeof(glm::vec3) + part.faces.size() * sizeof(glm::vec4);
        kept += tile.solids.vertices.size() * sizeof(glm::vec4) + tile.solids.corners.size() * sizeof(unsigned);
        triangles += tile.solids.corners.size() / 3;
    }
    const auto count = double(houses.size);
    state.counters["houses/s"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["triangles"] = double(triangles) / count;
    state.counters["B/house"] = double(kept) / count;
}

void sizes(benchmark::internal::Benchmark* run) {
    run->ArgNames({"houses", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
    for (const int count : {1000, 10000, 100000, 1000000}) run->Args({count, 2});
    run->Args({100000, 1});
}

BENCHMARK(sunStep)->Apply(sizes);

} // namespace

BENCHMARK_MAIN();
