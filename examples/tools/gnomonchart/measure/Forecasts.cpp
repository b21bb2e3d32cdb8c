// SPDX-License-Identifier: MIT
#include "Forecasts.h"
#include "StageViewer.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

bool isSame(const ShadowMapOptions& a, const ShadowMapOptions& b) {
    return a.size == b.size && a.filter == b.filter && a.cascades == b.cascades && a.edges == b.edges;
}

bool isSame(const ShadowSpec& a, const ShadowSpec& b) { return a.technique == b.technique && isSame(a.map, b.map); }

const ShadowCandidate* exactly(const std::vector<ShadowCandidate>& candidates, const ShadowSpec& spec) {
    for (const ShadowCandidate& candidate : candidates)
        if (candidate.obstacle.empty() && !candidate.mixed && isSame(parseShadowSpec(candidate.spec), spec))
            return &candidate;
    return nullptr;
}

const std::string* specOf(const Contender& contender) {
    for (const auto& [name, value] : contender.settings)
        if (name == "--shadow") return &value;
    return nullptr;
}

} // namespace

/// Where as many cascades as the size asks for are one, auto has the candidate of one alone.
const ShadowCandidate* candidateOf(const std::vector<ShadowCandidate>& candidates, const ShadowSpec& spec) {
    if (const ShadowCandidate* same = exactly(candidates, spec)) return same;
    if (spec.technique != "map" || spec.map.cascades != 0) return nullptr;
    ShadowSpec one = spec;
    one.map.cascades = 1;
    return exactly(candidates, one);
}

const std::vector<ShadowCandidate>& Forecasts::candidates(const Way& way) {
    const auto [known, isNew] = _candidates.try_emplace(way);
    if (!isNew) return known->second;
    const std::string spec = std::string("auto") + (way.first ? ":composite=blend" : "");
    StageViewer viewer(gnomonContender(spec, way.second).stage(_scene, Look::SHADED), _scene.camera,
                       StageViewer::Colour::BYTES);
    viewer.draw();
    const std::vector<ShadowDecision> decisions = viewer.staging().decisions();
    if (!decisions.empty()) known->second = decisions.front().candidates;
    return known->second;
}

std::optional<ChartPrediction> Forecasts::of(const Contender& contender) {
    const std::string* text = specOf(contender);
    if (!text) return std::nullopt;
    const ShadowSpec spec = parseShadowSpec(*text);
    const bool blends = spec.composite == ShadowCasterGroup::BLEND;
    const ShadowCandidate* found = candidateOf(candidates({blends, contender.receives}), spec);
    if (!found) return std::nullopt;
    ChartPrediction result{found->spec, std::nullopt, {found->spec, found->flying}, {found->spec, found->moving}};
    if (contender.receives == Receives::EVERYTHING) result.error = found->error;
    return result;
}

} // namespace gnomon::examples
