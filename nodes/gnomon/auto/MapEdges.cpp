// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/auto/MapEdges.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/map/MapSlice.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace gnomon {
namespace {

// Triangles that are looked at: more would take tens of milliseconds. Where drawables are as simple as boxes, these are as good,
// and sooner.
constexpr std::size_t mostTriangles = 150000, ofABox = 20;

bool holds(const MapForecast::Map& map, const glm::dvec3& place) {
    const glm::dvec4 here(place, 1.0), in = map.mapFromScene * here;
    return in.w > 0.0 && in.x >= 0.0 && in.y >= 0.0 && in.x <= in.w && in.y <= in.w &&
           std::all_of(map.halfSpaces.begin(), map.halfSpaces.end(),
                       [&](const glm::dvec4& half) { return glm::dot(half, here) >= 0.0; });
}

bool areLookedAt(const CasterLayers& casters) {
    return casters.triangles() <= mostTriangles && casters.triangles() > ofABox * casters.pieces->list.size();
}

std::vector<PlacedTriangles> trianglesOf(const CasterLayers& casters) {
    std::vector<PlacedTriangles> result;
    for (const PlacedMesh& placed : casters.meshes()) {
        const CasterMesh& mesh = *placed.mesh;
        if (mesh.empty()) continue;
        PlacedTriangles triangles{positionsOf(mesh),          mesh.vertices->size(), &mesh.triangles->front(),
                                  mesh.triangles->size() / 3, placed.sceneFromMesh,  {}};
        for (const CasterExtraction::Drawn& drawn : mesh.drawn) triangles.parts.push_back(drawn.first / 3);
        if (triangles.parts.empty() || triangles.parts.front() > 0) triangles.parts.insert(triangles.parts.begin(), 0);
        result.push_back(triangles);
    }
    return result;
}

/// The view without some casters: their triangles are looked at.
ViewFrame without(const CasterDrawables& casters, const AutoView& view) {
    std::unordered_set<const osg::Drawable*> casting;
    for (const auto& piece : casters.list) casting.insert(piece->drawable.get());
    ViewFrame result = view.frame;
    const auto casts = [&](const osgUtil::RenderLeaf* leaf) { return casting.count(leaf->_drawable.get()) > 0; };
    result.seen.erase(std::remove_if(result.seen.begin(), result.seen.end(), casts), result.seen.end());
    return result;
}

} // namespace

MapEdges::MapEdges(const AutoView& view, const MapCasters& boxes, const MapForecast& forecast)
    : _pixels(view.frame.pixels.x(), view.frame.pixels.y()) {
    const SceneFrame scene(boxes.layers->origin);
    _clipFromScene = scene.clipFromScene(view.frame);
    const glm::dvec4 light = view.towards - view.towards.w * glm::dvec4(scene.origin, 0.0);
    const bool byTriangles = !view.frame.receivers && areLookedAt(*boxes.layers);
    const std::vector<MapReceiver> receivers =
        receiversOf(byTriangles ? without(*boxes.layers->pieces, view) : view.frame, scene.eyeFromScene(view.frame));
    const auto seenOf = [&](SeenEdges::Relief relief) {
        SeenEdges seen(_clipFromScene, _pixels, *forecast.bounds, light);
        for (const MapReceiver& receiver : receivers)
            seen.addReceiver({receiver.low, receiver.high, receiver.sceneFromBox}, relief);
        for (const MapForecast::Map& map : forecast.each) seen.addMap(map.mapFromScene);
        return seen;
    };
    SeenEdges seen = seenOf(SeenEdges::Relief::HalfWay);
    if (byTriangles)
        for (const PlacedTriangles& mesh : trianglesOf(*boxes.layers)) seen.addMesh(mesh);
    else
        for (const MapLayer* layer : {boxes.still.get(), boxes.moving.get()})
            for (const auto* some : {&layer->bodyBoxes, &layer->flatBoxes})
                for (const MapLayer::Box& box : *some) seen.addCaster({box.low, box.high});
    _places = seen.edges();
    if (!_places.empty()) return;
    if (!byTriangles) seen = seenOf(SeenEdges::Relief::Whole); // a terrain shadows itself, who knows where
    _places = seen.facing();
}

EdgeWidths MapEdges::in(const MapForecast& forecast) const {
    EdgeWidths widths(_clipFromScene, _pixels);
    for (const SeenPlace& seen : _places) {
        const auto map = std::find_if(forecast.each.begin(), forecast.each.end(),
                                      [&](const MapForecast::Map& each) { return holds(each, seen.place); });
        if (map != forecast.each.end()) widths.add(seen, map->mapFromScene);
    }
    return widths;
}

} // namespace gnomon
