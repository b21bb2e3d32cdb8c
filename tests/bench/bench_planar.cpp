// SPDX-License-Identifier: MIT
// What planar shadows add to a frame, beside what osgShadow::ShadowMap adds, in one interleaved run; the pictures are
// checked.
#include "Contenders.h"

#include <support/Oracle.h>

#include <cstdio>

namespace {

const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0);

struct Setting {
    std::string name;
    std::vector<test::Mesh> casters;
    double groundHalf;
    test::View view;
};

test::Scene sceneOf(const Setting& setting) { return test::groundScene(setting.casters, setting.groundHalf, sun); }

bench::Contender contender(const Setting& setting, const std::string& name) {
    test::Scene scene = sceneOf(setting);
    if (name == "relight" || name == "blend" || name == "unnamed") {
        scene.addShadow(test::planar(name == "unnamed" ? nullptr : test::find(*scene.root, "ground")));
        scene.group->setComposite(name == "blend" ? gnomon::ShadowCasterGroup::BLEND
                                                  : gnomon::ShadowCasterGroup::RELIGHT);
    }
    return bench::contender(name, scene.root, setting.view, name == "ShadowMap");
}

/// The relit picture is what two renders without Gnomon say, wherever the oracle's rays are certain.
bool rightPicture(const Setting& setting) {
    test::Scene dark = sceneOf(setting);
    dark.takeLightAway();
    bench::Contender relight = contender(setting, "relight"), plain = contender(setting, "none");
    const test::Mask mask = test::castRays(test::square(setting.groundHalf), setting.casters, sun, setting.view);
    const test::Comparison found =
        test::compare(relight.camera->frame(), plain.camera->frame(), test::render(dark.root, setting.view), mask);
    std::printf("  picture: %d wrong, %d of %d edge pixels decided otherwise\n", found.wrongInside + found.wrongAtEdge,
                found.flipped, found.edges);
    return found.wrongInside + found.wrongAtEdge == 0;
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames = bench::framesAsked(
        arguments, "Cost of planar shadows beside osgShadow::ShadowMap, medians of interleaved frames.");
    if (!frames) return 0;
    const std::vector<Setting> settings = {
        {"sphere and box on a ground",
         {test::sphere({-2.0, 0.0, 2.5}, 1.0), test::house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0)},
         8.0,
         test::perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 800, 600)},
        {"flat town of 400 boxes", test::town(20), 55.0,
         test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 300.0)}};
    bool right = true;
    for (const Setting& setting : settings) {
        std::printf("%s, 800x600\n", setting.name.c_str());
        std::vector<bench::Contender> contenders;
        for (const char* name : {"none", "relight", "unnamed", "blend", "ShadowMap"})
            contenders.push_back(contender(setting, name));
        bench::race(contenders, *frames);
        right = rightPicture(setting) && right;
    }
    return right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_planar", argc, argv, measure); }
