// SPDX-License-Identifier: MIT
#include "StabilityJudge.h"

#include "../measure/Yardstick.h"

#include <metrics/BoundaryDistance.h>
#include <metrics/Confusion.h>
#include <metrics/ShadowMetrics.h>

#include <algorithm>

namespace gnomon::examples {
namespace {

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
