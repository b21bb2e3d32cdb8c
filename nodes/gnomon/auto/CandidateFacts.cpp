// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/CandidateFacts.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/group/LitCauses.h>
#include <gnomon/group/SceneFrame.h>

#include <glm/geometric.hpp>
#include <osg/Material>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace gnomon {
namespace {

constexpr double steepShare = 0.8;      // of the light's slope: ground as steep as that shadows itself soon
constexpr std::size_t mostSamples = 64; // casters that are asked for the ground below their shadows

/// How far the ground lies off the straight line between both ends of a shadow, half-way.
std::optional<double> bend(const Ground& ground, const osg::BoundingBoxd& caster, const glm::dvec2& away) {
    const osg::Vec3d centre = caster.center();
    const glm::dvec2 from(centre.x(), centre.y()), to = from + (caster.zMax() - caster.zMin()) * away;
    const glm::dvec2 middle = (from + to) / 2.0;
    const auto a = ground.height(from.x, from.y), b = ground.height(middle.x, middle.y), c = ground.height(to.x, to.y);
    if (!a || !b || !c) return std::nullopt;
    return std::abs(*b - (*a + *c) / 2.0);
}

// Triangles that are looked at: more would take tens of milliseconds. Where drawables are as simple as boxes, these are as good,
// and sooner.
constexpr std::size_t mostTriangles = 150000, ofABox = 20;

bool holds(const MapForecast::Map& map, const glm::dvec3& place) {
    const glm::dvec4 here(place, 1.0), in = map.mapFromScene * here;
    return in.w > 0.0 && in.x >= 0.0 && in.y >= 0.0 && in.x <= in.w && in.y <= in.w &&
           std::all_of(map.halfSpaces.begin(), map.halfSpaces.end(),
                       [&](const glm::dvec4& half) { return glm::dot(half, here) >= 0.0; });
}

bool areLookedAt(const Casters& casters) {
    const std::size_t triangles = casters.layers().triangles();
    return triangles <= mostTriangles && triangles > ofABox * casters.list.size();
}

std::vector<PlacedTriangles> trianglesOf(const CasterLayers& casters) {
    std::vector<PlacedTriangles> result;
    for (const PlacedMesh& placed : casters.meshes()) {
        const CasterMesh& mesh = *placed.mesh;
        if (mesh.empty()) continue;
        PlacedTriangles triangles{positionsOf(mesh),          mesh.vertices->size(), &mesh.triangles->front(),
                                  mesh.triangles->size() / 3, placed.sceneFromMesh,  {}};
        for (const CasterExtraction::Drawn& drawn : mesh.drawn) {
            triangles.parts.push_back(drawn.first / 3);
            triangles.oneSided.push_back((placed.isBody ? placed.hiding : drawn.hiding) == Hiding::Fronts);
        }
        if (triangles.parts.empty() || triangles.parts.front() > 0) {
            triangles.parts.insert(triangles.parts.begin(), 0);
            triangles.oneSided.insert(triangles.oneSided.begin(), placed.hiding == Hiding::Fronts);
        }
        result.push_back(triangles);
    }
    return result;
}

/// The view without some casters: their triangles are looked at.
ViewFrame without(const Casters& casters, const ShadowInView& shadow) {
    std::unordered_set<const osg::Drawable*> casting;
    for (const auto& piece : casters.list) casting.insert(piece->drawable.get());
    ViewFrame result = shadow.view;
    const auto casts = [&](const osgUtil::RenderLeaf* leaf) { return casting.count(leaf->_drawable.get()) > 0; };
    result.seen.erase(std::remove_if(result.seen.begin(), result.seen.end(), casts), result.seen.end());
    result.seenValue = 0;
    return result;
}

bool isMoreThanWhite(const osg::Material& material) {
    for (const osg::Material::Face face : {osg::Material::FRONT, osg::Material::BACK})
        for (const osg::Vec4& color : {material.getDiffuse(face), material.getSpecular(face)})
            if (std::max({color.r(), color.g(), color.b()}) > 1.0f) return true;
    return false;
}

/// True if what is drawn so shows no more of a light than the light gives: by OpenGL's own lighting.
bool isShadedByOpenGl(const osgUtil::StateGraph* graph) {
    if (!isOn(graph, GL_LIGHTING) || resolvedAttribute(graph, osg::StateAttribute::PROGRAM)) return false;
    const auto* material = resolved<osg::Material>(graph, osg::StateAttribute::MATERIAL);
    return !material || !isMoreThanWhite(*material);
}

} // namespace

/// Shadows of lights that are fainter may fall on the same place, and are left out, too.
bool isFaint(const ShadowInView& shadow) {
    const auto found = shadow.view.strengths.find(shadow.light.number);
    if (shadow.view.group->getComposite() != ShadowCasterGroup::RELIGHT || found == shadow.view.strengths.end())
        return false;
    const auto ofLight = std::make_pair(found->second, found->first);
    double together = 0.0;
    for (const auto& [number, strength] : shadow.view.strengths)
        if (std::make_pair(strength, number) <= ofLight) together += strength;
    if (!(together < leastContrast)) return false;
    return std::all_of(shadow.view.seen.begin(), shadow.view.seen.end(),
                       [](const osgUtil::RenderLeaf* leaf) { return isShadedByOpenGl(leaf->_parent); });
}

