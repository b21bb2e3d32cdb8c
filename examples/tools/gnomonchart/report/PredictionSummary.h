// SPDX-License-Identifier: MIT
#pragma once
#include "Curves.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gnomon::examples {

/// Whether the constants of auto's model may be fitted to a scene. About half of the built-in scenes are; the others show
/// what the model is worth elsewhere. A model or a town is never in both halves, under another sun or from another place:
/// else the other half would be known, too. A file of the user's own is in the other half.
bool isTuningScene(const std::string& scene);

/// How far a prediction may be off, as a factor either way.
constexpr double errorFactor = 1.5, timeFactor = 2.0;

/// True if neither value is more than `factor` times the other. Values of 0 or less, and NaN, are within no factor.
bool isWithin(double a, double b, double factor);

/// Predictions that can be compared with what was measured.
struct PredictionShare {
    std::size_t errors = 0, errorsHeld = 0; ///< one a point. A catastrophe holds no prediction.
    std::size_t times = 0, timesHeld = 0;   ///< two a point: still and moving light.
};

/// How auto kept a budget in one scene, as measured. Times are added processor time, as auto's own are.
struct AutoOutcome {
    std::string scene, setting;
    LightMotion light = LightMotion::Still;
    double error = 0.0;       ///< px; infinite if the picture is a catastrophe or has no boundary.
    double time = 0.0;        ///< ms.
    bool keepsBudget = false; ///< a time may be exceeded by timeSlack.
    std::string best; ///< the best fixed setting of Gnomon with the same composite; empty: none keeps the budget.
    /// By how much the best is better: in time for a budget of error, in error for a budget of time. 1 or less: auto is as
    /// good. Nothing without a best.
    std::optional<double> ratio;
};

/// Allowed factors of AutoOutcome::time over a budget of time, and of its ratio.
constexpr double timeSlack = 1.25, ratioSlack = 1.25;

/// One half of the scenes.
struct PredictionHalf {
    PredictionShare share;
    std::vector<AutoOutcome> outcomes;
};

struct PredictionSummary {
    PredictionHalf tuned, other; ///< see isTuningScene().
};

/// Of all points that have predictions, and of all of auto that were measured.
PredictionSummary predictionSummary(const ChartResults& results);

/// In a few sentences, plain text; empty if nothing was predicted.
std::vector<std::string> sentencesOf(const PredictionSummary& summary);

/// For results.json.
nlohmann::ordered_json jsonOf(const PredictionSummary& summary);

} // namespace gnomon::examples
