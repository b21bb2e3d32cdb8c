// SPDX-License-Identifier: MIT
// What shadows add to a frame in a window with stencil bits, and in one without; the pictures must be the same.
#include "Contenders.h"

#include <support/Oracle.h>

#include <cstdio>

namespace {

const test::View view = test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 300.0);

bench::Contender contender(const std::string& name, const std::string& spec, int stencilBits) {
    test::Scene scene = test::groundScene(test::town(20), 55.0, bench::sun);
    scene.addShadow(spec);
    gnomon::HeadlessContext::Options options;
    options.stencilBits = stencilBits;
    bench::Contender result;
    result.name = name;
    result.root = scene.root;
    result.camera = std::make_unique<test::Camera>(result.root, view, options);
    return result;
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames = bench::framesAsked(
        arguments, "Cost of shadows in a window without stencil bits, medians of interleaved frames.");
    if (!frames) return 0;
    bool same = true;
    for (const char* spec : {"planar", "planar:composite=blend", "map", "map:composite=blend,edges=smooth", "traced"}) {
        std::printf("%s, flat town of 400 boxes, 800x600\n", spec);
        std::vector<bench::Contender> contenders;
        contenders.push_back(contender("none", "none", 8));
        contenders.push_back(contender("without", spec, 0));
        contenders.push_back(contender("with", spec, 8));
        bench::race(contenders, *frames);
        const int different = contenders[1].camera->frame().different(contenders[2].camera->frame());
        if (different > 0) std::printf("  %d pixels differ\n", different);
        same = same && different == 0;
    }
    return same ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_window", argc, argv, measure); }
