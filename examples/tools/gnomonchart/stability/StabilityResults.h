// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/PixelSets.h>
#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::examples {

/// How right a picture's shadow is, over some of its pixels.
struct StabilityJudgement {
    std::optional<double> p95; ///< 95th percentile of the boundary distance, px; none without both boundaries.
    double floor = 0.0;    ///< the same of pictures that ask one ray a pixel, at its centre or 1/16 px beside it: the
                           ///< largest. Nothing hard-edged knows its places better.
    std::size_t wrong = 0; ///< certain pixels that are wrong, away from edges.
    std::size_t turnedAwayWrong = 0;  ///< see metrics::turnedAwayWrong(); a figure apart, of no weight in the budget.
    std::size_t shadow = 0;           ///< certain pixels that are truly shadowed.
    double iou = 1.0;                 ///< intersection over union of the shadow's certain pixels.
    std::optional<std::size_t> teeth; ///< see metrics::teeth(); none: the scene has no such body.
    bool lost = false; ///< a catastrophe: IoU below 0.2 where shadow or false shadow is of 50 pixels or more.

    /// At most 1 px at the 95th percentile, or as much as the floor, no wrong pixels away from edges, and no teeth: a tooth
    /// is not at an edge of a shadow that could be a pixel off, for there is none.
    bool inBudget() const {
        return !lost && wrong == 0 && teeth.value_or(0) == 0 && p95.value_or(0.0) <= std::max(1.0, floor + 1e-9);
    }
};

/// One technique in one scene at one value.
struct StabilityCell {
    std::string failure; ///< "refused", "failed", "crashed", "hung"; empty: there is a picture.
    std::string message; ///< then why.
    bool measured = false;
    StabilityJudgement everywhere;
    std::optional<StabilityJudgement> onReceiver; ///< of techniques that shadow one named receiver alone.
    std::size_t notFinite = 0;                    ///< pixels with NaN or infinity.
    std::vector<std::string> diagnosis;           ///< what the technique says is missing.
    std::vector<std::string> notes;               ///< what OpenSceneGraph says.
    std::string picture;                          ///< file of the errors' overlay; empty: none.

    bool inBudget() const { return failure.empty() && notFinite == 0 && everywhere.inBudget(); }
    /// Whether the technique says that its shadow is missing or wrong.
    bool stated() const;
    /// Whether it is right where it shadows at all.
    bool rightOnReceiver() const { return failure.empty() && notFinite == 0 && onReceiver && onReceiver->inBudget(); }
    /// A crash, a hang, NaN in the picture, or a lost shadow that nothing is said of.
    bool catastrophe() const;
};

/// Where a technique's flicker is measured: at the last value at which it is right, states no limit and has a shadow of
/// 50 pixels. If it shadows one receiver alone, it need only be right there. nullopt if there is no such value.
std::optional<std::size_t> filmedAt(const std::vector<StabilityCell>& cells);

/// What a sweep comes to.
enum class StabilityOutcome {
    HELD,      ///< within the budget at every value.
    STATED,    ///< where it is not, diagnose() says so, or the technique refuses.
    ELSEWHERE, ///< where it is not, and says nothing, it is right on its receiver: other surfaces get no shadow by design.
    LEFT,      ///< out of its budget, and says nothing.
    CATASTROPHE ///< see StabilityCell::catastrophe().
};

/// How the shadow flickers while the camera goes on and turns, see metrics::FlickerMeter.
struct StabilityFlicker {
    std::optional<double> value;     ///< of the parameter, in the film; none: no value is right and has a shadow.
    std::optional<double> energy;    ///< mean change beyond the truth's, in visibility.
    std::optional<double> share;     ///< of pixels that change by more than a quarter.
    std::optional<double> crawl;     ///< of the edges, beyond that of a picture of rays, px.
    std::optional<double> rayCrawl;  ///< of a picture of one ray a pixel, px.
    std::size_t turnedAwayWrong = 0; ///< the most of any frame, see StabilityJudgement.
    std::string picture;             ///< file of the worst two frames in turn and their change; empty: none.
};

/// One technique in one scene.
struct StabilityRow {
    std::string scene, kit, technique, setting;
    std::vector<std::pair<std::string, std::string>> settings; ///< that differ from the technique's defaults.
    std::vector<StabilityCell> cells;                          ///< a value each.
    StabilityFlicker flicker;                                  ///< at the value of filmedAt().

    StabilityOutcome outcome() const;
    /// The first value's place at which the budget is left; nullopt if it holds.
    std::optional<std::size_t> leftAt() const;
    /// Share of the values before that, 0 … 1.
    double reach() const;
};

/// What a scene is about.
struct StabilitySceneText {
    std::string id;             ///< "L7"
    std::string section;        ///< "light"
    std::string title;          ///< a few words.
    std::string about;          ///< one sentence: what is hard, and what is right.
    std::string parameter;      ///< what the values are.
    std::string unit;           ///< of the values; empty: none.
    std::vector<double> values; ///< from harmless to hostile.
};

struct StabilityResults {
    std::vector<std::pair<std::string, std::string>> made; ///< how, where and when.
    std::vector<StabilitySceneText> scenes;
    std::vector<StabilityRow> rows; ///< by scene, then technique.
    bool complete = true;
};

/// "held", "stated limit", "elsewhere", "left", "catastrophe".
const char* nameOf(StabilityOutcome outcome);

/// Six digits.
std::string valueText(double value);

/// Writes stability.json into an existing folder, whole or not at all.
/// @throws std::runtime_error, one sentence, if the file cannot be written.
void saveStability(const StabilityResults& results, const std::string& folder);

/// What a child process hands over.
nlohmann::ordered_json jsonOf(const StabilityCell& cell);
nlohmann::ordered_json jsonOf(const StabilityFlicker& flicker);
StabilityCell cellOf(const nlohmann::ordered_json& json);
StabilityFlicker flickerOf(const nlohmann::ordered_json& json);

/// Judges one picture over the pixels of `within`. A wrong pixel is away from edges if none of the 24 pixels about it is on
/// an edge or truly otherwise: nearer ones are what the boundary's distance measures. Pixels that the truth leaves undecided
/// are not wrong.
StabilityJudgement judge(const metrics::Picture& visibility, const metrics::TruthMaps& truth,
                         const metrics::PixelSets& sets, const metrics::Mask& within);

} // namespace gnomon::examples
