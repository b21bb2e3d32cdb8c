// SPDX-License-Identifier: MIT
#include "PredictionSummary.h"

#include "Figure.h"
#include "GnuplotText.h"
#include "JsonFields.h"

#include <gnomon/ShadowSpec.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::examples {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::array tuningScenes = {"lab8-45", "lab8-10", "bunny-45", "bunny-10",
                                     "town-45", "town-10", "town-utm", "street"};

/// Those whose shadow falls on a named receiver alone.
constexpr std::array groundTechniques = {"planar", "box", "hull", "drape"};

constexpr std::array motions = {LightMotion::Still, LightMotion::Moving};

std::string specOf(const ChartPoint& point) {
    for (const auto& [name, value] : point.settings)
        if (name == "--shadow") return value;
    return "none";
}

double errorOf(const ChartPoint& point) {
    if (point.catastrophic() || !point.errors || !point.errors->boundary) return infinity;
    return point.errors->boundary->p95;
}

double timeOf(const ChartPoint& point, LightMotion light) {
    return (light == LightMotion::Still ? point.cost->steadyProcessor : point.cost->movingProcessor).median;
}

double predictedTimeOf(const ChartPrediction& prediction, LightMotion light) {
    return (light == LightMotion::Still ? prediction.steady : prediction.moving).time;
}

void addPoint(PredictionShare& share, const ChartPoint& point) {
    if (!point.prediction || !point.failure.empty()) return;
    if (point.prediction->error && point.errors && (point.errors->boundary || point.catastrophic())) {
        ++share.errors;
        share.errorsHeld += isWithin(*point.prediction->error, errorOf(point), errorFactor) ? 1 : 0;
    }
    if (!point.cost) return;
    for (const LightMotion light : motions) {
        ++share.times;
        share.timesHeld +=
            isWithin(predictedTimeOf(*point.prediction, light), timeOf(point, light), timeFactor) ? 1 : 0;
    }
}

/// Share of the pixels away from edges.
double wrongOf(const ChartPoint& point) {
    return point.errors ? point.errors->headline.misclassified().value_or(0.0) : infinity;
}

/// What a setting of auto is held against in one scene.
class Judge {
public:
    Judge(const ChartResults& results, const ChartPoint& automatic, LightMotion light)
        : _results(results), _automatic(automatic), _spec(parseShadowSpec(specOf(automatic))), _light(light) {
        const AutoShadowOptions& budget = _spec.budget;
        if (!(budget.error > 0.0) && budget.time > 0.0)
            _time = budget.time;
        else
            _error = budget.error > 0.0 ? budget.error : AutoShadowOptions::usualError;
    }

    AutoOutcome outcome() const {
        AutoOutcome result;
        result.scene = _automatic.scene;
        result.setting = _automatic.setting;
        result.light = _light;
        result.error = errorOf(_automatic);
        result.time = timeOf(_automatic, _light);
        result.keepsBudget = std::isfinite(result.error) && result.error <= _error && result.time <= timeSlack * _time;
        if (const ChartPoint* best = this->best()) {
            result.best = best->technique + ", " + best->setting;
            result.ratio = measureOf(_automatic) / measureOf(*best);
        }
        return result;
    }

private:
    bool isRival(const ChartPoint& point) const {
        return point.scene == _automatic.scene && point.ours() && point.technique != _automatic.technique &&
               point.cost && errorOf(point) <= std::min(_error, std::numeric_limits<double>::max()) &&
               timeOf(point, _light) <= _time && drawsAll(point) &&
               parseShadowSpec(specOf(point)).composite == _spec.composite;
    }

    /// A shadow on the ground alone is no bargain where other things should have some.
    bool drawsAll(const ChartPoint& point) const {
        const auto isIts = [&](const char* name) { return parseShadowSpec(specOf(point)).technique == name; };
        return std::none_of(groundTechniques.begin(), groundTechniques.end(), isIts) ||
               wrongOf(point) <= wrongOf(_automatic);
    }

    const ChartPoint* best() const {
        const ChartPoint* best = nullptr;
        for (const ChartPoint& point : _results.points)
            if (isRival(point) && (!best || measureOf(point) < measureOf(*best))) best = &point;
        return best;
    }

