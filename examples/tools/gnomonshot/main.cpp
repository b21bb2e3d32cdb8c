// SPDX-License-Identifier: MIT
// gnomonshot: scene files in, a picture with shadows out; no display, no GPU.
#include "FrameTime.h"
#include "ImageFile.h"
#include "InputFile.h"
#include "OutputFile.h"
#include "ScenePicture.h"
#include "SceneSetup.h"
#include "SceneTruth.h"
#include "TimeLeft.h"

#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowDecision.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/VertexTraverser.h>

#include <nlohmann/json.hpp>
#include <osg/Stats>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

/// What gnomonshot's command line asks for.
struct ShotOptions {
    ShotOptions() {
        view.usualShadow = "auto:error=0.25";
    } // samples would show the texels of maps that just keep 1 pixel

    ViewOptions view = pictureOptions(8);
    std::optional<int> frames; ///< 1, or 20 with stats.
    std::string out;           ///< picture; empty: none.
    std::string stats;         ///< JSON file; empty: none.
    std::string truth;         ///< file of what is true; empty: none.
    bool recommend = false;    ///< print what could draw the shadows.
    bool help = false;

    int frameCount() const { return frames.value_or(stats.empty() ? 1 : 20); }
};

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
    std::vector<ShadowSpec>& shadows = options.view.shadows;
    if (!options.recommend) return;
    if (options.view.isUsual)
        shadows = {parseShadowSpec("auto")}; // programs draw frames, not a picture of many samples
    options.view.isUsual = false;
    if (shadows.size() > 1 || shadows.front().technique != "auto")
        throw std::invalid_argument(
            "--recommend needs --shadow auto and no other. Leave --shadow out, or give its budget.");
}

