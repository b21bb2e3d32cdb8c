// SPDX-License-Identifier: MIT
// What shadows of a lamp among walls add to a frame: gnomonchart's furnished room, whose walls receive and cast on all
// sides. Techniques and osgShadow::ShadowMap take turns in one run.
#include "Contenders.h"

#include <GeneratedScenes.h>

#include <cmath>
#include <cstdio>

namespace {

const osg::Vec4d lamp(0.1, 0.3, 1.25, 1.0);
const test::View view = test::perspective({-2.8, -2.3, 2.1}, {0.5, 0.6, 0.7}, 640, 480, 70.0, 0.05, 12.0);

/// @param spec  empty: none.
bench::Contender contender(const std::string& name, const std::string& spec, bool moving) {
    test::Scene scene = test::scene(lamp);
    scene.content->addChild(gnomon::examples::furnishedRoom());
    if (!spec.empty()) scene.addShadow(spec);
    bench::Contender result = bench::contender(name, scene.root, view, name == "ShadowMap");
    if (moving)
        result.before = [light = scene.light, time = 0.0]() mutable {
            time += 0.01;
            light->getLight()->setPosition(
                osg::Vec4(osg::Vec4d(lamp + osg::Vec4d(0.2 * std::sin(time), 0.0, 0.0, 0.0))));
        };
    return result;
}

int measure(osg::ArgumentParser& arguments) {
    std::vector<std::string> specs;
    const auto frames =
        bench::framesAsked(arguments, "Cost of the shadows of a lamp among walls, medians of interleaved frames.",
                           {{"--shadow", "SPEC", "technique", "map, with both composites and smooth edges, and traced",
                             [&](const std::string& value) { specs.push_back(value); }, true}});
    if (!frames) return 0;
    if (specs.empty())
        specs = {"map", "map:composite=blend", "map:composite=blend,edges=smooth", "traced:composite=blend"};
    for (const bool moving : {false, true}) {
        std::printf("A lamp among walls, %s, 640x480\n", moving ? "moving" : "at rest");
        std::vector<bench::Contender> contenders;
        contenders.push_back(contender("none", "", moving));
        for (const std::string& spec : specs) contenders.push_back(contender(spec, spec, moving));
        contenders.push_back(contender("ShadowMap", "", moving));
        bench::race(contenders, *frames);
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_lamp", argc, argv, measure); }
