// SPDX-License-Identifier: MIT
#include <metrics/PixelSets.h>

#include <cmath>
#include <utility>

namespace gnomon::metrics {
namespace {

constexpr double terminatorCosine = 0.05, samePlaneCosine = 0.005;
constexpr std::array<std::pair<int, int>, 5> plus{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// Whether the pixel and its 4 neighbours, as far as the picture goes, truly are and are drawn as one surface.
bool agrees(const Grid<int>& truth, const Grid<int>& drawn, int x, int y) {
    const int id = truth.at(x, y);
    for (const auto& [dx, dy] : plus)
        if (truth.holds(x + dx, y + dy) && (truth.at(x + dx, y + dy) != id || drawn.at(x + dx, y + dy) != id))
            return false;
    return id != 0;
}

Mask agreeingIds(const Grid<int>& truth, const Grid<int>& drawn) {
    Mask mask(truth.width, truth.height);
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) mask.at(x, y) = agrees(truth, drawn, x, y);
    return mask;
}

double droppedShare(const Mask& agreeing, const Grid<int>& truth, const Grid<int>& drawn) {
    std::size_t surface = 0;
    for (std::size_t i = 0; i < truth.cells.size(); ++i) surface += truth.cells[i] != 0 || drawn.cells[i] != 0;
    return surface ? 1.0 - static_cast<double>(count(agreeing)) / static_cast<double>(surface) : 0.0;
}

bool shadowedByItself(const TruthMaps& truth, std::size_t i) {
    if (truth.blocker.empty() || truth.edgeLength.empty()) return false;
    return truth.blocker.cells[i] == truth.receiver.cells[i] &&
           truth.blockerDistance.cells[i] < 2.0 * truth.edgeLength.cells[i];
}

/// Other than its own surface, which is a single sheet if there is nothing.
bool isBlocked(const TruthMaps& truth, int x, int y) { return truth.blockerDistance.at(x, y) > 0.0; }

/// What bends or ends within 2 px is left out: there the light's terminator or another face is seen. So is what a shadow's edge
/// on a single sheet is as close to.
bool isWithinTurnedAwayPlane(const TruthMaps& truth, int x, int y) {
    constexpr int reach = 2;
    const double cosine = truth.facing.at(x, y);
    if (!(cosine <= 0.0)) return false;
    for (int v = y - reach; v <= y + reach; ++v)
        for (int u = x - reach; u <= x + reach; ++u)
            if (!truth.receiver.holds(u, v) || truth.receiver.at(u, v) != truth.receiver.at(x, y) ||
                !(std::abs(truth.facing.at(u, v) - cosine) < samePlaneCosine) ||
                isBlocked(truth, u, v) != isBlocked(truth, x, y))
                return false;
    return true;
}

void sortPixel(const TruthMaps& truth, std::size_t i, PixelSets& sets) {
    const double cosine = truth.facing.cells[i], lit = truth.lit.cells[i];
    sets.facing.cells[i] = cosine > terminatorCosine;
    sets.certain.cells[i] = cosine > terminatorCosine && !(lit > 0.0 && lit < 1.0);
    sets.terminator.cells[i] = cosine > 0.0 && cosine <= terminatorCosine;
    sets.selfShadowed.cells[i] = cosine > terminatorCosine && shadowedByItself(truth, i);
}

std::optional<double> share(std::size_t part, std::size_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

PixelSets pixelSets(const TruthMaps& truth, const Picture& visibility) {
    const Grid<int>& drawn = truth.drawn.empty() ? truth.receiver : truth.drawn;
    PixelSets sets;
    sets.agreeing = agreeingIds(truth.receiver, drawn);
    sets.droppedShare = droppedShare(sets.agreeing, truth.receiver, drawn);
    const Mask none(truth.receiver.width, truth.receiver.height);
    sets.facing = sets.certain = sets.turnedAway = sets.terminator = sets.selfShadowed = none;
    for (int y = 0; y < visibility.height; ++y)
        for (int x = 0; x < visibility.width; ++x)
            sets.turnedAway.at(x, y) =
                sets.agreeing.at(x, y) && std::isfinite(visibility.at(x, y)) && isWithinTurnedAwayPlane(truth, x, y);
    for (std::size_t i = 0; i < visibility.cells.size(); ++i) {
        if (!std::isfinite(visibility.cells[i])) sets.agreeing.cells[i] = 0;
        if (sets.agreeing.cells[i]) sortPixel(truth, i, sets);
    }
    return sets;
}

std::optional<double> Confusion::misclassified() const { return share(falseShadow + falseLit, pixels()); }
std::optional<double> Confusion::falseShadowShare() const { return share(falseShadow, falseShadow + lit); }
std::optional<double> Confusion::falseLitShare() const { return share(falseLit, falseLit + shadow); }

std::optional<double> Confusion::balancedError() const {
    const std::optional<double> first = falseShadowShare(), second = falseLitShare();
    if (first && second) return (*first + *second) / 2.0;
    return first ? first : second;
}

double Confusion::intersectionOverUnion() const { return share(shadow, shadow + falseShadow + falseLit).value_or(1.0); }

Confusion confusion(const Picture& visibility, const TruthMaps& truth, const Mask& within) {
    Confusion result;
    for (std::size_t i = 0; i < visibility.cells.size(); ++i) {
        if (!within.cells[i]) continue;
        const bool shown = isShadowed(visibility.cells[i]), lit = truth.litCentre.cells[i];
        ++(shown ? lit ? result.falseShadow : result.shadow : lit ? result.lit : result.falseLit);
    }
    return result;
}

} // namespace gnomon::metrics
