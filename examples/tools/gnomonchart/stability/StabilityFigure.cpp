// SPDX-License-Identifier: MIT
#include "StabilityFigure.h"

#include "GnuplotText.h"
#include "TextTemplate.h"

#include <gnomon_stability_page.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace gnomon::examples {
namespace {

constexpr double cellWidth = 19.0, cellHeight = 17.0, left = 230.0, right = 20.0, head = 104.0, foot = 54.0; // px

/// Cells of one look, a line each.
struct CellLines {
    std::string all, stated, elsewhere, crosses;
};

/// gnuplot refuses a block without rows: this one is off the page.
std::string orOffPage(const std::string& lines) { return lines.empty() ? "-9\t-9\t0\n" : lines; }

std::string lineOf(std::size_t column, std::size_t row, const std::string& colour) {
    return plotNumber(double(column) + 0.5) + "\t" + plotNumber(double(row) + 0.5) + "\t" + plotColour(colour.c_str()) +
           "\n";
}

std::size_t columnOf(const StabilityResults& results, const std::string& scene) {
    std::size_t column = 0;
    while (column < results.scenes.size() && results.scenes[column].id != scene) ++column;
    return column;
}

std::size_t placeOf(const std::vector<StabilityCount>& counts, const StabilityRow& row) {
    std::size_t place = 0;
    while (place < counts.size() && (counts[place].kit != row.kit || counts[place].technique != row.technique ||
                                     counts[place].setting != row.setting))
        ++place;
    return place;
}

CellLines cellLines(const StabilityResults& results, const std::vector<StabilityCount>& counts) {
    CellLines lines;
    for (const StabilityRow& row : results.rows) {
        const std::string line = lineOf(columnOf(results, row.scene), placeOf(counts, row), reachColour(row.reach()));
        lines.all += line;
        const StabilityOutcome outcome = row.outcome();
        if (outcome == StabilityOutcome::STATED) lines.stated += line;
        if (outcome == StabilityOutcome::ELSEWHERE) lines.elsewhere += line;
        if (outcome == StabilityOutcome::CATASTROPHE) lines.crosses += line;
    }
    return lines;
}

std::string labelOf(const StabilityCount& count) {
    return count.technique + (count.setting == "defaults" ? "" : ", " + count.setting);
}

double heightOf(std::size_t rows) { return head + cellHeight * double(rows) + foot; }

std::string rowLabels(const std::vector<StabilityCount>& counts) {
    std::string commands;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const bool ours = counts[i].kit == "Gnomon";
        const double y = heightOf(counts.size()) - head - cellHeight * (double(i) + 0.5);
        commands += textCommand(labelOf(counts[i]), {12.0, y}, {9.5, ours ? "#0072b2" : "#4b5563", ours});
    }
    return commands;
}

std::string columnLabels(const StabilityResults& results, double top) {
    std::string commands;
    for (std::size_t i = 0; i < results.scenes.size(); ++i)
        commands += textCommand(results.scenes[i].id, {left + cellWidth * (double(i) + 0.5), top - head + 6.0}, {8.5},
                                "rotate by 90");
    return commands;
}

/// A section's name above its first scene.
std::string sectionLabels(const StabilityResults& results, double top) {
    std::string commands, before;
    for (std::size_t i = 0; i < results.scenes.size(); ++i) {
        const std::string& section = results.scenes[i].section;
        const double x = left + cellWidth * double(i);
        if (section != before) commands += textCommand(section, {x + 2.0, top - head + 44.0}, {9.0, "#374151", true});
        if (section != before && i)
            commands += lineCommand({x, foot}, {x, top - head + 50.0}, "lw 1.2 lc rgb '#374151'");
        before = section;
    }
    return commands;
}

std::string keyCommands() {
    const TextLook look{9.0};
    return textCommand(
               "Blue: within 1 px (95th percentile) and without wrong pixels to the end of the sweep. Yellow to "
               "red: left late, left at once.",
               {12.0, 36.0}, look) +
           textCommand(
               "Hatched: diagnose() states the limit. Dotted: right on its receiver, other surfaces get no shadow "
               "by design. Cross: catastrophe.",
               {12.0, 18.0}, look);
}

} // namespace

std::string reachColour(double reach) {
    if (reach >= 1.0) return "#5b9bd0";
    constexpr std::array<glm::dvec3, 3> stops{{{208, 55, 39}, {244, 165, 92}, {253, 231, 160}}};
    const double at = glm::clamp(reach, 0.0, 1.0) * 2.0;
    const std::size_t from = at < 1.0 ? 0 : 1;
    const glm::dvec3 mixed = glm::mix(stops[from], stops[from + 1], at - double(from));
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", int(std::lround(mixed.x)), int(std::lround(mixed.y)),
                  int(std::lround(mixed.z)));
    return text.data();
}

FigureScript stabilityScript(const StabilityResults& results, const std::string& name) {
    const std::vector<StabilityCount> counts = countsOf(results);
    const CellLines lines = cellLines(results, counts);
    const double height = heightOf(counts.size()), width = left + cellWidth * double(results.scenes.size()) + right;
    const std::string labels = textCommand("How far each technique gets before its shadow breaks",
                                           {12.0, height - 18.0}, {14.0, "#111827", true}) +
                               rowLabels(counts) + columnLabels(results, height) + sectionLabels(results, height) +
                               keyCommands();
    return {
        fillTemplate(page::stability_gnuplot, {{"NAME", name},
                                               {"CELLS", orOffPage(lines.all)},
                                               {"STATED", orOffPage(lines.stated)},
                                               {"ELSEWHERE", orOffPage(lines.elsewhere)},
                                               {"CROSSES", orOffPage(lines.crosses)},
                                               {"LABELS", labels},
                                               {"ROWS", std::to_string(counts.size())},
                                               {"COLUMNS", std::to_string(results.scenes.size())},
                                               {"WIDTH", plotNumber(std::max(width, 700.0))},
                                               {"HEIGHT", plotNumber(height)},
                                               {"LEFT", plotNumber(left)},
                                               {"RIGHT", plotNumber(left + cellWidth * double(results.scenes.size()))},
                                               {"TOP", plotNumber(height - head)},
                                               {"BOTTOM", plotNumber(foot)}}),
        {}};
}

} // namespace gnomon::examples
