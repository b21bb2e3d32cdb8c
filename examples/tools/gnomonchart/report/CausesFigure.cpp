// SPDX-License-Identifier: MIT
#include "CausesFigure.h"

#include "GnuplotText.h"
#include "LogAxis.h"
#include "TextTemplate.h"

#include <gnomon_plot.h>

#include <algorithm>
#include <array>

namespace gnomon::examples {
namespace {

using metrics::CauseSplit;

constexpr double width = 900.0, rowHeight = 18.0, head = 78.0, foot = 44.0; // px
constexpr double barLeft = 300.0, barRight = 640.0, dotLeft = 664.0, dotRight = 826.0;
constexpr double leastShownShare = 0.001; // %

struct Cause {
    std::size_t CauseSplit::*pixels;
    const char *name, *colour;
};

/// False shadow in blues, missed shadow in reds, as in the pictures of errors.
constexpr std::array<Cause, 5> causes = {{{&CauseSplit::acne, "acne", "#9ecae1"},
                                          {&CauseSplit::halo, "halo", "#2b7bba"},
                                          {&CauseSplit::peterPanning, "peter-panning", "#fdbb9b"},
                                          {&CauseSplit::leak, "leak", "#8f1414"},
                                          {&CauseSplit::erosion, "erosion", "#e8593c"}}};

/// One technique's wrong pixels, added up.
struct CauseRow {
    std::string label;
    const char *colour = "", *textColour = "";
    std::array<std::size_t, causes.size()> pixels{};
    std::size_t wrong = 0, judged = 0;
};

/// Where the boundary is least off; the first setting where that is unknown.
const CurvePoint& bestOf(const Curve& curve) {
    return *std::min_element(curve.points.begin(), curve.points.end(),
                             [](const CurvePoint& a, const CurvePoint& b) { return a.error < b.error; });
}

void addPoint(CauseRow& row, const metrics::ShadowMetrics& errors) {
    for (std::size_t i = 0; i < causes.size(); ++i) {
        row.pixels[i] += errors.causes.*causes[i].pixels;
        row.wrong += errors.causes.*causes[i].pixels;
    }
    row.judged += errors.certain;
}

CauseRow rowOf(const ChartResults& results, const Curve& curve, const CurveStyles& styles, const std::string& scene) {
    const std::string& setting = bestOf(curve).setting;
    const char* colour = styles.of(curve.kit, curve.technique).colour;
    CauseRow row{curve.technique + ", " + setting, colour, curve.ours() ? colour : "#4b5563"};
    for (const ChartPoint& point : results.points) {
        const bool here = scene.empty() || point.scene == scene;
        const bool same = point.kit == curve.kit && point.technique == curve.technique && point.setting == setting;
        if (here && same && point.errors) addPoint(row, *point.errors);
    }
    return row;
}

std::vector<CauseRow> rowsOf(const ChartResults& results, const CurveStyles& styles, const std::string& scene) {
    std::vector<Curve> curves =
        scene.empty() ? pooledCurves(results, LightMotion::Still) : sceneCurves(results, scene, LightMotion::Still);
    std::stable_partition(curves.begin(), curves.end(), [](const Curve& curve) { return curve.ours(); });
    std::vector<CauseRow> rows;
    for (const Curve& curve : curves) rows.push_back(rowOf(results, curve, styles, scene));
    rows.erase(std::remove_if(rows.begin(), rows.end(), [](const CauseRow& row) { return row.judged == 0; }),
               rows.end());
    return rows;
}

double percent(std::size_t part, std::size_t whole) {
    return whole ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

std::string line(const std::vector<double>& numbers, const char* colour) {
    std::string text;
    for (const double number : numbers) text += plotNumber(number) + "\t";
    return text + plotColour(colour) + "\n";
}

std::string barLines(const std::vector<CauseRow>& rows) {
    std::string lines;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double y = static_cast<double>(i) + 0.5;
        double from = 0.0;
        for (std::size_t c = 0; c < causes.size(); ++c) {
            const double to = from + percent(rows[i].pixels[c], rows[i].wrong);
            if (to > from) lines += line({0.5 * (from + to), y, from, to, y - 0.36, y + 0.36}, causes[c].colour);
            from = to;
        }
    }
    // gnuplot refuses a block without rows: this one is off the page.
    return lines.empty() ? "-9\t-9\t-9\t-9\t-9\t-9\t0\n" : lines;
}

std::string shareLines(const std::vector<CauseRow>& rows) {
    std::string lines;
    for (std::size_t i = 0; i < rows.size(); ++i)
        lines += line({std::max(leastShownShare, percent(rows[i].wrong, rows[i].judged)), static_cast<double>(i) + 0.5},
                      rows[i].colour);
    return lines;
}

std::string shareText(const CauseRow& row) { return shortNumber(percent(row.wrong, row.judged)) + " %"; }

double heightOf(const std::vector<CauseRow>& rows) {
    return head + rowHeight * static_cast<double>(rows.size()) + foot;
}

std::string keyCommands(glm::dvec2 at) {
    const TextLook look{9.0};
    std::string commands;
    for (const Cause& cause : causes) {
        commands += lineCommand(at, {at.x + 18.0, at.y}, std::string("lw 9 lc rgb '") + cause.colour + "'");
        commands += textCommand(cause.name, {at.x + 24.0, at.y}, look);
        at.x += textSize(cause.name, look).x + 40.0;
    }
    return commands;
}

std::string labelCommands(const std::vector<CauseRow>& rows, const std::string& title) {
    const double top = heightOf(rows);
    std::string commands =
        textCommand(title, {16.0, top - 16.0}, {14.0, "#111827", true}) +
        textCommand(
            "Each technique at the setting with the smallest boundary error. Blue: false shadow. Red: missed shadow.",
            {16.0, top - 35.0}, {9.0}) +
        keyCommands({barLeft, top - 58.0});
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double y = top - head - rowHeight * (static_cast<double>(i) + 0.5);
        commands += textCommand(rows[i].label, {16.0, y}, {9.5, rows[i].textColour});
        commands += textCommand(shareText(rows[i]), {dotRight + 10.0, y}, {9.0});
    }
    return commands;
}

LogAxis shareAxis(const std::vector<CauseRow>& rows) {
    std::vector<double> shares;
    for (const CauseRow& row : rows) shares.push_back(percent(row.wrong, row.judged));
    return logAxis(shares, leastShownShare, dotLeft, dotRight);
}

} // namespace

