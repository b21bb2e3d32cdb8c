// SPDX-License-Identifier: MIT
#include "Report.h"

#include <iomanip>
#include <sstream>
#include <utility>
#include <vector>

namespace gnomon::examples {
namespace {

using namespace metrics;

std::string number(double value) {
    std::ostringstream out;
    out << std::setprecision(4) << value;
    return out.str();
}

std::string number(const std::optional<double>& value) { return value ? number(*value) : "none"; }
std::string percent(const std::optional<double>& share) { return share ? number(100.0 * *share) + " %" : "none"; }
std::string pixels(std::size_t count) { return std::to_string(count) + " px"; }

std::string boundaryText(const std::optional<BoundaryDistance>& boundary) {
    if (!boundary) return "none, because one or both pictures have no boundary";
    return "mean " + number(boundary->mean) + " px, 95 % below " + number(boundary->p95) + " px, greatest " +
           number(boundary->max) + " px, outwards " + number(boundary->signedMean) + " px";
}

std::string intensityText(const IntensityError& error) {
    if (!error.all) return "none";
    return number(error.all) + " (in penumbrae " + number(error.penumbra) + ")";
}

std::string wrongText(const Confusion& confusion) {
    return std::to_string(confusion.falseShadow + confusion.falseLit) + " of " + pixels(confusion.pixels()) + " wrong";
}

std::string awayAndRaw(const std::string& away, const std::string& raw) {
    return away + " away from edges, " + raw + " raw";
}

std::string halvesText(const Confusion& away) {
    return "; away from edges false shadow " + percent(away.falseShadowShare()) + ", missed shadow " +
           percent(away.falseLitShare());
}

std::string falseShadowText(const CauseSplit& c) {
    return "acne " + pixels(c.acne) + " (" + percent(c.acneShare) + " of what is lit), halo " + pixels(c.halo);
}

std::string missedShadowText(const CauseSplit& c) {
    return "peter-panning " + pixels(c.peterPanning) + " (" + percent(c.peterPanningShare) + " of contact, gap " +
           (c.gap ? number(*c.gap) + " m" : "none") + "), leak " + pixels(c.leak) + ", erosion " + pixels(c.erosion);
}

std::string judgedText(const ShadowMetrics& m) {
    return awayAndRaw(std::to_string(m.certain), std::to_string(m.facing)) + "; " + percent(m.droppedShare) +
           " of the surface dropped, " + pixels(m.unmeasured) + " not measured";
}

/// Which there are, in words; "none".
std::string catastropheText(const Catastrophes& catastrophes) {
    std::string text;
    if (catastrophes.notFinite) text += pixels(catastrophes.notFinite) + " are not finite; ";
    if (catastrophes.allShadowed) text += "all is shadowed; ";
    if (catastrophes.allLit) text += "all is lit; ";
    if (catastrophes.lostShadow) text += "intersection over union below 0.2; ";
    return text.empty() ? "none" : text.substr(0, text.size() - 2);
}

std::vector<std::pair<std::string, std::string>> lines(const ShadowMetrics& m) {
    const Confusion &away = m.headline, &raw = m.raw;
    return {
        {"boundary", boundaryText(m.boundary)},
        {"misclassified", awayAndRaw(percent(away.misclassified()), percent(raw.misclassified()))},
        {"balanced error", awayAndRaw(percent(away.balancedError()), percent(raw.balancedError())) + halvesText(away)},
        {"IoU", awayAndRaw(number(away.intersectionOverUnion()), number(raw.intersectionOverUnion()))},
        {"false shadow", falseShadowText(m.causes)},
        {"missed shadow", missedShadowText(m.causes)},
        {"over-dark", pixels(m.causes.overDark) + ", over-bright " + pixels(m.causes.overBright)},
        {"RMSE", intensityText(m.pointSun) + " of a point sun, " + intensityText(m.discSun) + " of the sun's disc"},
        {"thin", "RMSE " + intensityText(m.thin) + " of a point sun, both filtered by 4 x 4 px"},
        {"apart", "terminator " + wrongText(m.terminator) + ", smooth self-shadow " + wrongText(m.selfShadowed)},
        {"turned away", pixels(m.turnedAwayWrong) + " wrong"},
        {"pixels judged", judgedText(m)},
        {"catastrophes", catastropheText(m.catastrophes)}};
}

using nlohmann::ordered_json;

ordered_json countsJson(const Confusion& c) {
    return {{"pixels", c.pixels()},
            {"shadow", c.shadow},
            {"lit", c.lit},
            {"falseShadow", c.falseShadow},
            {"falseLit", c.falseLit},
            {"misclassified", jsonOf(c.misclassified())},
            {"falseShadowShare", jsonOf(c.falseShadowShare())},
            {"falseLitShare", jsonOf(c.falseLitShare())},
            {"balancedError", jsonOf(c.balancedError())},
            {"iou", jsonOf(c.intersectionOverUnion())}};
}

ordered_json boundaryJson(const BoundaryDistance& b) {
    return {{"mean", jsonOf(b.mean)},
            {"p95", jsonOf(b.p95)},
            {"max", jsonOf(b.max)},
            {"signedMean", jsonOf(b.signedMean)},
            {"drawnLength", jsonOf(b.drawnLength)},
            {"trueLength", jsonOf(b.trueLength)}};
}

ordered_json causesJson(const CauseSplit& c) {
    return {{"acne", c.acne},
            {"halo", c.halo},
            {"peterPanning", c.peterPanning},
            {"leak", c.leak},
            {"erosion", c.erosion},
            {"overDark", c.overDark},
            {"overBright", c.overBright},
            {"acneShare", jsonOf(c.acneShare)},
            {"peterPanningShare", jsonOf(c.peterPanningShare)},
            {"gapMetres", jsonOf(c.gap)}};
}

ordered_json intensityJson(const IntensityError& e) {
    return {{"all", jsonOf(e.all)}, {"penumbra", jsonOf(e.penumbra)}};
}

} // namespace

std::string reportText(const ShadowMetrics& m) {
    std::ostringstream out;
    for (const auto& [name, text] : lines(m)) out << std::left << std::setw(15) << name << text << "\n";
    return out.str();
}

nlohmann::ordered_json jsonOf(const ShadowMetrics& m) {
    return {{"pixels",
             {{"R", m.agreeing},
              {"R+", m.facing},
              {"Rc", m.certain},
              {"unmeasured", m.unmeasured},
              {"droppedShare", jsonOf(m.droppedShare)},
              {"sound", m.sound}}},
            {"awayFromEdges", countsJson(m.headline)},
            {"raw", countsJson(m.raw)},
            {"terminator", countsJson(m.terminator)},
            {"selfShadowed", countsJson(m.selfShadowed)},
            {"turnedAwayWrong", m.turnedAwayWrong},
            {"teeth", m.teeth ? ordered_json(*m.teeth) : ordered_json()},
            {"boundaryPixels", m.boundary ? boundaryJson(*m.boundary) : ordered_json()},
            {"causes", causesJson(m.causes)},
            {"rmsePointSun", intensityJson(m.pointSun)},
            {"rmseDiscSun", intensityJson(m.discSun)},
            {"rmsePointSunFiltered4x4", intensityJson(m.thin)},
            {"catastrophes",
             {{"notFinitePixels", m.catastrophes.notFinite},
              {"allShadowed", m.catastrophes.allShadowed},
              {"allLit", m.catastrophes.allLit},
              {"lostShadow", m.catastrophes.lostShadow},
              {"any", m.catastrophes.any()}}}};
}

} // namespace gnomon::examples
