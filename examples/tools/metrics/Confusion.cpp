// SPDX-License-Identifier: MIT
#include <metrics/Confusion.h>

namespace gnomon::metrics {
namespace {

std::optional<double> share(std::size_t part, std::size_t whole) {
    if (whole == 0) return std::nullopt;
    return static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

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
