// SPDX-License-Identifier: MIT
// What traced shadows add to a frame of a scene that stands still, beside what osgShadow::ShadowMap adds, in one
// interleaved run; the pictures are checked against the truth image.
#include "Contenders.h"

#include <support/Truth.h>

#include <gnomon/TracedShadowTechnique.h>

#include <cstdio>
#include <iostream>

using bench::Setting;

namespace {

/// A town on its ground, two drawables.
std::vector<test::Mesh> town(int side) { return {test::square(2.75 * side), test::joined(test::town(side))}; }

bench::Contender contender(const Setting& setting, const std::string& name) {
    test::Scene scene = setting.scene();
    if (name == "relight" || name == "blend") {
        scene.addShadow(new gnomon::TracedShadowTechnique);
        scene.group->setComposite(name == "blend" ? gnomon::ShadowCasterGroup::BLEND
                                                  : gnomon::ShadowCasterGroup::RELIGHT);
    }
    return bench::contender(name, scene.root, setting.view, name == "ShadowMap");
}

/// @param relight,lit  drawn before.
bool rightPicture(const Setting& setting, const test::Picture& relight, const test::Picture& lit) {
    test::Scene dark = setting.scene();
    dark.takeLightAway();
    const test::TruthComparison found = test::compare(relight, lit, test::render(dark.root, setting.view),
                                                      test::truthOf(setting.meshes, bench::sun, setting.view));
    std::cout << "  picture: " << found << std::endl;
    return found.good();
}

bool run(const Setting& setting, int frames) {
    std::printf("%s, 800x600\n", setting.name.c_str());
    std::vector<bench::Contender> contenders;
    for (const char* name : {"none", "relight", "blend", "ShadowMap"}) contenders.push_back(contender(setting, name));
    bench::race(contenders, setting.frames(frames));
    return rightPicture(setting, contenders[1].camera->frame(), contenders[0].camera->frame());
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames = bench::framesAsked(
        arguments, "Cost of traced shadows beside osgShadow::ShadowMap, medians of interleaved frames.");
    if (!frames) return 0;
    bool right = run({"town of 400 boxes", town(20),
                      test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 300.0), 1},
                     *frames);
    right = run({"town of 3,000,000 triangles", town(500),
                 test::perspective({-400.0, -600.0, 250.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 3000.0), 10},
                *frames) &&
            right;
    return right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_traced", argc, argv, measure); }
