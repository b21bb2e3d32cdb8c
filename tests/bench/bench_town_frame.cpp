// SPDX-License-Identifier: MIT
// What the shadows of a town on mountains add to a frame, 800 m above ground: with the sun still, with the sun at 60 times
// its pace, and after a jump of an hour; in one interleaved run. The pictures are checked.
#include "Contenders.h"

#include <ElevationFile.h>
#include <FrameTime.h>
#include <TownScene.h>

#include <gnomon/ShadowBin.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/TerrainShadowGeode.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

namespace {

using gnomon::examples::quartiles;
using gnomon::examples::SceneSetup;
using gnomon::examples::TownScene;

constexpr int width = 640, height = 480;
constexpr double pace = 60.0, framesASecond = 60.0; // of the sun, and of a display

SceneSetup setUp(const TownScene& town, const std::string& shadow) {
    gnomon::examples::ViewOptions view = town.view();
    view.shadows = {gnomon::parseShadowSpec(shadow)};
    view.shadows.front().receiver = "terrain";
    return setUpScene(view, *town.setup().group->getChild(0));
}

test::View viewOf(const TownScene& town) {
    const auto& view = town.view();
    // Nothing is nearer than 300 m: with a near plane at 10 m, by depths of 24 bits prisms (drape) take 1.3 % of the shadows' pixels for others.
    return test::perspective(*view.eye, *view.center, width, height, view.fovy, 100.0, 4e4);
}

/// Turns the sun on and on.
class Turning {
public:
    Turning(SceneSetup& setup, const osg::Vec3d& centre, double degreesAFrame)
        : _setup(setup), _centre(centre), _step(degreesAFrame) {}
    void operator()() { _setup.lights->move({_step * ++_frames, 0.0}, _centre); }
    int frames() const { return _frames; }

private:
    SceneSetup& _setup;
    const osg::Vec3d _centre;
    const double _step;
    int _frames = 0;
};

/// How many tiles' shadows have been found so far.
unsigned foundIn(const SceneSetup& setup) {
    unsigned sum = 0;
    for (unsigned i = 0; i < setup.group->getNumChildren(); ++i)
        if (const auto* terrain = dynamic_cast<const gnomon::TerrainShadowGeode*>(setup.group->getChild(i)))
            sum += terrain->builds();
    return sum;
}

double median(const bench::Contender& contender) { return quartiles(contender.wall).median; }

/// Against the ground's own triangles, exactly cut; and with nothing left out, and nothing drawn uncut.
bool rightPicture(const TownScene& town, const test::View& view) {
    const auto picture = [&](const std::string& shadow) {
        const SceneSetup setup = setUp(town, shadow);
        return test::render(setup.root, view);
    };
    const test::Picture plain = picture("none"), hull = picture("hull"), exact = picture("drape:error=0");
    gnomon::ShadowBin::setFilter(false);
    const int off = picture("hull").different(hull);
    gnomon::ShadowBin::setFilter(true);
    const int shadow = exact.different(plain), wrong = hull.different(exact);
    std::printf(
        "  picture: %d pixels in shadow; hull and exact drape differ in %d; culling and uncut decals change %d\n",
        shadow, wrong, off);
    return shadow > 0 && wrong < shadow / 50 && off < shadow / 50;
}

bool run(int buildings, int frames) {
    const auto field = gnomon::examples::readElevation(GNOMON_JACKSBORO, "bench_town_frame");
    TownScene town({}, 9.0, *field, {buildings});
    const test::View view = viewOf(town);
    const double pacePerFrame = 360.0 / 86400.0 * pace / framesASecond;
    std::vector<SceneSetup> setups;
    for (const char* shadow : {"none", "hull:composite=blend", "hull", "hull:composite=blend", "hull:composite=blend"})
        setups.push_back(setUp(town, shadow));
    const char* const names[] = {"none", "blend", "relight", "60 x real time", "an hour a frame"};
    std::vector<bench::Contender> contenders;
    for (std::size_t i = 0; i < setups.size(); ++i)
        contenders.push_back(bench::contender(names[i], setups[i].root, view));
    Turning sun(setups[3], *town.view().center, pacePerFrame);
    contenders[3].before = [&] { sun(); };
    contenders[4].before = Turning(setups[4], *town.view().center, 15.0);
    std::printf("%d buildings, %dx%d, 800 m above ground\n", buildings, width, height);
    bench::race(contenders, frames);
    const double plain = median(contenders[0]), still = median(contenders[1]);
    std::printf("  sun still: blend adds %.0f %% of the frame (goal 25), relight %.0f %% (goal 60)\n",
                100.0 * (still / plain - 1.0), 100.0 * (median(contenders[2]) / plain - 1.0));
    std::printf("  sun at 60 x real time: the update takes %.2f ms a frame (goal 2); after a jump %.1f ms\n",
                median(contenders[3]) - still, median(contenders[4]) - still);
    std::printf("  %u tiles may be seen, of which the moving sun has %.1f found a frame\n", foundIn(setups[1]),
                (foundIn(setups[3]) - foundIn(setups[1])) / double(sun.frames()));
    return rightPicture(town, view);
}

int measure(osg::ArgumentParser& arguments) {
    int buildings = 100000;
    const auto frames =
        bench::framesAsked(arguments, "Cost of the shadows of a town on mountains; medians of interleaved frames.",
                           {{"--objects", "N", "buildings, 1 to 1000000", "100000", [&](const std::string& value) {
                                 buildings = gnomon::examples::readWhole(value, 1, 1000000);
                             }}});
    if (!frames) return 0;
    return run(buildings, *frames) ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_town_frame", argc, argv, measure); }
