// SPDX-License-Identifier: MIT
// What the shadows of a town on mountains add to a frame, 800 m above ground: with the sun still, with the sun at 60 times
// its pace, and after a jump of an hour; and with volumes of what is near the eye, so that walls receive, too. In one
// interleaved run. The pictures are checked.
#include "Contenders.h"

#include <FrameTime.h>
#include <InputFile.h>
#include <Town.h>

#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>

#include <cstdio>

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

constexpr double nearEye = 1500.0; // metres

/// The town's nodes, each of some neighbouring buildings, that are near the eye.
std::vector<osg::ref_ptr<osg::Node>> nearNodes(osg::Node& scene, const osg::Vec3d& eye) {
    std::vector<osg::ref_ptr<osg::Node>> result;
    osg::Group& town = *test::find(scene, "town")->asGroup();
    for (unsigned kind = 0; kind < town.getNumChildren(); ++kind) {
        osg::Group& quarter = *town.getChild(kind)->asGroup();
        for (unsigned i = 0; i < quarter.getNumChildren(); ++i)
            if ((osg::Vec3d(quarter.getChild(i)->getBound().center()) - eye).length() < nearEye)
                result.push_back(quarter.getChild(i));
    }
    return result;
}

/// Beside hull for all, volumes for what is near: both mark for the same light. @return how many nodes are near.
std::size_t addVolumes(const SceneSetup& setup, const osg::Vec3d& eye) {
    const osg::ref_ptr<osg::Node> scene = setup.group->getChild(0);
    gnomon::Selection casters;
    casters.others = nearNodes(*scene, eye);
    if (casters.others.empty()) return 0;
    casters.node = casters.others.front();
    const std::size_t count = casters.others.size();
    osg::ref_ptr<gnomon::ShadowCasterGroup> inner = new gnomon::ShadowCasterGroup;
    inner->setComposite(setup.group->getComposite());
    inner->setDark(setup.group->getDark());
    inner->setCasters(casters);
    inner->addChild(scene);
    inner->addChild(new gnomon::ShadowVolumeTechnique);
    setup.group->setChild(0, inner);
    return count;
}

test::View viewOf(const TownScene& town) {
    const auto& view = town.view();
    // Nothing is nearer than 300 m: with a near plane at 10 m, by depths of 24 bits solids take 1.3 % of the shadows' pixels for others.
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

/// Against rays, which meet the terrain, too: what they alone have in shadow may be its own.
bool rightPicture(const TownScene& town, const test::View& view) {
    const auto picture = [&](const std::string& shadow, const gnomon::CompositorOptions& options = {}) {
        const SceneSetup setup = setUp(town, shadow);
        return test::render(test::withOptions(setup.root, options), view);
    };
    const test::Picture plain = picture("none"), hull = picture("hull"), exact = picture("traced");
    const int culled = picture("hull", {0, false}).different(hull);
    int shadow = 0, wrong = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
        shadow += hull.pixels[i] != plain.pixels[i];
        wrong += hull.pixels[i] != plain.pixels[i] && exact.pixels[i] == plain.pixels[i];
    }
    std::printf("  picture: %d pixels in shadow, %d of them lit by rays; culling changes %d\n", shadow, wrong, culled);
    const SceneSetup near = setUp(town, "hull");
    addVolumes(near, *town.view().eye);
    const test::Picture walls = test::render(near.root, view);
    int added = 0, lost = 0;
    for (std::size_t i = 0; i < walls.pixels.size(); ++i) {
        added += walls.pixels[i] != plain.pixels[i] && hull.pixels[i] == plain.pixels[i];
        lost += walls.pixels[i] == plain.pixels[i] && hull.pixels[i] != plain.pixels[i];
    }
    std::printf("  picture with volumes of what is near: %d more pixels in shadow, %d fewer\n", added, lost);
    return shadow > 0 && wrong < shadow / 100 && culled == 0 && added > 0 && lost == 0;
}

bool run(int buildings, int frames) {
    const auto field = gnomon::examples::readElevation(GNOMON_JACKSBORO, "bench_town_frame");
    TownScene town({}, 9.0, *field, {buildings});
    const test::View view = viewOf(town);
    const double pacePerFrame = 360.0 / 86400.0 * pace / framesASecond;
    std::vector<SceneSetup> setups;
    for (const char* shadow : {"none", "hull:composite=blend", "hull", "hull:composite=blend", "hull:composite=blend",
                               "hull:composite=blend"})
        setups.push_back(setUp(town, shadow));
    const char* const names[] = {"none", "blend", "relight", "60 x real time", "an hour a frame", "near: volume"};
    std::vector<bench::Contender> contenders;
    for (std::size_t i = 0; i < setups.size(); ++i)
        contenders.push_back(bench::contender(names[i], setups[i].root, view));
    Turning sun(setups[3], *town.view().center, pacePerFrame);
    contenders[3].before = [&] { sun(); };
    contenders[4].before = Turning(setups[4], *town.view().center, 15.0);
    const std::size_t near = addVolumes(setups[5], *town.view().eye);
    std::printf("%d buildings, %dx%d, 800 m above ground\n", buildings, width, height);
    bench::race(contenders, frames);
    const double plain = median(contenders[0]);
    const auto more = [&](int contender) { return 100.0 * (median(contenders[std::size_t(contender)]) / plain - 1.0); };
    std::printf("  sun still: blend adds %.0f %% of the frame, relight %.0f %%\n", more(1), more(2));
    std::printf("  with volumes of %zu groups of buildings within %.0f m of the eye: %.0f %%\n", near, nearEye,
                more(5));
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
