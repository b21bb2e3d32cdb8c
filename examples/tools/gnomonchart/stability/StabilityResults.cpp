// SPDX-License-Identifier: MIT
#include "StabilityResults.h"
#include "../measure/Yardstick.h"
#include "OutputFile.h"
#include "Report.h"

#include <metrics/BoundaryDistance.h>
#include <metrics/ShadowMetrics.h>

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
    constexpr const char* names[] = {"held", "stated limit", "elsewhere", "left", "catastrophe"};
    return names[static_cast<std::size_t>(outcome)];
}

std::string valueText(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

using nlohmann::ordered_json;

static ordered_json jsonOf(const StabilityJudgement& judgement) {
    return {{"p95Pixels", jsonOf(judgement.p95)},
            {"floorPixels", jsonOf(judgement.floor)},
            {"wrong", judgement.wrong},
            {"turnedAwayWrong", judgement.turnedAwayWrong},
            {"shadow", judgement.shadow},
            {"iou", jsonOf(judgement.iou)},
            {"teeth", judgement.teeth ? ordered_json(*judgement.teeth) : ordered_json()},
            {"lost", judgement.lost}};
}

ordered_json jsonOf(const StabilityCell& cell) {
    return {{"failure", cell.failure},
            {"message", cell.message},
            {"measured", cell.measured},
            {"everywhere", jsonOf(cell.everywhere)},
            {"onReceiver", jsonOf(cell.onReceiver)},
            {"notFinite", cell.notFinite},
            {"diagnosis", cell.diagnosis},
            {"notes", cell.notes},
            {"picture", cell.picture},
            {"inBudget", cell.inBudget()},
            {"catastrophe", cell.catastrophe()}};
}

ordered_json jsonOf(const StabilityFlicker& flicker) {
    return {{"flickerValue", jsonOf(flicker.value)},      {"flickerEnergy", jsonOf(flicker.energy)},
            {"flickerShare", jsonOf(flicker.share)},      {"crawlPixels", jsonOf(flicker.crawl)},
            {"rayCrawlPixels", jsonOf(flicker.rayCrawl)}, {"flickerTurnedAwayWrong", flicker.turnedAwayWrong},
            {"flickerPicture", flicker.picture}};
}

static ordered_json jsonOf(const StabilityRow& row) {
    ordered_json object = {{"scene", row.scene},     {"kit", row.kit},           {"technique", row.technique},
                           {"setting", row.setting}, {"settings", row.settings}, {"outcome", nameOf(row.outcome())},
                           {"reach", row.reach()}};
    object.update(jsonOf(row.flicker));
    object["cells"] = jsonOf(row.cells);
    return object;
}

static ordered_json jsonOf(const StabilitySceneText& scene) {
    return {{"id", scene.id},        {"section", scene.section},     {"title", scene.title},
            {"about", scene.about},  {"parameter", scene.parameter}, {"unit", scene.unit},
            {"values", scene.values}};
}

void saveStability(const StabilityResults& results, const std::string& folder) {
    OutputFile(folder + "/stability.json")
        .write(resultsText({{"complete", results.complete},
                            {"made", results.made},
                            {"scenes", jsonOf(results.scenes)},
                            {"rows", jsonOf(results.rows)}}));
}

namespace {

/// What jsonOf() wrote, NaN and infinity as text.
double numberOf(const ordered_json& from) {
    return from.is_string() ? std::stod(from.get<std::string>()) : from.get<double>();
}

template <class Value, class Of>
std::optional<Value> ifAny(const ordered_json& from, const Of& of) {
    return from.is_null() ? std::nullopt : std::optional<Value>(of(from));
}

StabilityJudgement judgementOf(const ordered_json& from) {
    return {ifAny<double>(from.at("p95Pixels"), numberOf),
            numberOf(from.at("floorPixels")),
            from.at("wrong"),
            from.at("turnedAwayWrong"),
            from.at("shadow"),
            numberOf(from.at("iou")),
            ifAny<std::size_t>(from.at("teeth"), [](const ordered_json& pixels) { return pixels.get<std::size_t>(); }),
            from.at("lost")};
}

} // namespace

StabilityCell cellOf(const ordered_json& from) {
    return {from.at("failure"),
            from.at("message"),
            from.at("measured"),
            judgementOf(from.at("everywhere")),
            ifAny<StabilityJudgement>(from.at("onReceiver"), judgementOf),
            from.at("notFinite"),
            from.at("diagnosis"),
            from.at("notes"),
            from.at("picture")};
}

StabilityFlicker flickerOf(const ordered_json& from) {
    const auto number = [&](const char* name) { return ifAny<double>(from.at(name), numberOf); };
    return {number("flickerValue"),   number("flickerEnergy"),  number("flickerShare"),
            number("crawlPixels"),    number("rayCrawlPixels"), from.at("flickerTurnedAwayWrong"),
            from.at("flickerPicture")};
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
    judged.teeth = metrics::teeth(visibility, truth, both(sets.agreeing, within));
    judged.lost = judged.iou < lostBelow && judged.shadow + counts.falseShadow >= leastPixels;
    return judged;
}

} // namespace gnomon::examples
