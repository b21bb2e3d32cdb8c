// SPDX-License-Identifier: MIT
#include <gnomon/CascadeSplits.h>
#include <gnomon/Convert.h>
#include <gnomon/LightMaps.h>
#include <gnomon/MapMark.h>

#include <OpenThreads/ScopedLock>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr double reserve = 1.0 / 16.0; // of a map's sides
constexpr double mostWaste = 2.0;      // area of a map to the smallest that would do: edges may be a half coarser
constexpr double border = 3.0;         // texels: what a comparison reaches over, and one against rounding
constexpr int largestTexture = 16384;  // texels on a side: what OpenGL has in most places
constexpr unsigned keptCalls = 256;    // maps that nobody asked for since are let go
constexpr double sameLight = 1e-7;     // of the distance: what OSG's matrices and floats make of a light at rest

bool isSame(const glm::dvec4& a, const glm::dvec4& b, double size) {
    return a.w == b.w && glm::distance(a, b) <= sameLight * (glm::length(glm::dvec3(b)) + size);
}

bool isSame(const std::optional<SpotCone>& a, const std::optional<SpotCone>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->cutoff == b->cutoff && glm::distance(a->axis, b->axis) <= sameLight;
}

glm::dmat4 eyeFromScene(const ViewFrame& view, const CasterMesh& mesh) {
    return glm::translate(toGlm(view.eyeFromGroup), toGlm(mesh.origin));
}

/// Of a sun one; of a lamp that sees all casters to one side one, else those of a cube, a little larger so that what is
/// on an edge is in both. Of a spot one about its cone, unless that is nearly flat.
///
/// A lamp is a sun where that moves no shadow by more than an eighth of a texel: else its depths would be rounded off.
std::vector<LightFrame> framesOf(const glm::dvec4& light, const std::optional<SpotCone>& cone, const glm::dvec3& reach,
                                 int texels) {
    const glm::dvec3 at(light);
    if (light.w == 0.0 || glm::length(at) > 8.0 * texels * glm::length(reach)) return {sunFrame(glm::normalize(at))};
    constexpr double onEdges = 1.05, flat = 4.0;
    if (cone && std::tan(cone->cutoff) < flat) return {lampFrame(at, cone->axis, onEdges * std::tan(cone->cutoff))};
    std::vector<LightFrame> frames;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 way(0.0);
            way[axis] = sign;
            frames.push_back(lampFrame(at, way, onEdges));
        }
    constexpr double wide = 2.0;
    const LightFrame ahead = lampFrame(at, glm::normalize(-at), wide);
    const auto corners = boxCorners(-reach, reach, glm::dmat4(1.0));
    const bool holdsAll = std::all_of(ahead.halfSpaces.begin(), ahead.halfSpaces.end(), [&](const glm::dvec4& half) {
        return std::all_of(corners.begin(), corners.end(), [&](const auto& p) { return glm::dot(half, p) > 0.0; });
    });
    return holdsAll ? std::vector{ahead} : frames;
}

} // namespace

/// One direction that a light looks in, and one part of what is seen.
struct LightMaps::Face {
    explicit Face(const LightFrame& given) : frame(given), casters(given), reach(given), needed(given), held(given) {}

    LightFrame frame;
    std::size_t part = 0;      ///< see viewPart().
    MapOutline casters;        ///< what they can darken, were all edges hard.
    MapOutline reach, needed;  ///< what they can darken; what of that is seen.
    MapOutline held;           ///< what a map must hold for that.
    std::optional<MapFit> fit; ///< of the map that is drawn.
};

struct LightMaps::LightMap {
    const void* stage = nullptr;
    int lightNumber = 0;
    glm::dvec4 light{0.0};
    std::optional<SpotCone> cone;
    MapWish wish;
    osg::ref_ptr<const MapCasters> casters;
    bool flats = false; ///< those that are flat cast, too.
    std::vector<Face> faces;
    int cascades = 0;           ///< maps that a sun is to have; 0 until that is known.
    std::vector<double> splits; ///< of what is seen: see cascadeSplits().
    osg::ref_ptr<DepthMap> map;
    osg::ref_ptr<const MapPicture> picture;
    std::vector<MapLookUp> lookUps;
    unsigned lastCall = 0;

