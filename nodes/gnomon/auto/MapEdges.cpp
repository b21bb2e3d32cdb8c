// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/auto/MapEdges.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/MapSlice.h>
#include <gnomon/mapfit/EdgeWidths.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr double usualShare = 0.95; // of the edges: what errors are given for

bool holds(const MapForecast::Map& map, const glm::dvec3& place) {
    const glm::dvec4 here(place, 1.0), in = map.mapFromScene * here;
    return in.w > 0.0 && in.x >= 0.0 && in.y >= 0.0 && in.x <= in.w && in.y <= in.w &&
           std::all_of(map.halfSpaces.begin(), map.halfSpaces.end(),
                       [&](const glm::dvec4& half) { return glm::dot(half, here) >= 0.0; });
}

} // namespace

MapEdges::MapEdges(const AutoView& view, const MapCasters& boxes, const MapForecast& forecast)
    : _pixels(view.frame.pixels.x(), view.frame.pixels.y()) {
    const glm::dvec3 origin = toGlm(boxes.layers->origin);
    const SceneFrame scene(origin);
    _clipFromScene = scene.clipFromScene(view.frame);
    SeenEdges seen(_clipFromScene, *forecast.bounds, view.towards - view.towards.w * glm::dvec4(origin, 0.0));
    for (const MapReceiver& receiver : receiversOf(view.frame, scene.eyeFromScene(view.frame)))
        seen.addReceiver({receiver.low, receiver.high}, receiver.sceneFromBox);
    std::vector<SeenEdges::Box> casters;
    for (const MapLayer* layer : {boxes.still.get(), boxes.moving.get()})
        for (const auto* some : {&layer->bodyBoxes, &layer->flatBoxes})
            for (const MapLayer::Box& box : *some) casters.push_back({box.low, box.high});
    for (const MapForecast::Map& map : forecast.each) seen.addCasters(casters, map.mapFromScene);
    _places = seen.edges();
    if (_places.empty()) _places = seen.facing();
}

std::optional<double> MapEdges::widthOf(const MapForecast& forecast) const {
    EdgeWidths widths(_clipFromScene, _pixels);
    for (const SeenPlace& seen : _places) {
        const auto map = std::find_if(forecast.each.begin(), forecast.each.end(),
                                      [&](const MapForecast::Map& each) { return holds(each, seen.place); });
        if (map != forecast.each.end()) widths.add(seen, map->mapFromScene);
    }
    return widths.empty() ? std::nullopt : std::optional<double>(widths.usual(usualShare));
}

} // namespace gnomon
