// SPDX-License-Identifier: MIT
#include "Figure.h"

#include "GnuplotText.h"
#include "LabelPlacement.h"
#include "PanelLabels.h"
#include "TextTemplate.h"

#include <gnomon_plot.h>

#include <algorithm>

namespace gnomon::examples {
namespace {

constexpr double width = 900.0, panelHeight = 400.0, head = 88.0, gap = 62.0, foot = 44.0; // px
constexpr double left = 66.0, right = width - 14.0;

double heightOf(const Figure& figure) {
    const auto panels = static_cast<double>(figure.panels.size());
    return head + panels * panelHeight + (panels - 1.0) * gap + foot;
}

PageBox boxOf(const Figure& figure, std::size_t number) {
    const double top = heightOf(figure) - head - static_cast<double>(number) * (panelHeight + gap);
    return {{left, top - panelHeight}, {right, top}};
}

/// Every point that has a place, of every curve.
template <typename Visit>
void forShown(const FigurePanel& panel, const Visit& visit) {
    for (const Curve& curve : panel.curves)
        for (const CurvePoint& point : curve.points)
            if (point.shown()) visit(curve, point);
}

/// The axes that fit all panels. Quartiles may reach beyond: a single low one, near zero or below it, would stretch the
/// axis over decades of nothing.
PanelAxes axesOf(const Figure& figure) {
    std::vector<double> times, errors;
    for (const FigurePanel& panel : figure.panels) {
        forShown(panel, [&](const Curve&, const CurvePoint& point) {
            times.push_back(point.time.median);
            errors.push_back(point.error);
        });
        if (panel.floor) errors.push_back(*panel.floor);
    }
    return {logAxis(times, leastShownTime, left, right), logAxis(errors, leastShownError, 0.0, panelHeight)};
}

/// Columns of one row.
std::string line(const std::vector<std::string>& columns) {
    std::string text;
    for (const std::string& column : columns) text += (text.empty() ? "" : "\t") + column;
    return text + "\n";
}

/// A named block of data. gnuplot refuses one without rows, and crashes over NaN: the row of such a block is far off.
std::string block(const std::string& name, const std::string& rows) {
    constexpr const char* nothing = "1e-30\t1e-30\t1e-30\t1e-30\t1e-30\t1e-30\t0\n";
    return "$" + name + " << EOD\n" + (rows.empty() ? nothing : rows) + "EOD\n";
}

std::string timeText(double ms) { return plotNumber(std::max(ms, leastShownTime)); }
std::string errorText(double pixels) { return plotNumber(std::max(pixels, leastShownError)); }

std::string curveRows(const FigurePanel& panel, const CurveStyles& styles, bool ours) {
    std::string rows;
    for (const Curve& curve : panel.curves) {
        if (curve.ours() != ours) continue;
        const std::string colour = plotColour(styles.of(curve.kit, curve.technique).colour);
        rows += plotComment(curve.kit + " " + curve.technique) + "\n";
        for (const CurvePoint& point : curve.points)
            if (point.shown()) rows += line({timeText(point.time.median), errorText(point.error), colour});
        rows += "\n";
    }
    return rows;
}

std::string quartileRows(const FigurePanel& panel, const CurveStyles& styles, const PanelAxes& axes) {
    std::string rows;
    const auto onAxis = [&](double ms) { return plotNumber(std::clamp(ms, axes.time.low, axes.time.high)); };
    forShown(panel, [&](const Curve& curve, const CurvePoint& point) {
        rows += line({timeText(point.time.median), errorText(point.error), onAxis(point.time.q1), onAxis(point.time.q3),
                      plotColour(styles.of(curve.kit, curve.technique).colour)});
    });
    return rows;
}

std::string markerRows(const FigurePanel& panel, const CurveStyles& styles, std::size_t number) {
    std::string rows;
    forShown(panel, [&](const Curve& curve, const CurvePoint& point) {
        const CurveStyle style = styles.of(curve.kit, curve.technique);
        const int filled = style.shape + 1;
        rows += line({timeText(point.time.median), errorText(point.error),
                      std::to_string(point.catastrophic ? style.shape : filled), plotColour(style.colour),
                      curve.ours() ? "0.95" : "0.75", std::to_string(filled), std::to_string(number++),
                      plotComment(curve.kit + " " + curve.technique + ", " + point.setting)});
    });
    return rows;
}

/// From the top above the fastest, along each one's error until the next is fast enough, and on to the right end.
std::string staircaseRows(const FigurePanel& panel, const PanelAxes& axes) {
    std::string rows;
    double error = axes.error.high;
    const auto corner = [&](double ms) { rows += timeText(ms) + "\t" + errorText(error) + "\n"; };
    const std::vector<BestPoint> best = staircase(panel.curves);
    for (const BestPoint& next : best) {
        corner(next.point->time.median);
        error = next.point->error;
        corner(next.point->time.median);
    }
    if (!best.empty()) corner(axes.time.high);
    return rows;
}

std::string floorRows(const FigurePanel& panel, const PanelAxes& axes) {
    if (!panel.floor) return "";
    const std::string y = "\t" + errorText(*panel.floor) + "\n";
    return plotNumber(axes.time.low) + y + plotNumber(axes.time.high) + y;
}

std::string dataOf(const FigurePanel& panel, const CurveStyles& styles, const PanelAxes& axes, std::size_t number) {
    const std::string& name = panel.name;
    return block(name + "_floor", floorRows(panel, axes)) + block(name + "_staircase", staircaseRows(panel, axes)) +
           block(name + "_others_curves", curveRows(panel, styles, false)) +
           block(name + "_gnomon_curves", curveRows(panel, styles, true)) +
           block(name + "_quartiles", quartileRows(panel, styles, axes)) +
           block(name + "_markers", markerRows(panel, styles, number));
}

/// One thing that the line below the title explains: a marker or a line, and words.
struct KeyEntry {
    const char *look, *words;
    bool line;
};

std::string keyCommands(glm::dvec2 at) {
    const TextLook look{9.0};
    const KeyEntry entries[] = {{"pt 7 ps 0.95 lc rgb '#0072b2'", "Gnomon, in colours", false},
                                {"pt 7 ps 0.75 lc rgb '#6b7280'", "osgShadow, in greys", false},
                                {"pt 6 ps 0.95 lw 1.3 lc rgb '#0072b2'", "hollow: a catastrophe", false},
                                {"lw 7 lc rgb '#fbe3b0'", "the best for their time", true},
                                {"dt (10,9) lw 1.2 lc rgb '#111827'", "one perfect ray a pixel", true},
                                {"lw 0.7 lc rgb '#6b7280'", "quartiles of the time", true}};
    std::string commands;
    for (const KeyEntry& entry : entries) {
        const std::string sign = std::string(" point ") + entry.look;
        if (entry.line) commands += lineCommand({at.x, at.y}, {at.x + 24.0, at.y}, entry.look);
        if (!entry.line) commands += textCommand("", {at.x + 12.0, at.y}, look, sign);
        commands += textCommand(entry.words, {at.x + (entry.line ? 30.0 : 22.0), at.y}, look);
        at.x += textSize(entry.words, look).x + 25.0;
    }
    return commands;
}

std::string headCommands(const Figure& figure) {
    const double top = heightOf(figure);
    return textCommand(figure.title, {left - 50.0, top - 16.0}, {14.0, "#111827", true}) +
           textCommand(figure.remark, {left - 50.0, top - 35.0}, {9.5}) + keyCommands({left - 50.0, top - 56.0});
}

std::string panelCommands(const Figure& figure, std::size_t number, const CurveStyles& styles, PanelAxes axes) {
    const FigurePanel& panel = figure.panels[number];
    const PageBox box = boxOf(figure, number);
    axes.error.from = box.low.y;
    axes.error.to = box.high.y;
    std::string labels = textCommand(panel.title, {left, box.high.y + 12.0}, {11.0, "#111827", true});
    if (number == 0) labels += headCommands(figure);
    labels += panelLabels(panel, styles, axes, figure.scenes);
    return fillTemplate(plot::panel_gnuplot, {{"PANEL", panel.name},
                                              {"LEFT", plotNumber(box.low.x)},
                                              {"RIGHT", plotNumber(box.high.x)},
                                              {"BOTTOM", plotNumber(box.low.y)},
                                              {"TOP", plotNumber(box.high.y)},
                                              {"XLOW", plotNumber(axes.time.low)},
                                              {"XHIGH", plotNumber(axes.time.high)},
                                              {"YLOW", plotNumber(axes.error.low)},
                                              {"YHIGH", plotNumber(axes.error.high)},
                                              {"XTICS", plotTics(axes.time.ticks())},
                                              {"YTICS", plotTics(axes.error.ticks())},
                                              {"XLABEL", "time that shadows add to a frame (ms)"},
                                              {"LABELS", labels}});
}

std::string timeWords(const AddedTime& time) {
    return shortNumber(time.median) + " ms (" + shortNumber(time.q1) + " to " + shortNumber(time.q3) + ")";
}

std::vector<FigureMarker> markersOf(const FigurePanel& panel, std::size_t scenes) {
    std::vector<FigureMarker> markers;
    forShown(panel, [&](const Curve& curve, const CurvePoint& point) {
        std::string text = curve.kit + " " + curve.technique + ", " + point.setting + ": " + timeWords(point.time) +
                           ", " + shortNumber(point.error) + " px";
        if (scenes > 1) text += ", " + std::to_string(point.scenes) + " of " + std::to_string(scenes) + " scenes";
        if (point.catastrophic) text += ", catastrophic";
        markers.push_back({curve.kit, curve.technique, point.setting, text});
    });
    return markers;
}

} // namespace

FigureScript figureScript(const Figure& figure, const CurveStyles& styles) {
    FigureScript script;
    std::string data, panels;
    const PanelAxes axes = axesOf(figure);
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        data += dataOf(figure.panels[i], styles, axes, script.markers.size());
        panels += panelCommands(figure, i, styles, axes);
        const std::vector<FigureMarker> more = markersOf(figure.panels[i], figure.scenes);
        script.markers.insert(script.markers.end(), more.begin(), more.end());
    }
    script.text = fillTemplate(plot::figure_gnuplot, {{"NAME", figure.name},
                                                      {"DATA", data},
                                                      {"PANELS", panels},
                                                      {"WIDTH", plotNumber(width)},
                                                      {"HEIGHT", plotNumber(heightOf(figure))}});
    return script;
}

} // namespace gnomon::examples
