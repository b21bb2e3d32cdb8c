// SPDX-License-Identifier: MIT
// Outlines of meshes under a light that moves: what is done before shadow volumes are drawn. On one core.
#include <Mesh.h>

#include <gnomon/silhouette/ShadowVolumes.h>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>
#include <osg/TriangleFunctor>
#include <osgDB/ReadFile>
#include <tbb/global_control.h>

#include <cmath>
#include <memory>

using gnomon::ShadowVolumes;
using gnomon::SilhouetteMesh;

namespace {

struct Corners {
    std::vector<glm::vec3> all;
    template <class... Rest>
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, Rest...) {
        for (const osg::Vec3& corner : {a, b, c}) all.emplace_back(corner.x(), corner.y(), corner.z());
    }
};

class Collect : public osg::NodeVisitor {
public:
    Collect() : NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Drawable& drawable) override { drawable.accept(triangles); }
    osg::TriangleFunctor<Corners> triangles;
};

std::unique_ptr<SilhouetteMesh> meshOf(const std::vector<glm::vec3>& places) {
    std::vector<unsigned> corners;
    for (unsigned i = 0; i < places.size(); ++i) corners.push_back(i);
    return std::make_unique<SilhouetteMesh>(
        SilhouetteMesh::Source{places.data(), places.size(), corners.data(), corners.size()});
}

const SilhouetteMesh& bunny() {
    static const auto mesh = [] {
        const osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile("/usr/share/glmark2/models/bunny.obj");
        Collect collect;
        if (model) model->accept(collect);
        return meshOf(collect.triangles.all);
    }();
    return *mesh;
}

/// A ball with dents of about this many triangles.
std::unique_ptr<SilhouetteMesh> dented(double triangles) {
    const gnomon::examples::Mesh ball =
        gnomon::examples::sphere(glm::dvec3(0.0), 1.0, static_cast<int>(std::lround(std::sqrt(triangles))));
    std::vector<glm::vec3> places;
    for (const glm::dvec3& at : ball)
        places.emplace_back(at * (1.0 + 0.02 * std::sin(19.0 * at.x) * std::sin(17.0 * at.y) * std::sin(23.0 * at.z)));
    return meshOf(places);
}

/// The volumes down to a ground below the mesh, of a sun that goes on by a degree each time.
void find(benchmark::State& state, const SilhouetteMesh& mesh) {
    if (mesh.parts.empty()) {
        state.SkipWithError("the model is not installed");
        return;
    }
    const auto planes = gnomon::endPlanes(2.0 * glm::dvec3(mesh.low), 2.0 * glm::dvec3(mesh.high));
    ShadowVolumes volumes;
    double turn = 0.0;
    std::size_t sides = 0, rounds = 0;
    for (auto _ : state) {
        turn += 0.0175;
        gnomon::findShadowVolumes(mesh, {glm::normalize(glm::dvec3(std::cos(turn), std::sin(turn), 1.0)), 0.0}, planes,
                                  volumes);
        sides += volumes.corners.size() / 6;
        ++rounds;
    }
    state.counters["triangles"] = double(mesh.triangles());
    state.counters["sides"] = double(sides) / double(rounds);
    state.counters["triangles/s"] =
        benchmark::Counter(double(mesh.triangles()), benchmark::Counter::kIsIterationInvariantRate);
}

void bunnyOnOneCore(benchmark::State& state) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    find(state, bunny());
}

void bunnyOnAllCores(benchmark::State& state) { find(state, bunny()); }

void ballOnOneCore(benchmark::State& state) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    find(state, *dented(double(state.range(0))));
}

/// Once a mesh, for all lights.
void edgesOfTheBunny(benchmark::State& state) {
    std::vector<unsigned> corners = bunny().corners;
    for (auto _ : state) {
        const SilhouetteMesh mesh({bunny().vertices.data(), bunny().vertices.size(), corners.data(), corners.size()});
        benchmark::DoNotOptimize(mesh.edges.data());
    }
}

} // namespace

BENCHMARK(bunnyOnOneCore)->Unit(benchmark::kMillisecond);
BENCHMARK(bunnyOnAllCores)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ballOnOneCore)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(edgesOfTheBunny)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
