// SPDX-License-Identifier: MIT
#include "Report.h"

#include "JsonFields.h"

#include <iomanip>
#include <sstream>
#include <utility>
#include <vector>

namespace gnomon::examples {
namespace {

using namespace metrics;
using nlohmann::json;

std::string number(double value) {
    std::ostringstream out;
    out << std::setprecision(4) << value;
    return out.str();
}

std::string number(const std::optional<double>& value) { return value ? number(*value) : "none"; }
std::string percent(const std::optional<double>& share) { return share ? number(100.0 * *share) + " %" : "none"; }
std::string pixels(std::size_t count) { return std::to_string(count) + " px"; }

std::string boundaryText(const std::optional<BoundaryDistance>& boundary) {
    if (!boundary) return "none: one picture, or both, has no boundary";
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
        {"pixels judged", judgedText(m)},
        {"catastrophes", catastropheText(m.catastrophes)}};
}

json partJson(const Confusion& c) {
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

json partJson(const std::optional<BoundaryDistance>& b) {
    if (!b) return nullptr;
    return {{"mean", jsonOf(b->mean)},
            {"p95", jsonOf(b->p95)},
            {"max", jsonOf(b->max)},
            {"signedMean", jsonOf(b->signedMean)},
            {"drawnLength", jsonOf(b->drawnLength)},
            {"trueLength", jsonOf(b->trueLength)}};
}

json partJson(const CauseSplit& c) {
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

json partJson(const IntensityError& e) { return {{"all", jsonOf(e.all)}, {"penumbra", jsonOf(e.penumbra)}}; }

json partJson(const Catastrophes& c) {
    return {{"notFinitePixels", c.notFinite},
            {"allShadowed", c.allShadowed},
            {"allLit", c.allLit},
            {"lostShadow", c.lostShadow},
            {"any", c.any()}};
}

json setsOf(const ShadowMetrics& m) {
    return {{"R", m.agreeing},
            {"R+", m.facing},
            {"Rc", m.certain},
            {"unmeasured", m.unmeasured},
            {"droppedShare", jsonOf(m.droppedShare)},
            {"sound", m.sound}};
}

void read(const json& from, Confusion& to) {
    readField(from, "shadow", to.shadow);
    readField(from, "falseShadow", to.falseShadow);
    readField(from, "falseLit", to.falseLit);
    readField(from, "lit", to.lit);
}

void read(const json& from, BoundaryDistance& to) {
    readField(from, "mean", to.mean);
    readField(from, "p95", to.p95);
    readField(from, "max", to.max);
    readField(from, "signedMean", to.signedMean);
    readField(from, "drawnLength", to.drawnLength);
    readField(from, "trueLength", to.trueLength);
}

void read(const json& from, CauseSplit& to) {
    readField(from, "acne", to.acne);
    readField(from, "halo", to.halo);
    readField(from, "peterPanning", to.peterPanning);
    readField(from, "leak", to.leak);
    readField(from, "erosion", to.erosion);
    readField(from, "overDark", to.overDark);
    readField(from, "overBright", to.overBright);
    readField(from, "acneShare", to.acneShare);
    readField(from, "peterPanningShare", to.peterPanningShare);
    readField(from, "gapMetres", to.gap);
}

void read(const json& from, IntensityError& to) {
    readField(from, "all", to.all);
    readField(from, "penumbra", to.penumbra);
}

void read(const json& from, Catastrophes& to) {
    readField(from, "notFinitePixels", to.notFinite);
    readField(from, "allShadowed", to.allShadowed);
    readField(from, "allLit", to.allLit);
    readField(from, "lostShadow", to.lostShadow);
}

template <typename Part>
void readPart(const json& report, const char* name, Part& part) {
    const json& from = objectField(report, name);
    readInside(name, [&] { read(from, part); });
}

void readSets(const json& from, ShadowMetrics& to) {
    readField(from, "R", to.agreeing);
    readField(from, "R+", to.facing);
    readField(from, "Rc", to.certain);
    readField(from, "unmeasured", to.unmeasured);
    readField(from, "droppedShare", to.droppedShare);
    readField(from, "sound", to.sound);
}

} // namespace

std::string catastropheText(const Catastrophes& catastrophes) {
    std::string text;
    if (catastrophes.notFinite) text += pixels(catastrophes.notFinite) + " are no numbers; ";
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

json reportJson(const ShadowMetrics& m) {
    return {{"pixels", setsOf(m)},
            {"awayFromEdges", partJson(m.headline)},
            {"raw", partJson(m.raw)},
            {"terminator", partJson(m.terminator)},
            {"selfShadowed", partJson(m.selfShadowed)},
            {"boundaryPixels", partJson(m.boundary)},
            {"causes", partJson(m.causes)},
            {"rmsePointSun", partJson(m.pointSun)},
            {"rmseDiscSun", partJson(m.discSun)},
            {"rmsePointSunFiltered4x4", partJson(m.thin)},
            {"catastrophes", partJson(m.catastrophes)}};
}

ShadowMetrics reportOf(const json& report) {
    ShadowMetrics m;
    const json& sets = objectField(report, "pixels");
    readInside("pixels", [&] { readSets(sets, m); });
    readPart(report, "awayFromEdges", m.headline);
    readPart(report, "raw", m.raw);
    readPart(report, "terminator", m.terminator);
    readPart(report, "selfShadowed", m.selfShadowed);
    if (!objectField(report, "boundaryPixels", true).is_null())
        readPart(report, "boundaryPixels", m.boundary.emplace());
    readPart(report, "causes", m.causes);
    readPart(report, "rmsePointSun", m.pointSun);
    readPart(report, "rmseDiscSun", m.discSun);
    readPart(report, "rmsePointSunFiltered4x4", m.thin);
    readPart(report, "catastrophes", m.catastrophes);
    return m;
}

} // namespace gnomon::examples