std::string whyCoarse(const ShadowInView& shadow) {
    const std::vector<const osgUtil::RenderLeaf*> none;
    const CastersInView seen{shadow.casters, none, shadow.view.eyeFromGroup};
    const DepthPixels pixels{shadow.view.pixels, 1.0};
    if (reachesCoarseDepth(seen, shadow.view.projection, pixels))
        if (const std::string name = coarselyPlaced(seen, shadow.view.projection, pixels); !name.empty())
            return "depths are too coarse at '" + name + "'";
    const std::string name = drawnOffItsPlace(shadow.view.seen, shadow.view.projection, pixels.size);
    return name.empty() ? "" : "the vertices of '" + name + "' lie far from their origin, an offset for a transform";
}

std::string whyCutOut(const Casters& casters) { return casters.cutouts > 0 ? "casters have clear parts" : ""; }

std::string whyDrawnCutOut(const Casters& casters) {
    return casters.drawnCutouts > 0 ? "casters have clear parts that only drawing them tells" : "";
}

TerrainFacts TerrainKnowledge::of(const ShadowInView& shadow, const Selection& receiver) {
    if (!hasPart(OptionalPart::Terrain)) return {"this build has no Qhull"};
    if (const std::string cutOut = whyCutOut(shadow.casters); !cutOut.empty()) return {cutOut};
    if (receiver == Selection()) return {"no terrain is named as receiver"};
    const glm::dvec3 sun(shadow.towards);
    const double across = glm::length(glm::dvec2(sun));
    if (!(shadow.towards.w == 0.0 && sun.z > 0.0)) return {"the light is no sun above the horizon"};
    _drawn = groundRevision(*shadow.view.group, receiver, _drawn);
    if (!(_drawn->steepest * across < steepShare * sun.z)) return {"the terrain is so steep that it may shadow itself"};
    std::vector<double> bends;
    const std::size_t step = shadow.casters.list.size() / mostSamples + 1;
    for (std::size_t i = 0; i < shadow.casters.list.size(); i += step) {
        const Caster& piece = *shadow.casters.list[i];
        if (!piece.bounds.valid() || _drawn->drawables.count(piece.drawable.get())) continue;
        if (const auto found = bend(*_drawn->ground, piece.bounds, -glm::dvec2(sun) / sun.z)) bends.push_back(*found);
    }
    std::sort(bends.begin(), bends.end());
    const double rise = bends.empty() ? 0.0 : bends[std::size_t(0.95 * double(bends.size() - 1))];
    return {"", rise / std::max(sun.z / std::max(across, 1e-12) - _drawn->steepest, 1e-3)};
}

MapEdges::MapEdges(const ShadowInView& shadow, const MapCasters& boxes, const MapForecast& forecast)
    : _pixels(shadow.view.pixels.x(), shadow.view.pixels.y()) {
    const SceneFrame scene(boxes.layers.origin);
    _clipFromScene = scene.clipFromScene(shadow.view);
    const glm::dvec4 light = shadow.towards - shadow.towards.w * glm::dvec4(scene.origin, 0.0);
    const bool byTriangles = !shadow.view.receivers && areLookedAt(*boxes.of);
    const std::vector<PlacedBox> receivers =
        receiversOf(byTriangles ? without(*boxes.of, shadow) : shadow.view, scene.eyeFromScene(shadow.view));
    const auto seenOf = [&](SeenEdges::Relief relief) {
        SeenEdges seen(_clipFromScene, _pixels, *forecast.bounds, light);
        for (const PlacedBox& receiver : receivers) seen.addReceiver(receiver, relief);
        for (const MapForecast::Map& map : forecast.each) seen.addMap(map.mapFromScene);
        return seen;
    };
    SeenEdges seen = seenOf(SeenEdges::Relief::HalfWay);
    if (byTriangles)
        for (const PlacedTriangles& mesh : trianglesOf(boxes.layers)) seen.addMesh(mesh);
    else
        for (const MapLayer* layer : {boxes.still.get(), boxes.moving.get()})
            for (const auto* some : {&layer->unflats, &layer->flats})
                for (const MapPiece& box : *some) seen.addCaster({box.low, box.high});
    const glm::dvec2 size = 0.5 * (forecast.bounds->high - forecast.bounds->low) * _pixels;
    _cell = size.x * size.y / (SeenEdges::columns * SeenEdges::rows);
    _places = seen.edges(&_contacts);
    if (!_places.empty()) return;
    if (!byTriangles) seen = seenOf(SeenEdges::Relief::Whole); // a terrain shadows itself, who knows where
    _places = seen.facing();
}

EdgeWidths MapEdges::in(const MapForecast& forecast) const {
    EdgeWidths widths(_clipFromScene, _pixels);
    const auto inMapOf = [&](const glm::dvec3& place, const auto& add) {
        const auto map = std::find_if(forecast.each.begin(), forecast.each.end(),
                                      [&](const MapForecast::Map& each) { return holds(each, place); });
        if (map != forecast.each.end()) add(map->mapFromScene);
    };
    for (const SeenPlace& seen : _places) inMapOf(seen.place, [&](const glm::dmat4& map) { widths.add(seen, map); });
    for (const Contact& contact : _contacts)
        inMapOf(contact.place, [&](const glm::dmat4& map) { widths.addContact(contact, _cell, map); });
    return widths;
}

} // namespace gnomon
