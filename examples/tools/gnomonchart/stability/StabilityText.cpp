// SPDX-License-Identifier: MIT
#include "StabilityText.h"

#include <iomanip>
#include <sstream>

namespace gnomon::examples {
namespace {

constexpr int nameWidth = 36;

std::string nameOf(const std::string& technique, const std::string& setting) {
    return technique + (setting == "defaults" ? "" : ", " + setting);
}

std::string leftText(const StabilitySceneText& scene, const StabilityRow& row) {
    const std::optional<std::size_t> left = row.leftAt();
    if (!left) return "held to the end";
    const StabilityCell& cell = row.cells[*left];
    std::ostringstream out;
    out << examples::nameOf(row.outcome()) << " at " << valueText(scene.values[*left]) << " " << scene.unit << ": ";
    if (!cell.failure.empty())
        out << cell.failure << ", " << cell.message;
    else
        out << cell.everywhere.wrong << " wrong pixels, IoU " << std::setprecision(3) << cell.everywhere.iou;
    if (cell.failure.empty() && cell.everywhere.p95) out << ", p95 " << *cell.everywhere.p95 << " px";
    if (!cell.diagnosis.empty()) out << ". It says: " << cell.diagnosis.front();
    return out.str();
}

void addScene(std::ostream& out, const StabilityResults& results, const StabilitySceneText& scene) {
    out << scene.id << "  " << scene.title << " (" << scene.parameter;
    for (const double value : scene.values) out << " " << valueText(value);
    out << (scene.unit.empty() ? "" : " " + scene.unit) << ")\n";
    for (const StabilityRow& row : results.rows)
        if (row.scene == scene.id)
            out << "  " << std::left << std::setw(nameWidth) << nameOf(row.technique, row.setting)
                << leftText(scene, row) << "\n";
}

void addCounts(std::ostream& out, const StabilityResults& results) {
    out << std::left << std::setw(nameWidth + 2) << "technique"
        << "held  stated  elsewhere  left  catastrophes\n";
    for (const StabilityCount& count : countsOf(results))
        out << "  " << std::left << std::setw(nameWidth) << nameOf(count.technique, count.setting) << std::right
            << std::setw(4) << count.held << std::setw(8) << count.stated << std::setw(11) << count.elsewhere
            << std::setw(6) << count.left << std::setw(14) << count.catastrophes << "\n";
}

} // namespace

std::string stabilityText(const StabilityResults& results, bool sceneByScene) {
    std::ostringstream out;
    if (sceneByScene)
        for (const StabilitySceneText& scene : results.scenes) addScene(out, results, scene);
    addCounts(out, results);
    return out.str();
}

} // namespace gnomon::examples