ShotOptions readShotOptions(osg::ArgumentParser& arguments) {
    ShotOptions options;
    readViewOptions(arguments, shotOptions(options), options.view, options.help);
    if (options.help) return options;
    requireOutput(options);
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

constexpr int warmUpFrames = 3; // OSG keeps two scene views; each compiles and settles in its first frame

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

/// A viewer of one scene that draws into memory, and times what it draws.
class Shot {
public:
    Shot(const ShotOptions& options, osg::Node& files)
        : _options(options), _setup(setUpScene(options.view, files)), _picture(options.view, _setup) {}

    /// Draws the frames asked for; nothing is timed.
    void draw() {
        TimeLeft progress = progressOf(_options.frameCount());
        for (int i = 0; i < _options.frameCount(); ++i) {
            progress.show(i, "frame " + std::to_string(i + 1) + " of " + std::to_string(_options.frameCount()));
            _picture.frame();
        }
    }
    /// A line for what takes long: at once where a picture is large.
    TimeLeft progressOf(double work) const {
        const bool isLarge = double(_options.view.width) * _options.view.height > 1e7;
        return TimeLeft(work, isLarge ? 0.0 : 1.0);
    }

    /// Draws and times frames: still ones, then ones under a moving light, each beside one without shadows.
    /// @return what --stats writes.
    nlohmann::json measure() {
        std::array<std::vector<unsigned>, 3> maps;
        const double first = timedFrame(true);
        maps[0] = mapsDrawn();
        for (int i = 0; i < warmUpFrames; ++i) timedFrame(true), timedFrame(false);
        std::vector<double> steady, moving, none;
        TimeLeft progress = progressOf(2.0 * _options.frameCount());
        const auto time = [&](std::vector<double>& into, double turn) {
            for (int i = 0; i < _options.frameCount(); ++i) {
                progress.show(double(none.size()), turn != 0.0 ? "frames under a moving light" : "still frames");
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
        return {{"renderer", _picture.context().renderer()},
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

    osg::ref_ptr<osg::Image> picture() { return _picture.image(); }
    /// What is true of the picture. @throws std::runtime_error, one sentence, if there is not one light.
    metrics::TruthMaps truth() {
        const std::vector<osg::Vec4d> lights = _setup.lights->places();
        if (lights.size() != 1)
            throw std::runtime_error("--truth needs exactly one light, but the scene has " +
                                     std::to_string(lights.size()) + ".");
        const SceneCamera camera = sceneCamera(*_picture.viewer().getCamera(), _options.view.width,
                                               _options.view.height, sceneBounds(*_setup.group));
        return SceneTruth(*_setup.group, Clear::PASSES).maps(camera, lights.front());
    }

    std::vector<std::string> diagnose() const { return _setup.diagnose(); }
    std::vector<std::string> notes() const { return _setup.notes(); }
    /// What each light's shadow was drawn by, where that is chosen automatically.
    std::vector<ShadowDecision> decisions() const {
        std::vector<ShadowDecision> result;
        for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques)
            for (const ShadowDecision& decision : technique->lastDecision()) result.push_back(decision);
        return result;
    }

private:
    double timedFrame(bool shadows) {
        _setup.show(shadows);
        return timeFrame(_picture.viewer(), _picture.nextTime()).wall;
    }

    /// Drawables of the scene's own draw; OSG counts them, outside the timed frames. Leaves the picture as it is to be
    /// shown.
    unsigned countDraws() {
        osg::Stats* stats = _picture.viewer().getCamera()->getStats();
        stats->collectStats("scene", true);
        timedFrame(true);
        stats->collectStats("scene", false);
        double draws = 0.0;
        stats->getAttribute(_picture.viewer().getFrameStamp()->getFrameNumber(), "Visible number of drawables", draws);
        return static_cast<unsigned>(draws);
    }

    /// Depth maps that the technique at each place has drawn so far; 0 of one that draws none.
    std::vector<unsigned> mapsDrawn() const {
        std::vector<unsigned> drawn;
        for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques) {
            const auto* map = dynamic_cast<const ShadowMapTechnique*>(technique.get());
            drawn.push_back(map ? map->passes() : 0);
        }
        return drawn;
    }

    /// @param maps  drawn after the first frame, after the still ones and after those under a moving light.
    nlohmann::json shadowPasses(const std::array<std::vector<unsigned>, 3>& maps) const {
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

    std::size_t countTriangles() const {
        VertexTraverser traverser;
        _setup.group->accept(traverser);
        return traverser.getTriangles().size() / 3;
    }

    ShotOptions _options;
    SceneSetup _setup;
    ScenePicture _picture;
};

std::string nameOf(const ShadowCandidate& candidate) { return candidate.spec.substr(0, candidate.spec.find(':')); }

std::string cppFor(const ShadowMapOptions& map) {
    constexpr const char* filters[] = {"NEAREST", "BILINEAR", "BICUBIC", "FINE"};
    const ShadowMapOptions plain;
    const std::string scope = "gnomon::ShadowMapOptions::";
    std::string text = "auto* shadow = new gnomon::ShadowMapTechnique; ";
    const auto set = [&text](const std::string& call) { text += "shadow->" + call + "; "; };
    if (map.size != plain.size) set("setSize(" + std::to_string(map.size) + ")");
    if (map.filter != plain.filter) set("setFilter(" + scope + filters[map.filter] + ")");
    if (map.cascades != plain.cascades) set("setCascades(" + std::to_string(map.cascades) + ")");
    if (map.edges == ShadowMapOptions::SMOOTH) set("setEdges(" + scope + "SMOOTH)");
    return text + "group->addChild(shadow);";
}

void addLine(std::ostream& out, const ShadowCandidate& candidate) {
    out << "  " << std::left << std::setw(44) << candidate.spec << std::right << std::fixed << std::setprecision(2)
        << std::setw(8) << candidate.error << std::setw(9) << candidate.still << std::setw(9) << candidate.moving;
    if (!candidate.obstacle.empty()) out << "  not here: " << candidate.obstacle;
    out << "\n";
}

/// Of each technique but the chosen one the cheapest that is as accurate as it, else the most accurate.
std::vector<ShadowCandidate> othersOf(const ShadowDecision& decision) {
    std::vector<ShadowCandidate> result;
    std::set<std::string> known = {nameOf(decision.chosen)};
    const auto better = [&](const ShadowCandidate& a, const ShadowCandidate& b) {
        const double least = std::max(decision.chosen.error, 0.0);
        const auto key = [least](const ShadowCandidate& c) { return std::make_pair(std::max(c.error, least), c.time); };
        return key(a) < key(b);
    };
    for (const ShadowCandidate& candidate : decision.candidates) {
        if (!known.insert(nameOf(candidate)).second) continue;
        const ShadowCandidate* best = &candidate;
        for (const ShadowCandidate& other : decision.candidates)
            if (nameOf(other) == nameOf(candidate) && better(other, *best)) best = &other;
        result.push_back(*best);
    }
    return result;
}

/// A line of C++ that adds a candidate's technique to a group.
std::string cppFor(const ShadowCandidate& candidate) {
    const ShadowSpec parsed = parseShadowSpec(candidate.spec);
    if (parsed.technique == "map") return cppFor(parsed.map);
    const auto exact = [](const std::string& name, bool smooth, const std::string& receiver) {
        const std::string edges = smooth ? "shadow->setEdges(gnomon::" + name + "::SMOOTH); " : "";
        return "auto* shadow = new gnomon::" + name + "; " + receiver + edges + "group->addChild(shadow);";
    };
    if (parsed.technique == "hull")
        return exact("TerrainShadowGeode", parsed.hull.fades(), "shadow->setReceiver({terrain}); ");
    if (parsed.technique == "volume") return exact("ShadowVolumeTechnique", parsed.volume.fades(), "");
    if (parsed.technique == "traced") return exact("TracedShadowTechnique", parsed.traced.fades(), "");
    return "// none is needed";
}

/// For each light a table of what could draw its shadow: of each technique the best, the choice first.
std::string recommendation(const std::vector<ShadowDecision>& decisions) {
    std::ostringstream out;
    if (decisions.empty()) out << "no light and no caster is in sight, so there is nothing to recommend\n";
    for (const ShadowDecision& decision : decisions) {
        out << decision.subject() << ": " << decision.chosen.spec << ", " << decision.reason << "\n\n"
            << "  --shadow                                      error,   still,  moving,\n"
            << "                                                   px       ms       ms\n";
        addLine(out, decision.chosen);
        for (const ShadowCandidate& candidate : othersOf(decision)) addLine(out, candidate);
        out << "\n  in C++: " << cppFor(decision.chosen) << "\n";
    }
    return out.str();
}

void shoot(const ShotOptions& options) {
    std::optional<OutputFile> picture, stats, truth;
    if (!options.out.empty()) picture.emplace(options.out).requireImage();
    if (!options.stats.empty()) stats.emplace(options.stats);
    if (!options.truth.empty()) truth.emplace(options.truth).requireData();
    Shot shot(options, *readScene(options.view.files, "gnomonshot"));
    for (const std::string& note : shot.notes()) std::cerr << "gnomonshot: note: " << note << std::endl;
    nlohmann::json measured;
    stats ? void(measured = shot.measure()) : shot.draw();
    for (const std::string& cause : shot.diagnose()) std::cerr << "gnomonshot: note: " << cause << std::endl;
    if (options.recommend) std::cout << recommendation(shot.decisions());
    if (picture) {
        TimeLeft progress = shot.progressOf(1.0);
        progress.show(0.0, "writing " + options.out);
        picture->write(*shot.picture());
    }
    if (truth) truth->writeData(*truthImage(shot.truth()));
    if (stats) stats->write(measured.dump(2) + "\n");
}

int run(osg::ArgumentParser& arguments) {
    const ShotOptions options = readShotOptions(arguments);
    if (options.help)
        std::cout << shotHelp();
    else
        shoot(options);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("gnomonshot", argc, argv, run); }
