// SPDX-License-Identifier: MIT
// How the maps that LightShadowMaps finds are drawn, and how pixels look them up.
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/LightShadowMaps.h>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <utility>

namespace gnomon {
namespace {

/// All faces, as in a light's first picture: where only those turned to it are drawn, single texels at rims differ.
constexpr CullableFaces::Outside wholly{false, false};

bool isWhole(const MapPicture::Layer& layer) {
    return std::all_of(layer.meshes.begin(), layer.meshes.end(), [](const MapPicture::Layer::Mesh& mesh) {
        return (!mesh.faces->solids || !mesh.outside.solids) && (!mesh.faces->holed || !mesh.outside.holed);
    });
}

} // namespace

/// Without its tiles. @param due  some are to be drawn from the first.
osg::ref_ptr<MapPicture> LightShadowMaps::pictureOf(const MapPrograms& resources, bool due, MapBodies& bodies,
                                                    const OwnView& view) {
    osg::ref_ptr<MapPicture> picture = new MapPicture;
    const bool stillAgain = _drawnStill == _cause.casters->still, movingAgain = _drawnMoving == _cause.casters->moving;
    bodies.startPicture();
    if (!stillAgain || due) _still = drawnOf(*_cause.casters->still, stillAgain, bodies);
    picture->still = _still;
    picture->moving = drawnOf(*_cause.casters->moving, movingAgain, bodies);
    picture->own = {_cause.casters->own, view};
    _drawnStill = _cause.casters->still;
    _drawnMoving = _cause.casters->moving;
    picture->program = _frames.front().sun ? resources.casterProgram : resources.casterByLampProgram;
    picture->cutoutProgram = resources.cutoutProgram;
    picture->size = _texels;
    picture->slopeOffset = 0.5; // with as much of the slope that is seen: see map.frag
    return picture;
}

MapPicture::Layer LightShadowMaps::drawnOf(const MapLayer& layer, bool again, MapBodies& bodies) const {
    MapPicture::Layer drawn;
    for (const MapLayer::Drawn& mesh : layer.faces(_cause.flats, again, &layer == _cause.casters->moving, bodies)) {
        const glm::dvec4 light = glm::inverse(mesh.sceneFromMesh) * _cause.light;
        drawn.meshes.push_back({mesh, _settled ? wholly : mesh.faces->outside(light)});
    }
    for (const MapLayer::Cutout& cutout : layer.cutouts)
        if (_cause.flats || !cutout.flat) drawn.cutouts.push_back(cutout);
    return drawn;
}

/// Texels of a tile that what moves may cover.
PixelRect LightShadowMaps::moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const {
    const MapLayer& moving = *_cause.casters->moving;
    glm::dvec2 low(1.0), high(-1.0);
    const auto add = [&](const MapLayer::Box& box) {
        const auto corners = boxCorners(box.low, box.high, tile.clipFromScene);
        const auto bounds = screenBounds({corners.begin(), corners.end()});
        if (!bounds) return;
        low = glm::min(low, bounds->low);
        high = glm::max(high, bounds->high);
    };
    std::for_each(moving.bodyBoxes.begin(), moving.bodyBoxes.end(), add);
    if (_cause.flats) std::for_each(moving.flatBoxes.begin(), moving.flatBoxes.end(), add);
    for (const OwnCaster& caster : _cause.casters->own) add(caster.box);
    if (!(low.x <= high.x && low.y <= high.y)) return {};
    const double more = 1.0 + std::max(errors.nearest.texels, errors.farthest.texels), size = _texels;
    const auto texel = [size](const glm::dvec2& place) { return glm::ivec2(glm::clamp(place, 0.0, size)); };
    const glm::ivec2 first = texel(glm::floor((low + 1.0) / 2.0 * size - more)),
                     end = texel(glm::ceil((high + 1.0) / 2.0 * size + more));
    return {tile.corner.x + first.x, tile.corner.y + first.y, end.x - first.x, end.y - first.y};
}

MapLookUp LightShadowMaps::lookUpOf(const MapSlice& face) const {
    const double radius = _cause.settings.softness ? _cause.settings.softness->radius : 0.0;
    return {face.fit->mapFromScene, mapErrors(face.frame, *face.fit, reachOf(face), _texels),
            mapSpread(face.frame, *face.fit, _cause.lightRadius(face.frame), radius, _texels)};
}

/// True if the last picture is of the same maps, and drawn in the same way if that is settled.
bool LightShadowMaps::isShown() const {
    const auto tiles = std::count_if(_faces.begin(), _faces.end(), [](const MapSlice& face) { return bool(face.fit); });
    const auto shows = [this](const MapSlice& face) {
        const auto same = [&face](const MapLookUp& lookUp) { return lookUp.mapFromScene == face.fit->mapFromScene; };
        return !face.fit || std::any_of(_lookUps.begin(), _lookUps.end(), same);
    };
    if (_settled && !(isWhole(_picture->still) && isWhole(_picture->moving))) return false;
    return _picture->size == _texels && std::size_t(tiles) == _lookUps.size() &&
           std::all_of(_faces.begin(), _faces.end(), shows);
}

/// The finest map comes first, for pixels take the first that holds them.
void LightShadowMaps::update(const MapPrograms& resources, MapBodies& bodies, const OwnView& view) {
    if (_picture && !_picture->own.areSame({_cause.casters->own, view})) _picture = nullptr;
    resize();
    const bool due = anyDue();
    if (_picture && !due) return;
    for (MapSlice& face : _faces) {
        if (face.needed.empty())
            face.fit = std::nullopt;
        else if (!holds(face))
            face.fit = fitOf(face);
    }
    if (_picture && isShown()) return;
    const osg::ref_ptr<MapPicture> picture = pictureOf(resources, due, bodies, view);
    std::vector<std::pair<const MapSlice*, glm::ivec2>> tiles;
    for (const MapSlice& face : _faces) {
        const int tile = static_cast<int>(tiles.size());
        if (face.fit) tiles.emplace_back(&face, picture->size * glm::ivec2(tile % columns(), tile / columns()));
    }
    std::stable_sort(tiles.begin(), tiles.end(),
                     [](const auto& a, const auto& b) { return a.first->fit->area() < b.first->fit->area(); });
    _lookUps.clear();
    glm::ivec2 end(0);
    const glm::dmat4 clipFromMap = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)), glm::dvec3(2.0));
    for (const auto& [face, corner] : tiles) {
        _lookUps.push_back(lookUpOf(*face));
        picture->tiles.push_back({corner, clipFromMap * face->fit->mapFromScene, nearestDrawn(*face), {}});
        picture->tiles.back().movers = moversIn(picture->tiles.back(), _lookUps.back().errors);
        end = glm::max(end, corner + picture->size);
    }
    if (!_map || _map->size != end) _map = new DepthMap(end, _cause.settings.compare);
    _picture = picture;
}

void LightShadowMaps::letGo() {
    if (_drawnStill == _cause.casters->still && _drawnMoving == _cause.casters->moving) return;
    _map = nullptr;
    _picture = nullptr;
    _drawnStill = _drawnMoving = nullptr;
    _still = {};
}

/// True if several maps may hold a place of their light's frame, but not its depth.
bool LightShadowMaps::isDivided() const {
    const auto further = [](const MapSlice& face) { return face.part > 0 && face.fit; };
    return _lookUps.size() > 1 && std::any_of(_faces.begin(), _faces.end(), further);
}

MapLookupPass LightShadowMaps::quad(const glm::dmat4& clipFromScene) const {
    MapLookupPass quad;
    quad.map = _map;
    quad.picture = _picture;
    quad.lookUps = _lookUps;
    quad.rounding = _cause.casters->layers->rounding;
    quad.clipFromScene = clipFromScene;
    quad.defines = _cause.settings.defines;
    quad.cascades = isDivided();
    quad.smooth = _cause.settings.smooth;
    quad.soft = _cause.settings.softness.has_value();
    quad.penumbra = _cause.lightRadius(_faces.front().frame) > 0.0;
    return quad;
}

} // namespace gnomon
