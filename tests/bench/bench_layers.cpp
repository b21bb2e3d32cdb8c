// SPDX-License-Identifier: MIT
// What shadow maps add to a frame of a scene in which one thing moves, and to the same while it stands, beside what
// osgShadow::ShadowMap adds, in one interleaved run; the picture is checked against maps that saw no other frame.
#include "Contenders.h"

#include <gnomon/ShadowMapTechnique.h>

#include <osg/MatrixTransform>

#include <cstdio>

using bench::Setting;

namespace {

struct Stage {
    explicit Stage(const Setting& setting) : scene(setting.scene()) {
        mover->addChild(test::node(test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.5})));
        mover->setDataVariance(osg::Object::DYNAMIC);
        scene.content->addChild(mover);
    }
    void place(int step) { mover->setMatrix(osg::Matrixd::translate(0.05 * (step % 400) - 10.0, 2.5, 0.0)); }

    test::Scene scene;
    osg::ref_ptr<osg::MatrixTransform> mover = new osg::MatrixTransform;
};

bench::Contender contender(const Setting& setting, const std::string& name, bool moves) {
    const auto stage = std::make_shared<Stage>(setting);
    if (name != "none" && name != "ShadowMap") {
        stage->scene.addShadow(new gnomon::ShadowMapTechnique);
        stage->scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    }
    bench::Contender result = bench::contender(name, stage->scene.root, setting.view, name == "ShadowMap");
    result.before = [stage, moves, step = 0]() mutable { stage->place(moves ? ++step : 0); };
    return result;
}

/// @param moved  the last of its frames; `step` of them.
bool rightPicture(const Setting& setting, const test::Picture& moved, int step) {
    Stage stage(setting);
    stage.scene.addShadow(new gnomon::ShadowMapTechnique);
    stage.scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    stage.place(step);
    const int wrong = moved.different(test::render(stage.scene.root, setting.view));
    std::printf("  picture: %d pixels differ\n", wrong);
    return wrong == 0;
}

bool run(const Setting& setting, int asked) {
    std::printf("%s, 800x600\n", setting.name.c_str());
    const int frames = setting.frames(asked);
    std::vector<bench::Contender> contenders;
    contenders.push_back(contender(setting, "none", true));
    contenders.push_back(contender(setting, "still", false));
    contenders.push_back(contender(setting, "one moves", true));
    contenders.push_back(contender(setting, "ShadowMap", true));
    bench::race(contenders, frames);
    const test::Picture last = contenders[2].camera->frame(); // where it stood in the last of them
    return rightPicture(setting, last, frames + 10);
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames = bench::framesAsked(
        arguments, "Cost of shadow maps while one of many casters moves, medians of interleaved frames.");
    if (!frames) return 0;
    std::vector<test::Mesh> houses = test::town(100);
    houses.push_back(test::square(275.0));
    bool right = run({"town of 10,000 houses, each a drawable", houses,
                      test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 600.0), 2},
                     *frames);
    right = run({"town of 1,080,000 triangles, two drawables",
                 {test::square(825.0), test::joined(test::town(300))},
                 test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 600.0),
                 5},
                *frames) &&
            right;
    return right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_layers", argc, argv, measure); }
