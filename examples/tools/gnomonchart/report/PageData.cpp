// SPDX-License-Identifier: MIT
#include "PageData.h"

#include "JsonFields.h"
#include "PointNumbers.h"
#include "Report.h"

namespace gnomon::examples {
namespace {

using nlohmann::ordered_json;

ordered_json numbersJson() {
    ordered_json list = ordered_json::array();
    for (const PointNumber& number : pointNumbers())
        list.push_back(
            {{"title", number.title}, {"unit", number.unit}, {"group", number.group}, {"inTable", number.inTable}});
    return list;
}

ordered_json valuesJson(const ChartPoint& point) {
    ordered_json list = ordered_json::array();
    for (const PointNumber& number : pointNumbers()) list.emplace_back(jsonOf(number.of(point)));
    return list;
}

/// In words why a point is catastrophic; empty if it is not.
std::string badText(const ChartPoint& point) {
    if (!point.failure.empty()) return point.failure;
    return point.catastrophic() ? catastropheText(point.errors->catastrophes) : "";
}

ordered_json pointJson(const ChartPoint& point, PagePictures& pictures) {
    return {{"scene", point.scene},
            {"kit", point.kit},
            {"technique", point.technique},
            {"setting", point.setting},
            {"settings", point.settings},
            {"values", valuesJson(point)},
            {"bad", badText(point)},
            {"notes", point.notes},
            {"picture", pictures.add(point.picture)},
            {"overlay", pictures.add(point.overlay)}};
}

ordered_json sceneJson(const ChartSceneResult& scene, PagePictures& pictures) {
    return {{"name", scene.name},
            {"title", scene.title},
            {"triangles", scene.triangles},
            {"frame", jsonOf(scene.frame)},
            {"boundaryFloor", jsonOf(scene.boundaryFloor)},
            {"misclassifiedFloor", jsonOf(100.0 * scene.misclassifiedFloor)},
            {"view", scene.view},
            {"truth", pictures.add(scene.truthPicture)}};
}

} // namespace

ordered_json pageData(const ChartResults& results, PagePictures& pictures) {
    ordered_json scenes = ordered_json::array(), points = ordered_json::array();
    for (const ChartSceneResult& scene : results.scenes) scenes.push_back(sceneJson(scene, pictures));
    for (const ChartPoint& point : results.points) points.push_back(pointJson(point, pictures));
    return {{"numbers", numbersJson()}, {"scenes", scenes}, {"points", points}, {"pictures", pictures.json()}};
}

std::string scriptJson(const ordered_json& data) {
    std::string text;
    for (const char c : data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
        text += c == '<' ? "\\u003c" : std::string(1, c);
    return text;
}

} // namespace gnomon::examples
