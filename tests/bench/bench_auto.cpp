// SPDX-License-Identifier: MIT
// What the automatic choice itself takes: in a frame of a scene that stands still, for a first decision, and for a later one.
// Processor time of one thread.
// To count instructions instead: valgrind --tool=callgrind --toggle-collect='gnomon::AutoChooser::choose*' bench_auto.
#include "Contenders.h"

#include <gnomon/ShadowTechnique.h>
#include <gnomon/auto/AutoChooser.h>
#include <gnomon/group/SceneFrame.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

using bench::Setting;

namespace {

double milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Chooses as AutoShadowTechnique does, and draws nothing.
class TimedChoice : public gnomon::ShadowTechnique {
public:
    std::vector<osg::ref_ptr<gnomon::MarkJob>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                       const gnomon::FrameCasters& casters) const override {
        const auto usable = gnomon::localLight(light.inGroup, gnomon::SceneFrame(osg::Vec3d()));
        const double from = milliseconds();
        _chooser.choose({view, light, casters, casters.drawables(), *usable}, getReceiver(), {});
        times.push_back(milliseconds() - from);
        return {};
    }
    gnomon::ShadowDecision decision() const { return _chooser.lastDecision().at(0); }

    mutable std::vector<double> times; ///< of each frame.

private:
    mutable gnomon::AutoChooser _chooser;
};

/// @param firstCasts  its first mesh alone.
/// @return false if a still scene was judged more than once.
bool run(const Setting& setting, int frames, bool firstCasts = false) {
    test::Scene scene = setting.scene();
    const osg::ref_ptr<TimedChoice> choice = new TimedChoice;
    scene.addShadow(choice.get());
    if (firstCasts) scene.group->setCasters({scene.content->getChild(0)});
    test::Camera camera(scene.root, setting.view);
    for (int i = 0; i <= frames; ++i) camera.viewer().frame();
    const std::vector<double> still(choice->times.begin() + 1, choice->times.end());
    std::printf("%-44s first decision %8.3f ms, each still frame %.4f ms, %u decision(s), %s\n", setting.name.c_str(),
                choice->times.front(), median(still), choice->decision().decisions,
                choice->decision().chosen.spec.c_str());
    return choice->decision().decisions == 1;
}

/// A box on a floor of 10,000 tiles, each a drawable. Where the box alone casts, relighting draws the tiles in sight alone.
std::vector<test::Mesh> tiledFloor() {
    constexpr int side = 100;
    constexpr double tile = 5.5;
    std::vector<test::Mesh> all = {test::box({-8.0, -8.0, 0.0}, {8.0, 8.0, 12.0})};
    for (int i = 0; i < side * side; ++i)
        all.push_back(
            test::moved(test::square(tile / 2.0), {tile * (i % side - side / 2), tile * (i / side - side / 2), 0.0}));
    return all;
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames = bench::framesAsked(arguments, "What the automatic choice itself takes.");
    if (!frames) return 0;
    const test::View near = test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, 800, 600, 40.0, 1.0, 600.0);
    std::vector<test::Mesh> houses = test::town(20), more = test::town(100);
    houses.push_back(test::square(55.0));
    more.push_back(test::square(275.0));
    const Setting simple{
        "a sphere and a box",
        {test::square(8.0), test::sphere({-2.0, 0.0, 2.5}, 1.0), test::box({1.0, -1.0, 0.0}, {3.0, 1.0, 2.0})},
        test::perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 1.0}, 800, 600),
        1};
    bool right = run(simple, *frames);
    right = run({"town of 400 houses, each a drawable", houses, near, 1}, *frames) && right;
    right = run({"town of 10,000 houses, each a drawable", more, near, 1}, *frames) && right;
    const Setting floor{"floor of 10,000 tiles, and a box", tiledFloor(), near, 1};
    right = run(floor, *frames) && right;
    right = run({"the same, and the box alone casts", floor.meshes, near, 1}, *frames, true) && right;
    return right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_auto", argc, argv, measure); }