    bool isOf(const glm::dvec4& given, const std::optional<SpotCone>& givenCone, const MapCasters& asked, bool flatToo,
              const MapWish& wanted) const {
        return casters == &asked && flats == flatToo && wish == wanted && isSame(givenCone, cone) &&
               isSame(given, light, glm::length(asked.reach));
    }
    void start(const glm::dvec4& given, const std::optional<SpotCone>& givenCone, const MapCasters& asked, bool flatToo,
               const MapWish& wanted);
    std::optional<ScreenRect> screenBounds(const glm::dmat4& clipFromScene) const;
    void addFace(const LightFrame& frame);
    double pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const;
    void findSplits(const std::vector<Receiver>& receivers, const glm::dmat4& clipFromScene, double width);
    bool findNeeded(const std::vector<Receiver>& receivers, const glm::dmat4& clipFromScene, double width);
    void findNeeded(Face& face, const std::vector<Receiver>& receivers, std::vector<glm::dvec4> halfSpaces) const;
    double lightRadius(const LightFrame& frame) const;
    double softness(const Face& face, double farthest) const;
    /// True if the face's map is not to be drawn again.
    bool holds(const Face& face) const;
    MapFit fitOf(const Face& face) const {
        return fitMap(face.frame, face.held, face.reach, reserve, border / wish.size,
                      glm::length(casters->reach) / 64.0);
    }
};

/// The box of something that is seen.
struct LightMaps::Receiver {
    glm::dvec3 low, high;
    glm::dmat4 sceneFromBox;
    double size; ///< of its diagonal, scene.
};

namespace {

template <class Receiver>
std::vector<Receiver> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene) {
    const glm::dmat4 sceneFromEye = glm::inverse(eyeFromScene);
    std::vector<Receiver> result;
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) continue;
        Receiver receiver{toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)),
                          sceneFromEye * toGlm(*leaf->_modelview), 0.0};
        receiver.size = glm::length(glm::dvec3(receiver.sceneFromBox * glm::dvec4(receiver.high - receiver.low, 0.0)));
        result.push_back(receiver);
    }
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.size > b.size; });
    return result;
}

/// True if what is flat, a ground for one, may stand between the light and any part of what is seen: not if all of that is
/// on the light's side of it, or in it.
template <class Receiver>
bool isBetween(const MapCasters::Box& flat, const glm::dvec4& light, const std::vector<Receiver>& receivers,
               const glm::dvec3& reach) {
    const glm::dvec3 size = flat.high - flat.low;
    const int axis = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : 2;
    const double level = flat.low[axis], in = 1e-6 * glm::length(reach); // what eye space makes of a place in it
    const double side = light[axis] - light.w * level > 0.0 ? 1.0 : -1.0;
    return std::any_of(receivers.begin(), receivers.end(), [&](const Receiver& receiver) {
        const auto corners = boxCorners(receiver.low, receiver.high, receiver.sceneFromBox);
        return std::any_of(corners.begin(), corners.end(),
                           [&](const glm::dvec4& corner) { return !(side * (corner[axis] - level) >= -in); });
    });
}

template <class Mark>
osg::ref_ptr<MarkJob> markOf(const MapQuad& quad, const ScreenRect& bounds, MapView view) {
    osg::ref_ptr<Mark> mark = new Mark;
    mark->quad = quad;
    mark->screenBounds = bounds;
    mark->view = view;
    return mark;
}

} // namespace

LightMaps::LightMaps() : _resources(new MapResources) {}
LightMaps::~LightMaps() = default;

osg::ref_ptr<ConeMark> LightMaps::around(const ViewFrame& view, const glm::dvec4& light, const SpotCone& cone,
                                         const CasterMesh& mesh) const {
    osg::ref_ptr<ConeMark> mark = new ConeMark;
    mark->resources = _resources;
    mark->clipFromScene = toGlm(view.projection) * eyeFromScene(view, mesh);
    mark->coneFromScene = coneFromScene(glm::dvec3(light), cone);
    return mark;
}

