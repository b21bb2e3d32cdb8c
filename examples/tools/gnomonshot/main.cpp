// SPDX-License-Identifier: MIT
// gnomonshot: scene files in, a picture with shadows out; no display, no GPU.
#include "OutputFile.h"
#include "SceneFile.h"
#include "Shot.h"
#include "TruthFile.h"

#include <gnomon/ShadowDecision.h>
#include <gnomon/ShadowSpec.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

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
    if (candidate.mixed)
        return "group->addChild(new gnomon::AutoShadowTechnique); // it alone gives each technique its casters";
    const ShadowSpec parsed = parseShadowSpec(candidate.spec);
    if (parsed.technique == "map") return cppFor(parsed.map);
    if (parsed.technique == "hull")
        return "auto* shadow = new gnomon::TerrainShadowGeode; shadow->setReceiver({terrain}); "
               "group->addChild(shadow);";
    if (parsed.technique == "planar")
        return "group->addChild(new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0))); // your receiver's plane";
    if (parsed.technique == "volume") return "group->addChild(new gnomon::ShadowVolumeTechnique);";
    if (parsed.technique == "traced") return "group->addChild(new gnomon::TracedShadowTechnique);";
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
    nlohmann::json measured;
    stats ? void(measured = shot.measure()) : shot.draw();
    for (const std::string& cause : shot.diagnose()) std::cerr << "gnomonshot: note: " << cause << std::endl;
    if (options.recommend) std::cout << recommendation(shot.decisions());
    if (picture) picture->write(*shot.picture());
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
