// SPDX-License-Identifier: MIT
#include "Contenders.h"

#include <osg/ArgumentParser>
#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <iostream>

namespace bench {
namespace {

using Clock = std::chrono::steady_clock;
using Times = std::vector<double> Contender::*;

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

double added(const Contender& contender, const Contender& to, Times times) {
    return quantile(contender.*times, 0.5) - quantile(to.*times, 0.5);
}

} // namespace

Contender contender(const std::string& name, osg::Group* root, const test::View& view, bool shadowMap) {
    Contender result;
    result.name = name;
    result.root = root;
    if (shadowMap) {
        result.root = new osgShadow::ShadowedScene(new osgShadow::ShadowMap);
        result.root->addChild(root);
    }
    result.camera = std::make_unique<test::Camera>(result.root, view);
    return result;
}

void race(std::vector<Contender>& contenders, int frames) {
    for (int frame = -10; frame < frames; ++frame)
        for (Contender& each : contenders) timeFrame(each, frame >= 0);
    const Contender& plain = contenders.front();
    const Contender& peer = contenders.back();
    for (const Contender& each : contenders) {
        const double wall = added(each, plain, &Contender::wall), cpu = added(each, plain, &Contender::cpu);
        std::printf("  %-14s wall %8.3f ms [%.3f, %.3f] adds %8.3f = %.3f of %s's | cpu %8.3f ms adds %8.3f = %.3f\n",
                    each.name.c_str(), quantile(each.wall, 0.5), quantile(each.wall, 0.25), quantile(each.wall, 0.75),
                    wall, wall / added(peer, plain, &Contender::wall), peer.name.c_str(), quantile(each.cpu, 0.5), cpu,
                    cpu / added(peer, plain, &Contender::cpu));
    }
    std::fflush(stdout);
}

std::optional<int> framesAsked(int argc, char** argv, const std::string& describes) {
    osg::ArgumentParser arguments(&argc, argv);
    arguments.getApplicationUsage()->setDescription(describes);
    arguments.getApplicationUsage()->addCommandLineOption("--frames N", "frames of each contender (default 200)");
    if (arguments.read("--help")) {
        arguments.getApplicationUsage()->write(std::cout);
        return std::nullopt;
    }
    int frames = 200;
    arguments.read("--frames", frames);
    return std::max(frames, 1);
}

} // namespace bench