osg::ref_ptr<MarkJob> LightMaps::mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                                      const std::optional<SpotCone>& cone, const CasterMesh& mesh,
                                      const MapWish& wish) {
    const glm::dmat4 clipFromScene = toGlm(view.projection) * eyeFromScene(view, mesh);
    Lock lock(_mutex);
    LightMap& map = find(view.stage, lightNumber);
    const osg::ref_ptr<const MapCasters> casters = castersOf(mesh);
    const std::vector<Receiver> receivers = receiversOf<Receiver>(view, eyeFromScene(view, mesh));
    const bool flats = std::any_of(casters->flatBoxes.begin(), casters->flatBoxes.end(),
                                   [&](const auto& flat) { return isBetween(flat, light, receivers, casters->reach); });
    if (!map.isOf(light, cone, *casters, flats, wish)) map.start(light, cone, *casters, flats, wish);
    if (!map.findNeeded(receivers, clipFromScene, view.pixels.x())) return nullptr;
    const auto bounds = map.screenBounds(clipFromScene);
    if (!bounds) return nullptr;
    if (needsNew(map)) redo(map);
    MapQuad quad = quadOf(map, clipFromScene);
    quad.resources = _resources;
    if (cone) quad.coneFromScene = coneFromScene(glm::dvec3(light), *cone);
    return wish.soft ? markOf<SoftMapMark>(quad, *bounds, wish.view) : markOf<MapMark>(quad, *bounds, wish.view);
}

MapQuad LightMaps::quadOf(const LightMap& map, const glm::dmat4& clipFromScene) {
    MapQuad quad;
    quad.map = map.map;
    quad.picture = map.picture;
    quad.lookUps = map.lookUps;
    quad.clipFromScene = clipFromScene;
    quad.defines = map.wish.defines;
    const LightFrame& frame = map.faces.front().frame;
    if (frame.sun && map.lookUps.size() > 1) quad.defines += "#define CASCADES\n";
    quad.soft = map.wish.soft.has_value();
    quad.penumbra = map.lightRadius(frame) > 0.0;
    return quad;
}

void LightMaps::LightMap::start(const glm::dvec4& given, const std::optional<SpotCone>& givenCone,
                                const MapCasters& asked, bool flatToo, const MapWish& wanted) {
    if (!(wish == wanted)) map = nullptr;
    light = given;
    cone = givenCone;
    casters = &asked;
    flats = flatToo;
    wish = wanted;
    picture = nullptr;
    faces.clear();
    splits.clear();
    cascades = wish.cascades;
    for (const LightFrame& frame : framesOf(light, cone, casters->reach, wish.size)) addFace(frame);
}

void LightMaps::LightMap::addFace(const LightFrame& frame) {
    Face face(frame);
    for (const MapCasters::Box& box : casters->bodyBoxes) face.casters.addBox(box.low, box.high, glm::dmat4(1.0));
    if (flats)
        for (const MapCasters::Box& box : casters->flatBoxes) face.casters.addBox(box.low, box.high, glm::dmat4(1.0));
    const int most = 2 * wish.size <= largestTexture ? mostCascades : 1;
    const std::size_t parts = frame.sun ? std::size_t(wish.cascades ? wish.cascades : most) : 1;
    for (; face.part < parts; ++face.part) faces.push_back(face);
}

/// Of what is needed.
std::optional<ScreenRect> LightMaps::LightMap::screenBounds(const glm::dmat4& clipFromScene) const {
    std::vector<glm::dvec4> points;
    for (const Face& face : faces)
        for (const glm::dvec4& point : face.needed.body()) points.push_back(clipFromScene * point);
    return gnomon::screenBounds(points);
}

