// SPDX-License-Identifier: MIT
// What planar shadows add to a frame, beside what osgShadow::ShadowMap adds, in one interleaved run; the pictures are
// checked.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <osg/ArgumentParser>
#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <iostream>
#include <memory>

namespace {

using Clock = std::chrono::steady_clock;

/// One way to draw a scene, in a context of its own.
struct Contender {
    std::string name;
    test::Scene scene;
    std::unique_ptr<test::Camera> camera;
    std::vector<double> wall, cpu; ///< milliseconds a frame; cpu over all threads of the process
};

struct Setting {
    std::string name;
    std::vector<test::Mesh> casters;
    double groundHalf;
    test::View view;
};

osg::ref_ptr<osg::Group> withShadowMap(test::Scene& scene) {
    osg::ref_ptr<osgShadow::ShadowedScene> shadowed = new osgShadow::ShadowedScene(new osgShadow::ShadowMap);
    shadowed->addChild(scene.root);
    return shadowed;
}

test::Scene sceneOf(const Setting& setting) {
    return test::groundScene(setting.casters, setting.groundHalf, {1.0, 0.3, 1.2, 0.0});
}

Contender contender(const Setting& setting, const std::string& name) {
    Contender result{name, sceneOf(setting), nullptr, {}, {}};
    osg::ref_ptr<osg::Group> root = result.scene.root;
    if (name == "ShadowMap") root = withShadowMap(result.scene);
    if (name == "relight" || name == "blend" || name == "unnamed") {
        result.scene.addShadow(test::planar(name == "unnamed" ? nullptr : test::find(*root, "ground")));
        result.scene.group->setComposite(name == "blend" ? gnomon::ShadowCasterGroup::BLEND
                                                         : gnomon::ShadowCasterGroup::RELIGHT);
    }
    result.camera = std::make_unique<test::Camera>(root, setting.view);
    return result;
}

double cpuMilliseconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

void timeFrame(Contender& contender, bool record) {
    const double cpu = cpuMilliseconds();
    const auto start = Clock::now();
    contender.camera->viewer().frame();
    contender.camera->context().graphicsContext()->makeCurrent();
    glFinish();
    const std::chrono::duration<double, std::milli> wall = Clock::now() - start;
    if (!record) return;
    contender.wall.push_back(wall.count());
    contender.cpu.push_back(cpuMilliseconds() - cpu);
}

double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// The relit picture is what two renders without Gnomon say, wherever the oracle's rays are certain.
bool rightPicture(const Setting& setting, const test::Mesh& ground) {
    test::Scene dark = sceneOf(setting);
    dark.takeLightAway();
    Contender relight = contender(setting, "relight"), plain = contender(setting, "none");
    const test::Mask mask = test::castRays(ground, setting.casters, {1.0, 0.3, 1.2, 0.0}, setting.view);
    const test::Comparison found =
        test::compare(relight.camera->frame(), plain.camera->frame(), test::render(dark.root, setting.view), mask);
    std::printf("  picture: %d wrong, %d of %d edge pixels decided otherwise\n", found.wrongInside + found.wrongAtEdge,
                found.flipped, found.edges);
    return found.wrongInside + found.wrongAtEdge == 0;
}

void run(const Setting& setting, int frames) {
    std::vector<Contender> contenders;
    for (const char* name : {"none", "relight", "unnamed", "blend", "ShadowMap"})
        contenders.push_back(contender(setting, name));
    for (int frame = -10; frame < frames; ++frame) // ten to warm up: shaders are compiled, buffers filled
        for (Contender& each : contenders) timeFrame(each, frame >= 0);
    const auto added = [&](const Contender& each, std::vector<double> Contender::*times) {
        return quantile(each.*times, 0.5) - quantile(contenders.front().*times, 0.5);
    };
    const Contender& peer = contenders.back();
    for (const Contender& each : contenders)
        std::printf(
            "  %-10s wall %7.3f ms [%.3f, %.3f] adds %7.3f = %.3f of ShadowMap's | cpu %7.3f ms adds %7.3f = %.3f\n",
            each.name.c_str(), quantile(each.wall, 0.5), quantile(each.wall, 0.25), quantile(each.wall, 0.75),
            added(each, &Contender::wall), added(each, &Contender::wall) / added(peer, &Contender::wall),
            quantile(each.cpu, 0.5), added(each, &Contender::cpu),
            added(each, &Contender::cpu) / added(peer, &Contender::cpu));
}

} // namespace

int main(int argc, char** argv) {
    osg::ArgumentParser arguments(&argc, argv);
    arguments.getApplicationUsage()->setDescription(
        "Cost of planar shadows beside osgShadow::ShadowMap, medians of interleaved frames.");
    arguments.getApplicationUsage()->addCommandLineOption("--frames N", "frames of each contender (default 200)");
    if (arguments.read("--help")) {
        arguments.getApplicationUsage()->write(std::cout);
        return 0;
    }
    int frames = 200;
    arguments.read("--frames", frames);
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
        run(setting, frames);
        right = rightPicture(setting, test::square(setting.groundHalf)) && right;
    }
    return right ? 0 : 1;
}