std::optional<FigureScript> causesScript(const ChartResults& results, const CurveStyles& styles,
                                         const std::string& name, const std::string& title, const std::string& scene) {
    const std::vector<CauseRow> rows = rowsOf(results, styles, scene);
    if (rows.empty()) return std::nullopt;
    const LogAxis axis = shareAxis(rows);
    return FigureScript{fillTemplate(plot::causes_gnuplot, {{"NAME", name},
                                                            {"BARS", barLines(rows)},
                                                            {"SHARES", shareLines(rows)},
                                                            {"ROWS", std::to_string(rows.size())},
                                                            {"LABELS", labelCommands(rows, title)},
                                                            {"LOW", plotNumber(axis.low)},
                                                            {"HIGH", plotNumber(axis.high)},
                                                            {"XTICS", plotTics(axis.ticks(5))},
                                                            {"WIDTH", plotNumber(width)},
                                                            {"HEIGHT", plotNumber(heightOf(rows))},
                                                            {"TOP", plotNumber(heightOf(rows) - head)},
                                                            {"BOTTOM", plotNumber(foot)},
                                                            {"BARLEFT", plotNumber(barLeft)},
                                                            {"BARRIGHT", plotNumber(barRight)},
                                                            {"DOTLEFT", plotNumber(dotLeft)},
                                                            {"DOTRIGHT", plotNumber(dotRight)}}),
                        {}};
}

} // namespace gnomon::examples
