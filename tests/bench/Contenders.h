// SPDX-License-Identifier: MIT
#pragma once
#include <CommandLine.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bench {

inline const osg::Vec4d sun(1.0, 0.3, 0.7, 0.0);

/// A scene of meshes that cast and receive, in the sun.
struct Setting {
    std::string name;
    std::vector<test::Mesh> meshes;
    test::View view;
    int everyNthFrame; ///< so many times fewer frames than asked for.

    test::Scene scene() const;
    int frames(int asked) const { return std::max(3, asked / everyNthFrame); }
};

/// One way to draw a scene, in a context of its own.
struct Contender {
    std::string name;
    osg::ref_ptr<osg::Group> root;
    std::unique_ptr<test::Camera> camera;
    std::function<void()> before;  ///< each frame, not timed; may be empty.
    std::vector<double> wall, cpu; ///< milliseconds a frame; cpu over all threads of the process
};

/// A scene as it is, with osgShadow::ShadowMap at its defaults if asked.
Contender contender(const std::string& name, osg::Group* root, const test::View& view, bool shadowMap = false,
                    int stencilBits = 8);

/// Draws all contenders in turn, frame by frame, after ten to warm up: shaders are compiled then, buffers filled. Prints
/// medians, quartiles and what each adds to the first, as a share of what the last adds.
void race(std::vector<Contender>& contenders, int frames);

/// --frames N, --help and what else a benchmark asks. @param usual  frames without --frames. @return nullopt after --help.
/// @throws std::invalid_argument, one sentence.
std::optional<int> framesAsked(osg::ArgumentParser& arguments, const std::string& describes,
                               const gnomon::examples::Options& others = {}, int usual = 200);

} // namespace bench
