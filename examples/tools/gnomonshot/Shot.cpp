// SPDX-License-Identifier: MIT
#include "Shot.h"
#include "FrameTime.h"
#include "SceneCamera.h"
#include "SceneTruth.h"

#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/VertexTraverser.h>

#include <osg/DisplaySettings>
#include <osg/Stats>

#include <stdexcept>
#include <sys/resource.h>

namespace gnomon::examples {
namespace {

constexpr int mostFrames = 100000;

using Text = const std::string&;

void addShotOptions(Options& table, ShotOptions& into) {
    table.push_back({"--frames", "N", "frames to draw before the picture is taken, 1 to 100000", "1, with --stats 20",
                     [&into](Text t) { into.frames = readWhole(t, 1, mostFrames); }});
    table.push_back({"--out", "IMAGE", "picture to write; its ending chooses among OpenSceneGraph's formats", "none",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--stats", "FILE.json",
                     "measurements to write; times of whole frames in ms: msFirst, msSteady, msMoving (the light "
                     "turns\n      1 degree a frame about the z axis) and msNone (without shadows, interleaved)",
                     "none", [&into](Text t) { into.stats = t; }});
    table.push_back({"--truth", "FILE.osgb",
                     "true shadows of this view by ray casting, for gnomoncompare; needs one light and all casters",
                     "none", [&into](Text t) { into.truth = t; }});
    table.push_back({"--recommend", "",
                     "print what could draw each light's shadow, with predicted errors and times; the choice of\n"
                     "      --shadow auto first",
                     "", [&into](Text) { into.recommend = true; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
}

Options shotOptions(ShotOptions& into) {
    Options table = viewOptions(into.view);
    addShotOptions(table, into);
    return table;
}

void requireOutput(const ShotOptions& options) {
    if (options.out.empty() && options.stats.empty() && options.truth.empty() && !options.recommend)
        throw std::invalid_argument(
            "no output is asked for. Give --out IMAGE, --stats FILE.json, --truth FILE.osgb or --recommend.");
    if (!options.truth.empty() && options.view.casters != "all")
        throw std::invalid_argument(
            "--truth and --casters exclude each other. Give one of them: the truth is that of all casters.");
}

void requireAuto(ShotOptions& options) {
    const std::vector<ShadowSpec>& shadows = options.view.shadows;
    if (!options.recommend) return;
    options.view.isUsual = false;
    if (shadows.size() > 1 || shadows.front().technique != "auto")
        throw std::invalid_argument(
            "--recommend needs --shadow auto and no other. Leave --shadow out, or give its budget.");
}

constexpr int warmUpFrames = 3; // OSG keeps two scene views; each compiles and settles in its first frame

HeadlessContext::Options contextOptions(const ShotOptions& options) {
    HeadlessContext::Options result;
    result.width = options.view.width;
    result.height = options.view.height;
    return result;
}

nlohmann::json quartilesJson(const std::vector<double>& times) {
    const Quartiles q = quartiles(times);
    return {{"q1", q.q1}, {"median", q.median}, {"q3", q.q3}};
}

nlohmann::json decisionsJson(const std::vector<ShadowDecision>& decisions) {
    nlohmann::json result = nlohmann::json::array();
    for (const ShadowDecision& decision : decisions)
        result.push_back({{"light", decision.light},
                          {"receivers", decision.receivers},
                          {"spec", decision.chosen.spec},
                          {"reason", decision.reason},
                          {"keepsBudget", decision.keepsBudget},
                          {"error", decision.chosen.error},
                          {"ms", {{"still", decision.chosen.still}, {"moving", decision.chosen.moving}}},
                          {"decisions", decision.decisions},
                          {"changes", decision.changes}});
    return result;
}

double peakMiB() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

} // namespace

ShotOptions readShotOptions(osg::ArgumentParser& arguments) {
    ShotOptions options;
    readOptions(arguments, shotOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    readFiles(arguments, options.view);
    takeUsualShadow(options.view);
    requireOutput(options);
    requireConsistent(options.view);
    requireAuto(options);
    return options;
}

std::string shotHelp() {
    ShotOptions defaults;
    return "gnomonshot FILE... [OPTION...]\nRenders scene files with shadows to an image, without a display or "
           "GPU.\n\nLengths are in the scene's unit. The z axis points up.\n\n" +
           describeOptions(shotOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() +
           "\nExample: gnomonshot bunny.obj --out bunny.png\n";
}

Shot::Shot(const ShotOptions& options, osg::Node& files)
    : _options(options), _context(contextOptions(options)), _setup(setUpScene(options.view, files)) {
    osg::DisplaySettings::instance()->setMinimumNumStencilBits(8);
    _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    _context.attach(*_viewer.getCamera());
    placeCamera(*_viewer.getCamera(), options.view, _setup.bounds);
    _viewer.setSceneData(_setup.root);
}

void Shot::draw() {
    for (int i = 0; i < _options.frameCount(); ++i) _viewer.frame();
}

nlohmann::json Shot::measure() {
    std::array<std::vector<unsigned>, 3> maps;
    const double first = timedFrame(true);
    maps[0] = mapsDrawn();
    for (int i = 0; i < warmUpFrames; ++i) timedFrame(true), timedFrame(false);
    std::vector<double> steady, moving, none;
    const auto time = [&](std::vector<double>& into, double turn) {
        for (int i = 0; i < _options.frameCount(); ++i) {
            if (turn != 0.0) _setup.lights->turn((i + 1) * turn);
            into.push_back(timedFrame(true));
            none.push_back(timedFrame(false));
        }
        return mapsDrawn();
    };
    maps[1] = time(steady, 0.0);
    const std::vector<ShadowDecision> still = decisions();
    maps[2] = time(moving, 1.0);
    _setup.lights->turn(0.0);
    const unsigned draws = countDraws();
    return {{"renderer", _context.renderer()},
            {"technique", techniqueNames(_options.view.shadows)},
            {"diagnosis", diagnose()},
            {"triangles", countTriangles()},
            {"draws", draws},
            {"shadowPasses", shadowPasses(maps)},
            {"decisions", decisionsJson(still)},
            {"msFirst", first},
            {"msSteady", quartilesJson(steady)},
            {"msMoving", quartilesJson(moving)},
            {"msNone", quartilesJson(none)},
            {"peakMiB", peakMiB()}};
}

std::vector<ShadowDecision> Shot::decisions() const {
    std::vector<ShadowDecision> result;
    for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques)
        for (const ShadowDecision& decision : technique->lastDecision()) result.push_back(decision);
    return result;
}

metrics::TruthMaps Shot::truth() {
    const std::vector<osg::Vec4d> lights = _setup.lights->places();
    if (lights.size() != 1)
        throw std::runtime_error("--truth needs exactly one light, but the scene has " + std::to_string(lights.size()) +
                                 ".");
    const SceneCamera camera =
        sceneCamera(*_viewer.getCamera(), _options.view.width, _options.view.height, sceneBounds(*_setup.group));
    return SceneTruth(*_setup.group).maps(camera, lights.front());
}

double Shot::timedFrame(bool shadows) {
    _setup.show(shadows);
    return timeFrame(_viewer).wall;
}

/// Drawables of the scene's own draw; OSG counts them, outside the timed frames. Leaves the picture as it is to be
/// shown.
unsigned Shot::countDraws() {
    osg::Stats* stats = _viewer.getCamera()->getStats();
    stats->collectStats("scene", true);
    timedFrame(true);
    stats->collectStats("scene", false);
    double draws = 0.0;
    stats->getAttribute(_viewer.getFrameStamp()->getFrameNumber(), "Visible number of drawables", draws);
    return static_cast<unsigned>(draws);
}

std::vector<unsigned> Shot::mapsDrawn() const {
    std::vector<unsigned> drawn;
    for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques) {
        const auto* map = dynamic_cast<const ShadowMapTechnique*>(technique.get());
        drawn.push_back(map ? map->passes() : 0);
    }
    return drawn;
}

nlohmann::json Shot::shadowPasses(const std::array<std::vector<unsigned>, 3>& maps) const {
    nlohmann::json passes = nlohmann::json::array();
    for (std::size_t i = 0; i < _setup.techniques.size(); ++i) {
        const ShadowTechnique* technique = _setup.techniques[i];
        nlohmann::json entry = {{"technique", technique->getName()}, {"lights", _setup.lights->count()}};
        if (const auto* planar = dynamic_cast<const PlanarShadowNode*>(technique))
            entry["planes"] = planar->getPlanes().size();
        else if (dynamic_cast<const ShadowMapTechnique*>(technique))
            entry["maps"] = {
                {"first", maps[0][i]}, {"still", maps[1][i] - maps[0][i]}, {"moving", maps[2][i] - maps[1][i]}};
        else
            continue;
        passes.push_back(entry);
    }
    return passes;
}

std::size_t Shot::countTriangles() const {
    VertexTraverser traverser;
    _setup.group->accept(traverser);
    return traverser.getTriangles().size() / 3;
}

} // namespace gnomon::examples
