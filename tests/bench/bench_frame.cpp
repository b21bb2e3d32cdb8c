// SPDX-License-Identifier: MIT
// What shadows add to a frame, in one interleaved run. Planar and traced ones are checked by rays; in windows with and without
// stencil bits the pictures must be the same; a lamp among walls stands in gnomonchart's furnished room.
#include "Contenders.h"

#include <ChartScene.h>
#include <support/Oracle.h>
#include <support/Truth.h>

#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

using Make = std::function<test::Scene()>;
const test::View overTown = test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 300.0);

struct Entry {
    std::string name, spec; ///< spec: empty for none.
    int stencilBits = 8;
};

std::vector<bench::Contender> race(const char* title, const Make& make, const std::vector<Entry>& entries,
                                   const test::View& view, int frames, bool lampMoves = false) {
    std::printf("%s, %dx%d\n", title, view.width, view.height);
    std::vector<bench::Contender> contenders;
    for (const Entry& entry : entries) {
        test::Scene scene = make();
        if (!entry.spec.empty()) scene.addShadow(entry.spec);
        if (entry.name == "unnamed") dynamic_cast<gnomon::ShadowTechnique&>(*scene.group->getChild(1)).setReceiver({});
        contenders.push_back(
            bench::contender(entry.name, scene.root, view, entry.name == "ShadowMap", entry.stencilBits));
        if (lampMoves)
            contenders.back().before = [light = scene.light->getLight(), from = scene.light->getLight()->getPosition(),
                                        time = 0.0]() mutable {
                light->setPosition(from + osg::Vec4(float(0.2 * std::sin(time += 0.01)), 0.0f, 0.0f, 0.0f));
            };
    }
    bench::race(contenders, frames);
    return contenders;
}

test::Picture withoutLight(const Make& make, const test::View& view) {
    test::Scene dark = make();
    dark.takeLightAway();
    return test::render(dark.root, view);
}

/// The relit picture is what two renders without Gnomon say, wherever the oracle's rays are certain.
bool planar(const char* title, const std::vector<test::Mesh>& casters, double half, const test::View& view,
            int frames) {
    const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0);
    const Make make = [&] { return test::groundScene(casters, half, sun); };
    const auto drawn = race(title, make,
                            {{"none", ""},
                             {"relight", "planar"},
                             {"unnamed", "planar"},
                             {"blend", "planar:composite=blend"},
                             {"ShadowMap", ""}},
                            view, frames);
    const test::Comparison found =
        test::compare(drawn[1].camera->frame(), drawn[0].camera->frame(), withoutLight(make, view),
                      test::castRays(test::square(half), casters, sun, view));
    std::printf("  picture: %d wrong, %d of %d edge pixels decided otherwise\n", found.wrongInside + found.wrongAtEdge,
                found.flipped, found.edges);
    return found.wrongInside + found.wrongAtEdge == 0;
}

bool planar(int frames) {
    const bool small = planar("sphere and box on a ground",
                              {test::sphere({-2.0, 0.0, 2.5}, 1.0), test::house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0)},
                              8.0, test::perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 800, 600), frames);
    return planar("flat town of 400 boxes", test::town(20), 55.0, overTown, frames) && small;
}

/// A town on its ground, two drawables; checked against the truth image.
bool traced(const char* title, int side, const test::View& view, int frames) {
    const bench::Setting town{title, {test::square(2.75 * side), test::joined(test::town(side))}, view, 1};
    const Make make = [&] { return town.scene(); };
    const auto drawn =
        race(title, make, {{"none", ""}, {"relight", "traced"}, {"blend", "traced:composite=blend"}, {"ShadowMap", ""}},
             view, frames);
    const test::TruthComparison found =
        test::compare(drawn[1].camera->frame(), drawn[0].camera->frame(), withoutLight(make, view),
                      test::truthOf(town.meshes, bench::sun, view));
    std::cout << "  picture: " << found << std::endl;
    return found.good();
}

bool traced(int frames) {
    const bool small = traced("town of 400 boxes", 20, overTown, frames);
    return traced("town of 3,000,000 triangles", 500,
                  test::perspective({-400.0, -600.0, 250.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 3000.0),
                  std::max(3, frames / 10)) &&
           small;
}

bool window(int frames) {
    int different = 0;
    for (const char* spec : {"planar", "planar:composite=blend", "map", "map:composite=blend,edges=smooth", "traced"}) {
        const auto drawn = race(
            spec, [] { return test::groundScene(test::town(20), 55.0, bench::sun); },
            {{"none", ""}, {"without", spec, 0}, {"with", spec}}, overTown, frames);
        different += drawn[1].camera->frame().different(drawn[2].camera->frame());
    }
    std::printf("  %d pixels differ\n", different);
    return different == 0;
}

bool lamp(int frames) {
    const Make room = [] {
        test::Scene scene = test::scene({0.1, 0.3, 1.25, 1.0});
        scene.content->addChild(gnomon::examples::chartScene("room", 640, 480).content);
        return scene;
    };
    std::vector<Entry> entries = {{"none", ""}};
    for (const char* spec :
         {"map", "map:composite=blend", "map:composite=blend,edges=smooth", "traced:composite=blend"})
        entries.push_back({spec, spec});
    entries.push_back({"ShadowMap", ""});
    for (const bool moves : {false, true})
        race(moves ? "a lamp among walls, moving" : "a lamp among walls, at rest", room, entries,
             test::perspective({-2.8, -2.3, 2.1}, {0.5, 0.6, 0.7}, 640, 480, 70.0, 0.05, 12.0), frames, moves);
    return true;
}

int measure(osg::ArgumentParser& arguments) {
    const std::pair<std::string, bool (*)(int)> kinds[] = {
        {"planar", planar}, {"traced", traced}, {"window", window}, {"lamp", lamp}};
    bool (*run)(int) = planar;
    const auto take = [&](const std::string& value) {
        for (const auto& [name, kind] : kinds)
            if (name == value) return void(run = kind);
        throw std::invalid_argument("allowed: planar, traced, window, lamp.");
    };
    const auto frames = bench::framesAsked(arguments, "Cost of shadows, medians of interleaved frames.",
                                           {{"--of", "NAME", "planar, traced, window or lamp", "planar", take}});
    return !frames || run(*frames) ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_frame", argc, argv, measure); }
