// SPDX-License-Identifier: MIT
#include "PredictionFigure.h"

#include "GnuplotText.h"
#include "LogAxis.h"
#include "PredictionSummary.h"
#include "TextTemplate.h"

#include <gnomon_plot.h>

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr double width = 900.0, side = 360.0, left = 66.0, gap = 84.0, head = 88.0, foot = 44.0; // px
constexpr double height = head + side + foot;

/// Something predicted and measured.
struct Pair {
    const ChartPoint* point;
    double predicted, measured;
    const char* what; ///< for people: ", still light".
};

/// One of the two charts: both of its axes are alike.
struct Panel {
    const char *name, *title, *unit;
    double least, factor;
    std::vector<Pair> pairs;
};

Panel errorsOf(const ChartResults& results, const std::string& scene) {
    Panel panel{"errors", "Boundary error, 95th percentile", "px", leastShownError, errorFactor, {}};
    for (const ChartPoint& point : results.points) {
        if (!point.prediction || !point.prediction->error || !point.errors || !point.errors->boundary) continue;
        if (!scene.empty() && point.scene != scene) continue;
        panel.pairs.push_back({&point, *point.prediction->error, point.errors->boundary->p95, ""});
    }
    return panel;
}

Panel timesOf(const ChartResults& results, const std::string& scene) {
    Panel panel{"times", "Processor time added to a frame", "ms", leastShownTime, timeFactor, {}};
    for (const ChartPoint& point : results.points) {
        if (!point.prediction || !point.cost) continue;
        if (!scene.empty() && point.scene != scene) continue;
        const ChartPrediction& prediction = *point.prediction;
        panel.pairs.push_back({&point, prediction.steady.time, point.cost->steadyProcessor.median, ", still light"});
        panel.pairs.push_back({&point, prediction.moving.time, point.cost->movingProcessor.median, ", moving light"});
    }
    return panel;
}

/// NaN and less than the least are drawn at the least.
double shown(const Panel& panel, double value) { return value > panel.least ? value : panel.least; }

LogAxis axisOf(const Panel& panel) {
    std::vector<double> values;
    for (const Pair& pair : panel.pairs)
        for (const double value : {pair.predicted, pair.measured})
            if (std::isfinite(value)) values.push_back(shown(panel, value));
    return logAxis(values, panel.least, 0.0, side);
}

std::string rowsOf(const Panel& panel, const CurveStyles& styles, std::size_t number) {
    std::string rows;
    for (const Pair& pair : panel.pairs) {
        const CurveStyle style = styles.of(pair.point->kit, pair.point->technique);
        const int shape = style.shape + (isTuningScene(pair.point->scene) ? 1 : 0);
        rows += plotNumber(shown(panel, pair.predicted)) + "\t" + plotNumber(shown(panel, pair.measured)) + "\t" +
                std::to_string(shape) + "\t" + plotColour(style.colour) + "\t" + std::to_string(number++) + "\n";
    }
    return rows.empty() ? "1e-30\t1e-30\t1\t0\t0\n" : rows; // gnuplot refuses a block without rows: it is off the page
}

std::string panelText(const Panel& panel, double from, const std::string& labels) {
    const LogAxis axis = axisOf(panel);
    return fillTemplate(
        plot::predicted_panel_gnuplot,
        {{"PANEL", panel.name},
         {"UNIT", panel.unit},
         {"FACTOR", plotNumber(panel.factor)},
         {"LEFT", plotNumber(from)},
         {"RIGHT", plotNumber(from + side)},
         {"BOTTOM", plotNumber(foot)},
         {"TOP", plotNumber(foot + side)},
         {"LOW", plotNumber(axis.low)},
         {"HIGH", plotNumber(axis.high)},
         {"TICS", plotTics(axis.ticks(8))},
         {"LABELS", labels + textCommand(panel.title, {from, foot + side + 12.0}, {11.0, "#111827", true})}});
}

void addMarkers(std::vector<FigureMarker>& markers, const Panel& panel) {
    for (const Pair& pair : panel.pairs) {
        const ChartPoint& point = *pair.point;
        markers.push_back({point.kit, point.technique, point.setting,
                           point.scene + ": " + point.technique + ", " + point.setting + pair.what + ": predicted " +
                               shortNumber(pair.predicted) + ", measured " + shortNumber(pair.measured) + " " +
                               panel.unit});
    }
}

/// Each technique that has a marker, by its colour and shape.
std::string keyCommands(const Panel& panel, const CurveStyles& styles, glm::dvec2 at) {
    const TextLook look{9.0};
    std::string commands;
    std::vector<std::string> named;
    for (const Pair& pair : panel.pairs) {
        const std::string& technique = pair.point->technique;
        if (std::find(named.begin(), named.end(), technique) != named.end()) continue;
        named.push_back(technique);
        const CurveStyle style = styles.of(pair.point->kit, technique);
        commands +=
            textCommand("", {at.x + 6.0, at.y}, look,
                        " point pt " + std::to_string(style.shape + 1) + " ps 0.95 lc rgb '" + style.colour + "'");
        commands += textCommand(technique, {at.x + 15.0, at.y}, look);
        at.x += textSize(technique, look).x + 32.0;
    }
    return commands +
           textCommand("filled: scenes that the model was built on; hollow: other scenes", {at.x, at.y}, look);
}

} // namespace

std::optional<FigureScript> predictionScript(const ChartResults& results, const CurveStyles& styles,
                                             const std::string& name, const std::string& title,
                                             const std::string& scene) {
    const Panel errors = errorsOf(results, scene), times = timesOf(results, scene);
    if (errors.pairs.empty() && times.pairs.empty()) return std::nullopt;
    FigureScript script;
    addMarkers(script.markers, errors);
    addMarkers(script.markers, times);
    const std::string labels = textCommand(title, {left - 50.0, height - 16.0}, {14.0, "#111827", true}) +
                               keyCommands(times.pairs.empty() ? errors : times, styles, {left - 50.0, height - 42.0});
    script.text = fillTemplate(plot::predicted_gnuplot,
                               {{"NAME", name},
                                {"ERRORS", rowsOf(errors, styles, 0)},
                                {"TIMES", rowsOf(times, styles, errors.pairs.size())},
                                {"PANELS", panelText(errors, left, labels) + panelText(times, left + side + gap, "")},
                                {"WIDTH", plotNumber(width)},
                                {"HEIGHT", plotNumber(height)}});
    return script;
}

} // namespace gnomon::examples
