// SPDX-License-Identifier: MIT
#include "StabilityResults.h"

#include <algorithm>
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

} // namespace gnomon::examples
