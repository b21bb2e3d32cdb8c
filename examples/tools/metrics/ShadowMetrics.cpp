// SPDX-License-Identifier: MIT
#include <metrics/ShadowMetrics.h>

#include <cmath>
#include <stdexcept>

namespace gnomon::metrics {
namespace {

constexpr double lostShadow = 0.2;

template <typename T>
void require(const Picture& visibility, const Grid<T>& grid, bool optional, const char* name) {
    if (visibility.sameSize(grid) || (optional && grid.empty())) return;
    throw std::invalid_argument(std::string("the truth's ") + name +
                                " and the pictures differ in size. Give maps of the pictures' size.");
}

void requireSizes(const Picture& visibility, const TruthMaps& truth) {
    require(visibility, truth.lit, false, "lit");
    require(visibility, truth.litCentre, false, "litCentre");
    require(visibility, truth.blockerDistance, false, "blockerDistance");
    require(visibility, truth.receiver, false, "receiver");
    require(visibility, truth.facing, false, "facing");
    require(visibility, truth.drawn, true, "drawn");
    require(visibility, truth.litByDisc, true, "litByDisc");
    require(visibility, truth.blocker, true, "blocker");
    require(visibility, truth.edgeLength, true, "edgeLength");
    require(visibility, truth.position, true, "position");
    require(visibility, truth.smoothLight, true, "smoothLight");
}

std::size_t unmeasuredPixels(const Picture& visibility, const TruthMaps& truth) {
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < visibility.cells.size(); ++i)
        pixels += truth.receiver.cells[i] != 0 && truth.facing.cells[i] > 0.0 && !std::isfinite(visibility.cells[i]);
    return pixels;
}

Catastrophes catastrophes(const Visibility& visibility, const ShadowMetrics& metrics) {
    const Confusion& raw = metrics.raw;
    Catastrophes result;
    result.notFinite = visibility.notFinite;
    result.allShadowed = raw.lit + raw.falseLit == 0 && raw.falseShadow > 0;
    result.allLit = raw.shadow + raw.falseShadow == 0 && raw.falseLit > 0;
    result.lostShadow = metrics.headline.intersectionOverUnion() < lostShadow;
    return result;
}

void countSets(const PixelSets& sets, ShadowMetrics& metrics) {
    metrics.agreeing = count(sets.agreeing);
    metrics.facing = count(sets.facing);
    metrics.certain = count(sets.certain);
    metrics.droppedShare = sets.droppedShare;
    metrics.sound = sets.sound();
}

} // namespace

std::size_t turnedAwayWrong(const Picture& visibility, const TruthMaps& truth, const Mask& turnedAway) {
    constexpr double doubt = 0.01;
    const auto isDark = [&](int x, int y) { return isShadowed(visibility.at(x, y)); };
    const auto differs = [&](int x, int y, int u, int v) {
        return turnedAway.holds(u, v) && turnedAway.at(u, v) && isDark(u, v) != isDark(x, y);
    };
    const auto isSmooth = [&](int x, int y) { return !truth.smoothLight.empty() && truth.smoothLight.at(x, y) > 0.0; };
    std::size_t wrong = 0;
    for (int y = 0; y < turnedAway.height; ++y)
        for (int x = 0; x < turnedAway.width; ++x) {
            if (!turnedAway.at(x, y) || isSmooth(x, y)) continue;
            if (truth.facing.at(x, y) < -doubt)
                wrong += isDark(x, y) != (truth.blockerDistance.at(x, y) > 0.0);
            else
                wrong += differs(x, y, x - 1, y) || differs(x, y, x + 1, y) || differs(x, y, x, y - 1) ||
                         differs(x, y, x, y + 1);
        }
    return wrong;
}

bool isTooth(const Picture& visibility, const TruthMaps& truth, std::size_t pixel) {
    return !truth.smoothLight.empty() &&
           (1.0 - visibility.cells[pixel]) * truth.smoothLight.cells[pixel] > leastContrast;
}

std::optional<std::size_t> teeth(const Picture& visibility, const TruthMaps& truth, const Mask& within) {
    if (truth.smoothLight.empty()) return std::nullopt;
    std::size_t found = 0;
    for (std::size_t i = 0; i < within.cells.size(); ++i) found += within.cells[i] && isTooth(visibility, truth, i);
    return found;
}

ShadowMetrics shadowMetrics(const Visibility& visibility, const TruthMaps& truth, const CauseLimits& limits) {
    const Picture& v = visibility.value;
    requireSizes(v, truth);
    const PixelSets sets = pixelSets(truth, v);
    ShadowMetrics metrics;
    countSets(sets, metrics);
    metrics.unmeasured = unmeasuredPixels(v, truth);
    metrics.headline = confusion(v, truth, sets.certain);
    metrics.raw = confusion(v, truth, sets.facing);
    metrics.terminator = confusion(v, truth, sets.terminator);
    metrics.selfShadowed = confusion(v, truth, sets.selfShadowed);
    metrics.turnedAwayWrong = turnedAwayWrong(v, truth, sets.turnedAway);
    metrics.teeth = teeth(v, truth, sets.agreeing);
    metrics.boundary = boundaryDistance(v, truth.lit, sets.facing);
    metrics.causes = causeSplit(v, truth, sets, limits);
    metrics.pointSun = intensityError(v, truth.lit, sets.facing);
    if (!truth.litByDisc.empty()) metrics.discSun = intensityError(v, truth.litByDisc, sets.facing);
    metrics.thin = thinIntensityError(v, truth.lit, sets.facing);
    metrics.catastrophes = catastrophes(visibility, metrics);
    return metrics;
}

} // namespace gnomon::metrics
