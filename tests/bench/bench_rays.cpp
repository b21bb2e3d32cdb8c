// SPDX-License-Identifier: MIT
// Shadow rays and queries a second and core, on a town of 3,000,000 triangles; and what building its tree takes.
#include <support/Mesh.h>

#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowQuery.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/RaySceneCache.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <osg/Timer>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace {

constexpr int side = 500; // 250,000 houses of 12 triangles
constexpr double half = 2.5 * side;
const osg::Vec4d sun(1.0, 0.3, 0.7, 0.0);

osg::ref_ptr<gnomon::ShadowCasterGroup> townGroup() {
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(test::node(test::joined(test::town(side))));
    group->addChild(test::node(test::square(half)));
    return group;
}

/// The best of nine runs, in millions a second of the processor's time: others may be using it, too.
template <typename Run>
double rate(std::size_t count, Run run) {
    double best = 0.0;
    for (int i = 0; i < 9; ++i) {
        const std::clock_t start = std::clock();
        run();
        const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
        best = std::max(best, double(count) / seconds / 1e6);
    }
    return best;
}

/// Places on roofs, walls and streets that a view of the town sees, and rays from there to the sun.
std::vector<gnomon::Ray> shadowRays(const gnomon::RayScene& scene, std::vector<osg::Vec3d>& places) {
    const glm::dmat4 clip = glm::perspective(glm::radians(40.0), 4.0 / 3.0, 1.0, 3000.0) *
                            glm::lookAt(glm::dvec3(-400.0, -600.0, 250.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
    const glm::dmat4 back = glm::inverse(clip);
    const glm::dvec3 light = glm::normalize(glm::dvec3(sun.x(), sun.y(), sun.z()));
    std::vector<gnomon::Ray> rays;
    for (int y = 0; y < 768; ++y)
        for (int x = 0; x < 1024; ++x) {
            const glm::dvec2 at((x + 0.5) / 512.0 - 1.0, (y + 0.5) / 384.0 - 1.0);
            const glm::dvec4 n = back * glm::dvec4(at, -1.0, 1.0), f = back * glm::dvec4(at, 1.0, 1.0);
            const glm::dvec3 near = glm::dvec3(n) / n.w, along = glm::dvec3(f) / f.w - near;
            const gnomon::RayHit hit = scene.closest({near, along, 1.0});
            if (!hit || glm::dot(hit.normal, light) <= 0.0) continue;
            const glm::dvec3 place = near + hit.distance * along;
            rays.push_back({scene.lifted(place, hit.normal), light});
            places.emplace_back(place.x, place.y, place.z);
        }
    return rays;
}

void measure(const gnomon::Casters& casters, const gnomon::ShadowTechnique& technique) {
    const osg::ElapsedTime watch;
    const std::shared_ptr<const gnomon::RayScene> trees = gnomon::RaySceneCache().of(casters, "bench");
    const gnomon::RayScene& scene = *trees;
    std::printf("  tree of %zu triangles: %.2f s\n", casters.layers().triangles(), watch.elapsedTime());
    std::vector<osg::Vec3d> places;
    const std::vector<gnomon::Ray> rays = shadowRays(scene, places);
    std::vector<std::uint8_t> answers(rays.size());
    const gnomon::ShadowQuery query(technique, {0, sun});
    for (osg::Vec3d& place : places) place += casters.layers().origin;
    std::printf("  shadow rays, in order of pixels:  %.1f million a second and core\n",
                rate(rays.size(), [&] { scene.blocked(rays.data(), rays.size(), answers.data()); }));
    std::printf("  %.0f %% of them are blocked\n",
                100.0 * double(std::count(answers.begin(), answers.end(), 1)) / double(rays.size()));
    std::printf("  isLit(), on surfaces:             %.1f million a second and core\n",
                rate(places.size(), [&] { query.areLit(places); }));
    for (osg::Vec3d& place : places) place.z() += 0.5;
    std::printf("  isLit(), half a metre off them:   %.1f million a second and core\n",
                rate(places.size(), [&] { query.areLit(places); }));
    std::printf("  isBlocked(), from one such point: %.1f million a second and core\n",
                rate(places.size(), [&] { query.areBlocked(places[places.size() / 2], places); }));
}

} // namespace

int main(int argc, char**) {
    if (argc > 1) {
        std::puts("bench_rays casts rays in a town and says how many a second. It takes no options.");
        return 2;
    }
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = townGroup();
    const osg::ref_ptr<gnomon::TracedShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    group->addChild(technique);
    const tbb::global_control oneCore(tbb::global_control::max_allowed_parallelism, 1);
    std::printf("town of 3,000,000 triangles, on one core\n");
    measure(*group->casters(), *technique);
    return 0;
}
