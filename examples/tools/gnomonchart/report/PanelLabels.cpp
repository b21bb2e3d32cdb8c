// SPDX-License-Identifier: MIT
#include "PanelLabels.h"

#include "GnuplotText.h"
#include "LabelPlacement.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

namespace gnomon::examples {
namespace {

constexpr double halfMarker = 5.0, lineStep = 4.0; // px

/// A text to be placed, and how it looks.
struct Label {
    std::string text;
    TextLook look;
    LabelWish wish;
};

glm::dvec2 placeOf(const CurvePoint& point, const PanelAxes& axes) {
    return {axes.time.place(point.time.median), axes.error.place(point.error)};
}

/// Where a curve's points are, px, in its order.
std::vector<glm::dvec2> placesOf(const Curve& curve, const PanelAxes& axes) {
    std::vector<glm::dvec2> places;
    for (const CurvePoint& point : curve.points)
        if (point.shown()) places.push_back(placeOf(point, axes));
    return places;
}

PageBox around(const glm::dvec2& at) { return {at - halfMarker, at + halfMarker}; }

constexpr std::size_t ofTheFloor = std::numeric_limits<std::size_t>::max(); // owner of the dashed line

void addLine(std::vector<DrawnPoint>& line, const glm::dvec2& from, const glm::dvec2& to, std::size_t owner) {
    const double length = glm::distance(from, to);
    line.push_back({to, owner});
    for (double way = 0.0; way < length; way += lineStep) line.push_back({from + (way / length) * (to - from), owner});
}

/// What labels must keep clear of.
struct Obstacles {
    std::vector<PageBox> markers;
    std::vector<DrawnPoint> lines;
};

void addCurve(Obstacles& found, const Curve& curve, const PanelAxes& axes, std::size_t owner) {
    std::optional<glm::dvec2> last;
    for (const CurvePoint& point : curve.points) {
        if (!point.shown()) continue;
        const glm::dvec2 place = placeOf(point, axes);
        found.markers.push_back(around(place));
        addLine(found.lines, {axes.time.place(point.time.q1), place.y}, {axes.time.place(point.time.q3), place.y},
                owner);
        if (last) addLine(found.lines, *last, place, owner);
        last = place;
    }
}

Obstacles obstaclesOf(const FigurePanel& panel, const PanelAxes& axes) {
    Obstacles found;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) addCurve(found, panel.curves[i], axes, i);
    const double floor = axes.error.place(panel.floor.value_or(0.0));
    if (panel.floor) addLine(found.lines, {axes.time.from, floor}, {axes.time.to, floor}, ofTheFloor);
    return found;
}

/// "planar (3 of 5 scenes)" where it was not tried in all.
std::string nameOf(const Curve& curve, std::size_t scenes) {
    std::size_t tried = 0;
    for (const CurvePoint& point : curve.points) tried = std::max(tried, point.scenes);
    if (tried >= scenes) return curve.technique;
    return curve.technique + " (" + std::to_string(tried) + " of " + std::to_string(scenes) + " scenes)";
}

/// Dearest the two ends, the accurate one first.
std::vector<glm::dvec2> endsFirst(std::vector<glm::dvec2> places) {
    std::reverse(places.begin(), places.end());
    if (places.size() > 2) std::rotate(places.begin() + 1, places.end() - 1, places.end());
    return places;
}

void addName(std::vector<Label>& labels, const FigurePanel& panel, std::size_t number, const CurveStyles& styles,
             const PanelAxes& axes, std::size_t scenes) {
    const Curve& curve = panel.curves[number];
    const std::vector<glm::dvec2> places = endsFirst(placesOf(curve, axes));
    if (places.empty()) return;
    const TextLook look = curve.ours() ? TextLook{11.0, styles.of(curve.kit, curve.technique).colour, true}
                                       : TextLook{9.0, "#4b5563", false};
    const std::string name = nameOf(curve, scenes);
    labels.push_back({name, look, {textSize(name, look), places, number}});
}

/// The settings at both ends of a curve.
void addSettings(std::vector<Label>& labels, const FigurePanel& panel, std::size_t number, const PanelAxes& axes) {
    std::vector<CurvePoint> shown;
    for (const CurvePoint& point : panel.curves[number].points)
        if (point.shown()) shown.push_back(point);
    if (shown.size() < 2) return;
    const TextLook look{8.0, "#6b7280"};
    for (const CurvePoint& end : {shown.front(), shown.back()})
        labels.push_back({end.setting, look, {textSize(end.setting, look), {placeOf(end, axes)}, number, false}});
}

/// What the dashed line is, somewhere along it.
void addFloor(std::vector<Label>& labels, const FigurePanel& panel, const PanelAxes& axes) {
    if (!panel.floor) return;
    const TextLook look{8.0, "#111827"};
    const std::string text = "one perfect ray a pixel: " + shortNumber(*panel.floor) + " px";
    LabelWish wish{textSize(text, look), {}, ofTheFloor};
    for (double x = axes.time.from + 60.0; x < axes.time.to; x += 20.0)
        wish.anchors.emplace_back(x, axes.error.place(*panel.floor));
    labels.push_back({text, look, wish});
}

/// KeyNumbers of the curves, Gnomon's first.
std::vector<std::size_t> gnomonFirst(const FigurePanel& panel) {
    std::vector<std::size_t> order(panel.curves.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return panel.curves[i].ours(); });
    return order;
}

/// In the order in which they get their places.
std::vector<Label> labelsOf(const FigurePanel& panel, const CurveStyles& styles, const PanelAxes& axes,
                            std::size_t scenes) {
    std::vector<Label> labels;
    for (const std::size_t i : gnomonFirst(panel)) addName(labels, panel, i, styles, axes, scenes);
    addFloor(labels, panel, axes);
    for (const std::size_t i : gnomonFirst(panel)) addSettings(labels, panel, i, axes);
    return labels;
}

std::string commandsOf(const Label& label, const PlacedLabel& placed) {
    if (!placed.placed) return "";
    const glm::dvec2 at(placed.box.low.x, 0.5 * (placed.box.low.y + placed.box.high.y));
    std::string commands = textCommand(label.text, at, label.look);
    if (placed.leader)
        commands += lineCommand(placed.anchor, glm::clamp(placed.anchor, placed.box.low, placed.box.high),
                                "lw 0.5 lc rgb '#9aa1ad'");
    return commands;
}

} // namespace

std::string panelLabels(const FigurePanel& panel, const CurveStyles& styles, const PanelAxes& axes,
                        std::size_t scenes) {
    const std::vector<Label> labels = labelsOf(panel, styles, axes, scenes);
    std::vector<LabelWish> wishes;
    for (const Label& label : labels) wishes.push_back(label.wish);
    const Obstacles obstacles = obstaclesOf(panel, axes);
    const PageBox frame{{axes.time.from + 2.0, axes.error.from + 2.0}, {axes.time.to, axes.error.to}};
    const std::vector<PlacedLabel> placed = placeLabels(wishes, frame, obstacles.markers, obstacles.lines);
    std::string commands;
    for (std::size_t i = 0; i < labels.size(); ++i) commands += commandsOf(labels[i], placed[i]);
    return commands;
}

} // namespace gnomon::examples