    /// What is to be little.
    double measureOf(const ChartPoint& point) const {
        return std::isfinite(_error) ? std::max(timeOf(point, _light), leastShownTime) : errorOf(point);
    }

    const ChartResults& _results;
    const ChartPoint& _automatic;
    const ShadowSpec _spec;
    const LightMotion _light;
    double _error = infinity, _time = infinity;
};

std::string percent(std::size_t part, std::size_t whole) {
    return std::to_string(std::lround(100.0 * double(part) / double(whole))) + " %";
}

void addSentences(std::vector<std::string>& all, const PredictionHalf& half, const std::string& scenes) {
    const PredictionShare& share = half.share;
    if (share.errors > 0)
        all.push_back(scenes + ": " + percent(share.errorsHeld, share.errors) + " of " + std::to_string(share.errors) +
                      " predicted errors are within a factor of " + plotNumber(errorFactor) + ".");
    if (share.times > 0)
        all.push_back(scenes + ": " + percent(share.timesHeld, share.times) + " of " + std::to_string(share.times) +
                      " predicted times are within a factor of " + plotNumber(timeFactor) + ".");
    std::size_t possible = 0, kept = 0, good = 0;
    for (const AutoOutcome& outcome : half.outcomes) {
        if (!outcome.ratio) continue;
        ++possible;
        kept += outcome.keepsBudget ? 1 : 0;
        good += outcome.keepsBudget && *outcome.ratio <= ratioSlack ? 1 : 0;
    }
    if (possible > 0)
        all.push_back(scenes + ": auto keeps " + std::to_string(kept) + " of " + std::to_string(possible) +
                      " budgets that a fixed setting keeps. In " + std::to_string(good) +
                      " of them it is as good as the best fixed setting, within a factor of " + plotNumber(ratioSlack) +
                      ".");
}

nlohmann::ordered_json outcomeJson(const AutoOutcome& outcome) {
    return {{"scene", outcome.scene},
            {"setting", outcome.setting},
            {"light", outcome.light == LightMotion::Still ? "still" : "moving"},
            {"boundaryP95Pixels", jsonOf(outcome.error)},
            {"processorMs", jsonOf(outcome.time)},
            {"keepsBudget", outcome.keepsBudget},
            {"bestFixed", outcome.best},
            {"ratio", jsonOf(outcome.ratio)}};
}

nlohmann::ordered_json halfJson(const PredictionHalf& half) {
    nlohmann::ordered_json outcomes = nlohmann::ordered_json::array();
    for (const AutoOutcome& outcome : half.outcomes) outcomes.push_back(outcomeJson(outcome));
    return {{"errors", half.share.errors},
            {"errorsHeld", half.share.errorsHeld},
            {"times", half.share.times},
            {"timesHeld", half.share.timesHeld},
            {"budgets", outcomes}};
}

} // namespace

bool isTuningScene(const std::string& scene) {
    return std::find(tuningScenes.begin(), tuningScenes.end(), scene) != tuningScenes.end();
}

bool isWithin(double a, double b, double factor) { return a > 0.0 && b > 0.0 && a <= factor * b && b <= factor * a; }

PredictionSummary predictionSummary(const ChartResults& results) {
    PredictionSummary summary;
    for (const ChartPoint& point : results.points) {
        PredictionHalf& half = isTuningScene(point.scene) ? summary.tuned : summary.other;
        addPoint(half.share, point);
        if (!point.ours() || parseShadowSpec(specOf(point)).technique != "auto" || !point.cost) continue;
        for (const LightMotion light : motions) half.outcomes.push_back(Judge(results, point, light).outcome());
    }
    return summary;
}

std::vector<std::string> sentencesOf(const PredictionSummary& summary) {
    std::vector<std::string> all;
    addSentences(all, summary.tuned, "Scenes that auto was built on");
    addSentences(all, summary.other, "Other scenes");
    return all;
}

nlohmann::ordered_json jsonOf(const PredictionSummary& summary) {
    return {{"builtOn", halfJson(summary.tuned)}, {"others", halfJson(summary.other)}};
}

} // namespace gnomon::examples
