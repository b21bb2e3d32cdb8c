// SPDX-License-Identifier: MIT
// What shadows of 200 bodies add to a frame, each body in a transform of its own above a ground: all stand still, one of
// them moves, all move. Then what memory one geometry at 200 places takes. Techniques and osgShadow::ShadowMap take turns
// in one run.
#include "Contenders.h"

#include <FrameTime.h>

#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <osg/MatrixTransform>

#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace {

constexpr int bodies = 200;
enum Motion { still, oneMoves, allMove };
constexpr const char* names[] = {"still", "one moves", "all move"};

/// A sphere of about as many triangles.
test::Mesh body(int triangles) {
    int slices = 8;
    while (slices * slices * 2 < triangles) slices += 2;
    return test::sphere({0.0, 0.0, 0.0}, 1.0, slices);
}

/// Bodies on a grid above a ground.
struct Fleet {
    Fleet(int triangles, bool shared) : scene(test::scene(bench::sun)) {
        scene.content->addChild(test::node(test::square(50.0), "ground"));
        const test::Mesh mesh = body(triangles);
        osg::ref_ptr<osg::Node> one = test::node(mesh);
        for (int i = 0; i < bodies; ++i) {
            transforms.push_back(new osg::MatrixTransform);
            transforms.back()->addChild(shared ? one : osg::ref_ptr<osg::Node>(test::node(mesh)));
            scene.content->addChild(transforms.back());
            place(i, 0.0);
        }
    }
    void place(int i, double time) {
        const osg::Vec3d at(5.0 * (i % 20) - 47.5, 9.0 * (i / 20) - 40.0, 1.5 + 0.3 * (i % 3));
        transforms[std::size_t(i)]->setMatrix(osg::Matrixd::rotate(time + i, osg::Vec3d(1, 2, 3)) *
                                              osg::Matrixd::translate(at + osg::Vec3d(time, 0, 0)));
    }
    void move(Motion motion, double time) {
        for (int i = 0; i < (motion == still ? 0 : motion == oneMoves ? 1 : bodies); ++i) place(i, time);
    }

    test::Scene scene;
    std::vector<osg::ref_ptr<osg::MatrixTransform>> transforms;
};

void addTechnique(test::Scene& scene, const std::string& name) {
    if (name == "traced") scene.addShadow(new gnomon::TracedShadowTechnique);
    if (name == "map") scene.addShadow(new gnomon::ShadowMapTechnique);
    if (name == "planar") scene.addShadow(test::planar());
    if (scene.group) scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
}

const test::View view = test::perspective({-60.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 300.0);

void measure(int triangles, Motion motion, int frames) {
    std::vector<bench::Contender> contenders;
    for (const char* name : {"none", "traced", "map", "planar", "ShadowMap"}) {
        const auto fleet = std::make_shared<Fleet>(triangles, false);
        addTechnique(fleet->scene, name);
        contenders.push_back(bench::contender(name, fleet->scene.root, view, std::string(name) == "ShadowMap"));
        contenders.back().before = [fleet, motion, time = 0.0]() mutable { fleet->move(motion, time += 0.01); };
    }
    std::printf("%d bodies of %zu triangles, %s, 800x600\n", bodies, body(triangles).size() / 3, names[motion]);
    bench::race(contenders, frames);
}

/// Of this process, MiB.
double residentMemory() {
    std::ifstream file("/proc/self/statm");
    double all = 0.0, resident = 0.0;
    file >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

void measureMemory(int triangles) {
    std::printf("one geometry of %zu triangles at %d places\n", body(triangles).size() / 3, bodies);
    std::vector<std::unique_ptr<test::Camera>> kept;
    for (const char* name : {"none", "none", "traced", "map", "planar"}) {
        Fleet fleet(triangles, true);
        addTechnique(fleet.scene, name);
        const double before = residentMemory();
        kept.push_back(std::make_unique<test::Camera>(fleet.scene.root, view));
        for (int frame = 0; frame < 3; ++frame) kept.back()->frame();
        std::printf("  %-8s takes %7.1f MiB\n", name, residentMemory() - before);
    }
}

int run(osg::ArgumentParser& arguments) {
    int triangles = 1000;
    const auto frames = bench::framesAsked(
        arguments, "Cost of shadows of 200 bodies that move as a whole, medians of interleaved frames.",
        {{"--triangles", "N", "of a body, 100 to 100000", "1000",
          [&](const std::string& value) { triangles = gnomon::examples::readWhole(value, 100, 100000); }}});
    if (!frames) return 0;
    for (const Motion motion : {still, oneMoves, allMove}) measure(triangles, motion, *frames);
    measureMemory(4 * triangles);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_bodies", argc, argv, run); }
