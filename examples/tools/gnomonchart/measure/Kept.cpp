// SPDX-License-Identifier: MIT
#include "Kept.h"
#include "Machine.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

/// Whether it may differ between runs that go on with one another.
bool mayDiffer(const std::string& fact) { return fact == "command" || fact == "date"; }

void requireSame(const Facts& earlier, const Facts& now) {
    for (const auto& fact : now)
        if (!mayDiffer(fact.first) && std::find(earlier.begin(), earlier.end(), fact) == earlier.end())
            throw std::invalid_argument("--resume: the results in the folder were not made with " + fact.first + " " +
                                        fact.second + ". Leave --resume out to measure everything again.");
}

} // namespace

ChartResults keptOf(const ChartResults& earlier, const ChartPlan& plan) {
    requireSame(earlier.made, plan.made);
    requireSame(earlier.made, machineFacts());
    ChartResults kept;
    kept.scenes = earlier.scenes;
    if (!earlier.complete && !kept.scenes.empty()) kept.scenes.pop_back();
    for (const ChartPoint& point : earlier.points)
        if (std::any_of(kept.scenes.begin(), kept.scenes.end(), [&](const auto& s) { return s.name == point.scene; }))
            kept.points.push_back(point);
    return kept;
}

} // namespace gnomon::examples