/// On a side of a texel, were there one map, at a distance along the line of sight, of a view that is `width` pixels wide.
double LightMaps::LightMap::pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const {
    const auto side = [&](int axis) { return 2.0 * distance / glm::length(glm::dvec3(glm::row(clipFromScene, axis))); };
    const Face& face = faces.front();
    const glm::dvec2 most = fitMap(face.frame, face.casters, face.casters, 0.0, 0.0, 1.0).size;
    const double covered = std::min(std::max(most.x, most.y), std::max(side(0), side(1)));
    return covered / wish.size / (side(0) / width);
}

void LightMaps::LightMap::findSplits(const std::vector<Receiver>& receivers, const glm::dmat4& clipFromScene,
                                     double width) {
    if (!(faces.size() > 1 && faces.front().frame.sun) || faces.front().casters.empty()) return;
    std::vector<glm::dvec4> halfSpaces = viewPart(clipFromScene, {}, 0);
    for (const glm::dvec4& side : faces.front().casters.sides()) halfSpaces.push_back(side);
    SeenRange seen(clipFromScene);
    for (const Receiver& receiver : receivers)
        seen.addBox(receiver.low, receiver.high, receiver.sceneFromBox, halfSpaces);
    if (!wish.cascades && !seen.empty())
        cascades = cascadesFor(seen, pixelsATexel(seen.farthest, clipFromScene, width), cascades);
    splits = cascadeSplits(seen, std::max(cascades, 1));
}

/// @return false if nothing is needed.
bool LightMaps::LightMap::findNeeded(const std::vector<Receiver>& receivers, const glm::dmat4& clipFromScene,
                                     double width) {
    findSplits(receivers, clipFromScene, width);
    bool any = false;
    for (Face& face : faces) {
        face.needed = face.held = MapOutline(face.frame);
        if (face.casters.empty() || face.part > splits.size()) continue;
        findNeeded(face, receivers, viewPart(clipFromScene, splits, face.part));
        any = any || !face.needed.empty();
    }
    return any;
}

void LightMaps::LightMap::findNeeded(Face& face, const std::vector<Receiver>& receivers,
                                     std::vector<glm::dvec4> halfSpaces) const {
    const auto add = [&](MapOutline& to) {
        for (const Receiver& receiver : receivers)
            to.addBox(receiver.low, receiver.high, receiver.sceneFromBox, halfSpaces);
    };
    face.reach = face.casters;
    if (wish.soft) {
        MapOutline seen(face.frame);
        add(seen);
        if (seen.empty()) return;
        face.reach.grow(softness(face, seen.farthest));
    }
    if (face.frame.sun) // a lamp's have sides of their own
        for (const glm::dvec4& side : face.reach.sides()) halfSpaces.push_back(side);
    add(face.needed);
    face.needed.cut(face.reach);
    face.needed.limitNearest();
    face.held = face.needed;
    if (!wish.soft || face.needed.empty()) return;
    face.held.grow(softness(face, face.needed.farthest));
    face.held.cut(face.reach);
    face.held.nearest = std::min(face.held.nearest, face.casters.nearest); // distances from there count
    face.held.limitNearest();
}

/// See softReach().
double LightMaps::LightMap::lightRadius(const LightFrame& frame) const {
    if (!wish.soft) return 0.0;
    if (!frame.sun) return wish.soft->lamp;
    return light.w == 0.0 ? wish.soft->sun : wish.soft->lamp / glm::length(glm::dvec3(light));
}

/// How far edges of the casters are spread where it is as far as that from the light.
double LightMaps::LightMap::softness(const Face& face, double farthest) const {
    MapOutline standing = face.casters;
    standing.limitNearest();
    return softReach(face.frame, standing.nearest, farthest, lightRadius(face.frame), wish.soft->radius);
}

bool LightMaps::LightMap::holds(const Face& face) const {
    if (!face.fit || !face.fit->covers(face.held, (border - 1.0) / wish.size)) return false;
    return face.fit->area() <= mostWaste * fitOf(face).area();
}

bool LightMaps::needsNew(const LightMap& map) const {
    if (!map.picture) return true;
    return std::any_of(map.faces.begin(), map.faces.end(),
                       [&](const Face& face) { return !face.needed.empty() && !map.holds(face); });
}

