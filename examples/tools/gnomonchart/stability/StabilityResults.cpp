// SPDX-License-Identifier: MIT
#include "StabilityResults.h"
#include "../measure/Yardstick.h"
#include "JsonFields.h"
#include "OutputFile.h"

#include <metrics/BoundaryDistance.h>
#include <metrics/Confusion.h>
#include <metrics/ShadowMetrics.h>

#include <filesystem>
#include <iterator>
#include <sstream>

namespace gnomon::examples {
namespace {

/// What diagnose() says besides limits: nothing of the shadow is missing then.
constexpr const char* remarks[] = {"invalid triangles are left out"};

constexpr std::size_t leastShadow = 50; ///< pixels, of a shadow that is worth a film.

bool isLimit(const std::string& cause) {
    return std::none_of(std::begin(remarks), std::end(remarks),
                        [&](const char* remark) { return cause.find(remark) != std::string::npos; });
}

constexpr int reach = 2;                // px: rows and columns on each side that a boundary 1 px off may blur
constexpr std::size_t leastPixels = 50; // that a shadow has, or a false one, to be lost
constexpr double lostBelow = 0.2;       // IoU, as metrics::Catastrophes has it

bool isEdge(double lit) { return lit > 0.0 && lit < 1.0; }

bool isNearEdge(const metrics::TruthMaps& truth, int x, int y) {
    const bool lit = truth.litCentre.at(x, y) != 0;
    for (int j = y - reach; j <= y + reach; ++j)
        for (int i = x - reach; i <= x + reach; ++i) {
            if (!truth.lit.holds(i, j) || truth.receiver.at(i, j) == 0) continue;
            if (isEdge(truth.lit.at(i, j)) || (truth.litCentre.at(i, j) != 0) != lit) return true;
        }
    return false;
}

metrics::Mask both(const metrics::Mask& a, const metrics::Mask& b) {
    metrics::Mask result = a;
    for (std::size_t i = 0; i < result.cells.size(); ++i) result.cells[i] = a.cells[i] && b.cells[i];
    return result;
}

std::size_t wrongAwayFromEdges(const metrics::Picture& visibility, const metrics::TruthMaps& truth,
                               const metrics::Mask& certain) {
    const auto isDecided = [&](int x, int y) { return truth.undecided.empty() || !truth.undecided.at(x, y); };
    std::size_t wrong = 0;
    for (int y = 0; y < certain.height; ++y)
        for (int x = 0; x < certain.width; ++x)
            wrong += certain.at(x, y) && isDecided(x, y) &&
                     metrics::isShadowed(visibility.at(x, y)) == (truth.litCentre.at(x, y) != 0) &&
                     !isNearEdge(truth, x, y);
    return wrong;
}

double floorOf(const metrics::TruthMaps& truth, const metrics::Mask& facing) {
    double floor = 0.0;
    const auto take = [&](const metrics::Mask& lit) {
        if (lit.empty()) return;
        if (const auto boundary = metrics::boundaryDistance(raysOf(lit).value, truth.lit, facing))
            floor = std::max(floor, boundary->p95);
    };
    take(truth.litCentre);
    for (const metrics::Mask& lit : truth.litBeside) take(lit);
    return floor;
}

} // namespace

bool StabilityCell::stated() const {
    if (!failure.empty()) return failure == "refused";
    return std::any_of(diagnosis.begin(), diagnosis.end(), isLimit);
}

bool StabilityCell::catastrophe() const {
    if (failure == "crashed" || failure == "hung" || notFinite > 0) return true;
    return failure.empty() && everywhere.lost && !stated() && !rightOnReceiver();
}

std::optional<std::size_t> filmedAt(const std::vector<StabilityCell>& cells) {
    for (std::size_t place = cells.size(); place-- > 0;) {
        const StabilityCell& cell = cells[place];
        const StabilityJudgement& judged = cell.onReceiver.value_or(cell.everywhere);
        if (cell.stated() && !cell.onReceiver) continue;
        if (cell.measured && cell.notFinite == 0 && judged.inBudget() && judged.shadow >= leastShadow) return place;
    }
    return std::nullopt;
}

StabilityOutcome StabilityRow::outcome() const {
    StabilityOutcome worst = StabilityOutcome::HELD;
    for (const StabilityCell& cell : cells) {
        StabilityOutcome here = StabilityOutcome::LEFT;
        if (cell.inBudget())
            here = StabilityOutcome::HELD;
        else if (cell.catastrophe())
            here = StabilityOutcome::CATASTROPHE;
        else if (cell.stated())
            here = StabilityOutcome::STATED;
        else if (cell.rightOnReceiver())
            here = StabilityOutcome::ELSEWHERE;
        worst = std::max(worst, here);
    }
    return worst;
}

std::optional<std::size_t> StabilityRow::leftAt() const {
    const auto left = std::find_if(cells.begin(), cells.end(), [](const auto& cell) { return !cell.inBudget(); });
    if (left == cells.end()) return std::nullopt;
    return static_cast<std::size_t>(left - cells.begin());
}

double StabilityRow::reach() const {
    const std::optional<std::size_t> left = leftAt();
    return left && !cells.empty() ? double(*left) / double(cells.size()) : 1.0;
}

const char* nameOf(StabilityOutcome outcome) {
    switch (outcome) {
    case StabilityOutcome::HELD:
        return "held";
    case StabilityOutcome::STATED:
        return "stated limit";
    case StabilityOutcome::ELSEWHERE:
        return "elsewhere";
    case StabilityOutcome::LEFT:
        return "left";
    case StabilityOutcome::CATASTROPHE:
        break;
    }
    return "catastrophe";
}

std::string valueText(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

using nlohmann::json;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityJudgement> judgement) {
    way.field("p95Pixels", judgement.p95);
    way.field("floorPixels", judgement.floor);
    way.field("wrong", judgement.wrong);
    way.field("turnedAwayWrong", judgement.turnedAwayWrong);
    way.field("shadow", judgement.shadow);
    way.field("iou", judgement.iou);
    way.field("lost", judgement.lost);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityCell> cell) {
    way.field("failure", cell.failure);
    way.field("message", cell.message);
    way.field("measured", cell.measured);
    way.object("everywhere", cell.everywhere);
    way.object("onReceiver", cell.onReceiver);
    way.field("notFinite", cell.notFinite);
    way.field("diagnosis", cell.diagnosis);
    way.field("notes", cell.notes);
    way.field("picture", cell.picture);
    way.derived("inBudget", cell.inBudget());
    way.derived("catastrophe", cell.catastrophe());
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityFlicker> flicker) {
    way.field("flickerValue", flicker.value);
    way.field("flickerEnergy", flicker.energy);
    way.field("flickerShare", flicker.share);
    way.field("crawlPixels", flicker.crawl);
    way.field("rayCrawlPixels", flicker.rayCrawl);
    way.field("flickerTurnedAwayWrong", flicker.turnedAwayWrong);
    way.field("flickerPicture", flicker.picture);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityRow> row) {
    way.field("scene", row.scene);
    way.field("kit", row.kit);
    way.field("technique", row.technique);
    way.field("setting", row.setting);
    way.field("settings", row.settings);
    way.derived("outcome", std::string(nameOf(row.outcome())));
    way.derived("reach", row.reach());
    fields(way, row.flicker);
    way.list("cells", row.cells);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilitySceneText> scene) {
    way.field("id", scene.id);
    way.field("section", scene.section);
    way.field("title", scene.title);
    way.field("about", scene.about);
    way.field("parameter", scene.parameter);
    way.field("unit", scene.unit);
    way.field("values", scene.values);
}

template <class Way>
static void fields(Way& way, PartOf<Way, StabilityResults> results) {
    way.field("complete", results.complete);
    way.field("made", results.made);
    way.list("scenes", results.scenes);
    way.list("rows", results.rows);
}

namespace {

template <class Part>
ordered_json written(const Part& part) {
    ordered_json object;
    FieldWriter way(object);
    fields(way, part);
    return object;
}

template <class Part>
Part partOf(const json& object) {
    Part part;
    FieldReader way(object);
    fields(way, part);
    return part;
}

} // namespace

json jsonOf(const StabilityCell& cell) { return written(cell); }
json jsonOf(const StabilityFlicker& flicker) { return written(flicker); }

StabilityCell cellOf(const json& object) { return partOf<StabilityCell>(object); }
StabilityFlicker flickerOf(const json& object) { return partOf<StabilityFlicker>(object); }

void saveStability(const StabilityResults& results, const std::string& folder) {
    ordered_json object;
    FieldWriter way(object);
    fields(way, results);
    OutputFile((fs::path(folder) / "stability.json").string()).write(resultsText(object));
}

StabilityJudgement judge(const metrics::Picture& visibility, const metrics::TruthMaps& truth,
                         const metrics::PixelSets& sets, const metrics::Mask& within) {
    const metrics::Mask certain = both(sets.certain, within);
    const metrics::Confusion counts = metrics::confusion(visibility, truth, certain);
    StabilityJudgement judged;
    const metrics::Mask facing = both(sets.facing, within);
    if (const auto boundary = metrics::boundaryDistance(visibility, truth.lit, facing)) judged.p95 = boundary->p95;
    judged.floor = floorOf(truth, facing);
    judged.wrong = wrongAwayFromEdges(visibility, truth, certain);
    judged.turnedAwayWrong = metrics::turnedAwayWrong(visibility, truth, both(sets.turnedAway, within));
    judged.shadow = counts.shadow + counts.falseLit;
    judged.iou = counts.intersectionOverUnion();
    judged.lost = judged.iou < lostBelow && judged.shadow + counts.falseShadow >= leastPixels;
    return judged;
}

} // namespace gnomon::examples
