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

} // namespace

template <class Way>
static void fields(Way& way, PartOf<Way, Confusion> c) {
    way.derived("pixels", c.pixels());
    way.field("shadow", c.shadow);
    way.field("lit", c.lit);
    way.field("falseShadow", c.falseShadow);
    way.field("falseLit", c.falseLit);
    way.derived("misclassified", c.misclassified());
    way.derived("falseShadowShare", c.falseShadowShare());
    way.derived("falseLitShare", c.falseLitShare());
    way.derived("balancedError", c.balancedError());
    way.derived("iou", c.intersectionOverUnion());
}

template <class Way>
static void fields(Way& way, PartOf<Way, BoundaryDistance> b) {
    way.field("mean", b.mean);
    way.field("p95", b.p95);
    way.field("max", b.max);
    way.field("signedMean", b.signedMean);
    way.field("drawnLength", b.drawnLength);
    way.field("trueLength", b.trueLength);
}

template <class Way>
static void fields(Way& way, PartOf<Way, CauseSplit> c) {
    way.field("acne", c.acne);
    way.field("halo", c.halo);
    way.field("peterPanning", c.peterPanning);
    way.field("leak", c.leak);
    way.field("erosion", c.erosion);
    way.field("overDark", c.overDark);
    way.field("overBright", c.overBright);
    way.field("acneShare", c.acneShare);
    way.field("peterPanningShare", c.peterPanningShare);
    way.field("gapMetres", c.gap);
}

template <class Way>
static void fields(Way& way, PartOf<Way, IntensityError> e) {
    way.field("all", e.all);
    way.field("penumbra", e.penumbra);
}

template <class Way>
static void fields(Way& way, PartOf<Way, Catastrophes> c) {
    way.field("notFinitePixels", c.notFinite);
    way.field("allShadowed", c.allShadowed);
    way.field("allLit", c.allLit);
    way.field("lostShadow", c.lostShadow);
    way.derived("any", c.any());
}

template <class Way>
static void allFields(Way& way, PartOf<Way, ShadowMetrics> m) {
    way.group("pixels", [&](auto& sets) {
        sets.field("R", m.agreeing);
        sets.field("R+", m.facing);
        sets.field("Rc", m.certain);
        sets.field("unmeasured", m.unmeasured);
        sets.field("droppedShare", m.droppedShare);
        sets.field("sound", m.sound);
    });
    way.object("awayFromEdges", m.headline);
    way.object("raw", m.raw);
    way.object("terminator", m.terminator);
    way.object("selfShadowed", m.selfShadowed);
    way.field("turnedAwayWrong", m.turnedAwayWrong);
    way.object("boundaryPixels", m.boundary);
    way.object("causes", m.causes);
    way.object("rmsePointSun", m.pointSun);
    way.object("rmseDiscSun", m.discSun);
    way.object("rmsePointSunFiltered4x4", m.thin);
    way.object("catastrophes", m.catastrophes);
}

std::string catastropheText(const Catastrophes& catastrophes) {
    std::string text;
    if (catastrophes.notFinite) text += pixels(catastrophes.notFinite) + " are not finite; ";
    if (catastrophes.allShadowed) text += "all is shadowed; ";
    if (catastrophes.allLit) text += "all is lit; ";
    if (catastrophes.lostShadow) text += "intersection over union below 0.2; ";
    return text.empty() ? "none" : text.substr(0, text.size() - 2);
}

std::string reportText(const ShadowMetrics& m) {
    std::ostringstream out;
    for (const auto& [name, text] : lines(m)) out << std::left << std::setw(15) << name << text << "\n";
    return out.str();
}

void fields(FieldWriter& way, const ShadowMetrics& m) { allFields(way, m); }
void fields(FieldReader& way, ShadowMetrics& m) { allFields(way, m); }

nlohmann::ordered_json reportJson(const ShadowMetrics& m) {
    nlohmann::ordered_json report;
    FieldWriter way(report);
    fields(way, m);
    return report;
}

} // namespace gnomon::examples