/// Without its tiles.
osg::ref_ptr<MapPicture> LightMaps::pictureOf(const LightMap& map) const {
    osg::ref_ptr<MapPicture> picture = new MapPicture;
    picture->casters = map.flats ? map.casters->all : map.casters->bodies;
    for (const MapCasters::Cutout& cutout : map.casters->cutouts)
        if (map.flats || !cutout.flat) picture->cutouts.push_back(cutout);
    picture->program = _resources->casterProgram;
    picture->cutoutProgram = _resources->cutoutProgram;
    picture->size = map.wish.size;
    picture->slopeOffset = 0.5; // with as much of the slope that is seen: see map.frag
    return picture;
}

/// Fits anew what does not hold; the finest map comes first, for pixels take the first that holds them.
void LightMaps::redo(LightMap& map) const {
    const osg::ref_ptr<MapPicture> picture = pictureOf(map);
    const int columns = map.faces.size() > 4 ? 3 : 2;
    std::vector<std::pair<const Face*, glm::ivec2>> tiles;
    for (Face& face : map.faces) {
        if (face.needed.empty())
            face.fit = std::nullopt;
        else if (!map.holds(face))
            face.fit = map.fitOf(face);
        const int tile = static_cast<int>(tiles.size());
        if (face.fit) tiles.emplace_back(&face, picture->size * glm::ivec2(tile % columns, tile / columns));
    }
    std::stable_sort(tiles.begin(), tiles.end(),
                     [](const auto& a, const auto& b) { return a.first->fit->area() < b.first->fit->area(); });
    map.lookUps.clear();
    glm::ivec2 end(0);
    const glm::dmat4 clipFromMap = glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)), glm::dvec3(2.0));
    for (const auto& [face, corner] : tiles) {
        picture->tiles.push_back({corner, clipFromMap * face->fit->mapFromScene});
        const double radius = map.wish.soft ? map.wish.soft->radius : 0.0;
        map.lookUps.push_back(
            {face->fit->mapFromScene, mapErrors(face->frame, *face->fit, map.casters->reach, picture->size),
             mapSpread(face->frame, *face->fit, map.lightRadius(face->frame), radius, picture->size)});
        end = glm::max(end, corner + picture->size);
    }
    if (!map.map || map.map->size != end) map.map = new DepthMap(end, map.wish.compare);
    map.picture = picture;
}

LightMaps::LightMap& LightMaps::find(const void* stage, int lightNumber) {
    ++_calls;
    const auto old = [this](const auto& map) { return _calls - map->lastCall > keptCalls; };
    _maps.erase(std::remove_if(_maps.begin(), _maps.end(), old), _maps.end());
    const auto found = std::find_if(_maps.begin(), _maps.end(), [&](const auto& map) {
        return map->stage == stage && map->lightNumber == lightNumber;
    });
    if (found == _maps.end()) {
        _maps.push_back(std::make_unique<LightMap>());
        _maps.back()->stage = stage;
        _maps.back()->lightNumber = lightNumber;
    } else {
        std::rotate(found, found + 1, _maps.end());
    }
    _maps.back()->lastCall = _calls;
    return *_maps.back();
}

osg::ref_ptr<const MapCasters> LightMaps::castersOf(const CasterMesh& mesh) {
    if (!_casters || _casters->mesh != &mesh) _casters = new MapCasters(mesh);
    return _casters;
}

void LightMaps::resizeGLObjectBuffers(unsigned maxSize) {
    _resources->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    for (const auto& map : _maps) {
        if (map->map) map->map->resizeGLObjectBuffers(maxSize);
        if (map->casters) map->casters->resizeGLObjectBuffers(maxSize);
    }
}

void LightMaps::release(osg::State* state) {
    _resources->release(state);
    Lock lock(_mutex);
    for (const auto& map : _maps) {
        if (map->map) map->map->release(state);
        if (map->casters) map->casters->releaseGLObjects(state);
    }
}

} // namespace gnomon
