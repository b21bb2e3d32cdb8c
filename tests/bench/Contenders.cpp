// SPDX-License-Identifier: MIT
#include "Contenders.h"

#include <FrameTime.h>

#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>

#include <algorithm>
#include <cstdio>
#include <iostream>

namespace bench {
namespace {

using gnomon::examples::describeOptions;
using gnomon::examples::FrameTime;
using gnomon::examples::Options;
using gnomon::examples::Quartiles;
using gnomon::examples::quartiles;
using gnomon::examples::readOptions;
using gnomon::examples::readWhole;
using gnomon::examples::refuseUnknownOptions;
using Times = std::vector<double> Contender::*;

void timeFrame(Contender& contender, bool record) {
    if (contender.before) contender.before();
    const FrameTime time = gnomon::examples::timeFrame(contender.camera->viewer());
    if (!record) return;
    contender.wall.push_back(time.wall);
    contender.cpu.push_back(time.processor);
}

double added(const Contender& contender, const Contender& to, Times times) {
    return quartiles(contender.*times).median - quartiles(to.*times).median;
}

} // namespace

test::Scene Setting::scene() const {
    test::Scene scene = test::scene(sun);
    for (const test::Mesh& mesh : meshes) scene.content->addChild(test::node(mesh));
    return scene;
}

Contender contender(const std::string& name, osg::Group* root, const test::View& view, bool shadowMap,
                    int stencilBits) {
    Contender result;
    result.name = name;
    result.root = root;
    if (shadowMap) {
        result.root = new osgShadow::ShadowedScene(new osgShadow::ShadowMap);
        result.root->addChild(root);
    }
    gnomon::HeadlessContext::Options options;
    options.stencilBits = stencilBits;
    result.camera = std::make_unique<test::Camera>(result.root, view, options);
    return result;
}

void race(std::vector<Contender>& contenders, int frames) {
    for (int frame = -10; frame < frames; ++frame)
        for (Contender& each : contenders) timeFrame(each, frame >= 0);
    const Contender& plain = contenders.front();
    const Contender& peer = contenders.back();
    for (const Contender& each : contenders) {
        const Quartiles frame = quartiles(each.wall);
        const double wall = added(each, plain, &Contender::wall), cpu = added(each, plain, &Contender::cpu);
        std::printf("  %-14s wall %8.3f ms [%.3f, %.3f] adds %8.3f = %.3f of %s's | cpu %8.3f ms adds %8.3f = %.3f\n",
                    each.name.c_str(), frame.median, frame.q1, frame.q3, wall,
                    wall / added(peer, plain, &Contender::wall), peer.name.c_str(), quartiles(each.cpu).median, cpu,
                    cpu / added(peer, plain, &Contender::cpu));
    }
    std::fflush(stdout);
}

std::optional<int> framesAsked(osg::ArgumentParser& arguments, const std::string& describes, const Options& others,
                               int usual) {
    int frames = usual;
    Options table{{"--frames", "N", "frames of each contender, 1 to 100000", std::to_string(usual),
                   [&](const std::string& value) { frames = readWhole(value, 1, 100000); }}};
    table.insert(table.end(), others.begin(), others.end());
    if (arguments.read("--help")) {
        std::cout << describes << "\n\nOptions\n" << describeOptions(table);
        return std::nullopt;
    }
    readOptions(arguments, table);
    refuseUnknownOptions(arguments);
    return frames;
}

} // namespace bench
