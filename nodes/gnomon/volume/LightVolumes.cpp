// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/group/StageLeaves.h>
#include <gnomon/volume/LightVolumes.h>

#include <OpenThreads/ScopedLock>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

void expand(ReceiverBox& all, const osg::BoundingBox& box, const osg::Matrixd& sceneFromBox) {
    const osg::Vec3d middle = osg::Vec3d(box.center()) * sceneFromBox,
                     half = (osg::Vec3d(box._max) - osg::Vec3d(box._min)) / 2.0;
    glm::dvec3 reach(0.0);
    for (int row = 0; row < 3; ++row)
        reach += half[row] * glm::dvec3(std::abs(sceneFromBox(row, 0)), std::abs(sceneFromBox(row, 1)),
                                        std::abs(sceneFromBox(row, 2)));
    all.low = glm::min(all.low, toGlm(middle) - reach);
    all.high = glm::max(all.high, toGlm(middle) + reach);
}

/// A bit each; none of what hides all.
std::uint8_t kindOf(Hiding hiding) { return static_cast<std::uint8_t>(hiding); }

/// Those of the scene, in the mesh's frame.
std::vector<glm::dvec4> endsIn(const VolumeCaster& caster, const ReceiverBox& receivers) {
    std::vector<glm::dvec4> planes;
    for (const glm::dvec4& plane : endPlanes(receivers.low, receivers.high))
        if (const auto there = normalizedPlane(glm::transpose(caster.sceneFromMesh) * plane)) planes.push_back(*there);
    return planes;
}

/// A light in the frame of a mesh.
glm::dvec4 lightIn(const VolumeCaster& caster, const glm::dvec4& lightInScene) {
    const glm::dvec4 light = glm::inverse(caster.sceneFromMesh) * lightInScene;
    return light.w == 0.0 ? glm::dvec4(glm::normalize(glm::dvec3(light)), 0.0) : light;
}

/// Where the volume of a part is across the light, in a plane of two coordinates of the scene; a lamp's are those of a globe.
PrismLayers prismsOf(const LightVolumes& of, unsigned index) {
    const SilhouetteMesh::Part& part = of.caster().mesh->parts[index];
    const glm::dvec4& light = of.light();
    const glm::dmat4& sceneFromMesh = of.caster().sceneFromMesh;
    const glm::dvec3 low(part.low), high(part.high), half = (high - low) / 2.0,
                                                     middle(sceneFromMesh * glm::dvec4((low + high) / 2.0, 1.0));
    glm::dvec3 reach(0.0); // of a box in the scene that holds that of the part
    for (int axis = 0; axis < 3; ++axis) reach += half[axis] * glm::abs(glm::dvec3(sceneFromMesh[axis]));
    PrismLayers prisms{glm::dvec2(-4.0), glm::dvec2(4.0), 1, of.volumes().parts[index].mostOver};
    if (light.w == 0.0) {
        const auto [u, v] = across(glm::dvec3(light));
        const glm::dvec2 at(glm::dot(middle, u), glm::dot(middle, v)),
            aside(glm::dot(reach, glm::abs(u)), glm::dot(reach, glm::abs(v)));
        prisms.low = at - aside;
        prisms.high = at + aside;
        return prisms;
    }
    const glm::dvec3 away = awayFrom(light, middle);
    const double distance = glm::length(away), radius = glm::length(reach);
    if (!(distance > radius)) return prisms;
    const double angle = std::asin(radius / distance), height = std::asin(std::clamp(away.z / distance, -1.0, 1.0));
    prisms.low.y = height - angle;
    prisms.high.y = height + angle;
    if (std::abs(height) + angle >= glm::half_pi<double>()) return prisms;
    const double turn = std::asin(std::sin(angle) / std::cos(height)), azimuth = std::atan2(away.y, away.x);
    if (std::abs(azimuth) + turn > glm::pi<double>()) return prisms;
    prisms.low.x = azimuth - turn;
    prisms.high.x = azimuth + turn;
    return prisms;
}

void append(std::vector<VolumeGeometry::Range>& ranges, const VolumeGeometry::Range& range) {
    if (range.count == 0) return;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == range.first)
        ranges.back().count += range.count;
    else
        ranges.push_back(range);
}

const ShadowVolumes::Part& volumeOf(const SeenVolumes& all, const SeenPart& seen) {
    return all.meshes[seen.mesh].volumes->volumes().parts[seen.part];
}

void add(VolumeRound::Share& share, const SeenVolumes& all, const SeenPart& seen) {
    const ShadowVolumes::Part& part = volumeOf(all, seen);
    VolumeRound::Sides& sides = seen.holding ? share.entered : share.left;
    append(part.grazed ? sides.grazed : sides.usual, {part.first, part.count});
    if (!seen.holding) append(seen.showsBack ? share.bothCaps : share.lightCaps, seen.caps.light);
    append(share.darkCaps, seen.caps.dark);
    if (seen.holding) append(share.backs, seen.showsBack ? seen.caps.light : seen.caps.rim);
    if (seen.holding) append(share.rims, seen.caps.rim);
}

/// To those from `first` on that are counted from behind, may be seen from there, or have a rim.
osg::ref_ptr<const VolumeGeometry> giveCaps(LightVolumes& volumes, std::vector<SeenPart>& parts, std::size_t first) {
    const SilhouetteMesh& mesh = *volumes.caster().mesh;
    const bool anyBack = std::any_of(parts.begin() + std::ptrdiff_t(first), parts.end(),
                                     [](const SeenPart& part) { return part.showsBack; });
    std::vector<CapsWanted> wanted;
    std::vector<SeenPart*> of; // those in view
    std::size_t next = first;
    for (unsigned i = 0; i < mesh.parts.size(); ++i) {
        SeenPart* seen = next < parts.size() && parts[next].part == i ? &parts[next++] : nullptr;
        const bool isClosed = seen && !seen->holding, showsBack = seen && seen->showsBack;
        // If one open part shows its back, the next view may have another: all of them are there then, and stay.
        const bool light = isClosed || showsBack || (anyBack && !mesh.parts[i].closed);
        if (!light && !mesh.parts[i].smooth) continue;
        wanted.push_back({i, light, isClosed});
        of.push_back(seen);
    }
    std::vector<CapRanges> ranges;
    osg::ref_ptr<const VolumeGeometry> caps = volumes.capsOf(wanted, ranges);
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i]) of[i]->caps = ranges[i];
    return caps;
}

/// What a view may see of boxes and of the volumes behind them: not what is beyond one of its sides. Each is a linear function,
/// which is most in one corner of a box, and from there grows or falls along the light. In doubt, all is seen.
class Sight {
public:
    /// @param light  in the frame, see volumeHull().
    Sight(const glm::dmat4& clipFromFrame, const glm::dvec4& light) : _light(light) {
        const glm::dvec4 w = glm::row(clipFromFrame, 3);
        for (int i = 0; i < 4; ++i) _sides[std::size_t(i)] = w + (i & 1 ? -1.0 : 1.0) * glm::row(clipFromFrame, i / 2);
        _sides[near] = w + glm::row(clipFromFrame, 2);
        _clip = {glm::row(clipFromFrame, 0), glm::row(clipFromFrame, 1), w};
    }

    /// @param end  see nearestEnd().
    void lookAt(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& end) {
        _middle = {(low + high) / 2.0, 1.0};
        _half = (high - low) / 2.0;
        _length = longest(end, glm::dot(end, _middle) + reach(end));
        isBoxSeen = isVolumeSeen = true;
        for (std::size_t i = 0; i < _sides.size(); ++i) {
            const double at = glm::dot(_sides[i], _middle), by = reach(_sides[i]),
                         rounding = 1e-12 * (std::abs(at) + by), most = at + by + rounding;
            if (i == near) isCut = at - by <= rounding;
            isBoxSeen = isBoxSeen && !(most < 0.0);
            const double growth = _light.w * most - glm::dot(_sides[i], _light);
            if (i != near)
                isVolumeSeen = isVolumeSeen && !(most < 0.0 && !(growth > 0.0 && most + _length * growth >= 0.0));
        }
    }

    /// True if all of the volume is before the eye and within a part of the screen. In doubt, it is not.
    bool isVolumeWithin(const ScreenRect& part) const {
        const auto& [x, y, w] = _clip;
        for (const glm::dvec4& side : {_sides[near], x - part.low.x * w, part.high.x * w - x, y - part.low.y * w,
                                       part.high.y * w - y}) {
            const double least = glm::dot(side, _middle) - reach(side),
                         growth = _light.w * least - glm::dot(side, _light);
            if (!(least > 0.0 && (growth >= 0.0 || least + _length * growth > 0.0))) return false;
        }
        return true;
    }

    bool isBoxSeen = false, isVolumeSeen = false; ///< they may be.
    bool isCut = false;                           ///< some of the box is before the near plane.

private:
    static constexpr std::size_t near = 4;

    /// How far volumes go on that end at a plane. @param most  distance from it.
    double longest(const glm::dvec4& end, double most) const {
        const double steepness = glm::dot(end, _light) - _light.w * most; // where it is least
        return steepness > 0.0 ? std::max(0.0, most / steepness) : never;
    }

    double reach(const glm::dvec4& row) const { return glm::dot(glm::abs(glm::dvec3(row)), _half); }

    const glm::dvec4 _light;
    std::array<glm::dvec4, 5> _sides; ///< half-spaces: left, right, below, above, near.
    std::array<glm::dvec4, 3> _clip;  ///< x, y and w of clip space.
    glm::dvec4 _middle{0.0};          ///< of the box that was looked at last,
    glm::dvec3 _half{0.0};            ///< half of its sides,
    double _length = 0.0;             ///< and how far its volume goes on at most.
};

/// True if a part is, or may be, of a caster that is not drawn: of the joined ones only boxes tell.
bool isUnseen(const LightVolumes& volumes, const SilhouetteMesh::Part& part, const UnseenCasters& unseen) {
    if (unseen.boxes.empty()) return false;
    glm::dvec3 low(never), high(-never);
    for (const glm::dvec4& corner :
         boxCorners(glm::dvec3(part.low), glm::dvec3(part.high), volumes.caster().sceneFromMesh)) {
        low = glm::min(low, glm::dvec3(corner));
        high = glm::max(high, glm::dvec3(corner));
    }
    return unseen.touch(low, high);
}

bool isWhole(const ScreenRect& bounds) { return bounds.low == wholeScreen.low && bounds.high == wholeScreen.high; }

/// Adds the parts of a mesh that can be seen.
/// @param number  of it, among all of the light.
void lookAt(LightVolumes& volumes, std::size_t number, const glm::dmat4& clipFromScene, const UnseenCasters& unseen,
            SeenVolumes& all) {
    const SilhouetteMesh& mesh = *volumes.caster().mesh;
    const glm::dmat4 clipFromMesh = clipFromScene * volumes.caster().sceneFromMesh;
    if (mesh.parts.empty()) return;
    const SightStart start(clipFromMesh, glm::dvec3(mesh.low), glm::dvec3(mesh.high));
    Sight sight(clipFromMesh, volumes.volumes().light);
    const std::size_t before = all.parts.size();
    for (unsigned i = 0; i < mesh.parts.size(); ++i) {
        const ShadowVolumes::Part& volume = volumes.volumes().parts[i];
        const glm::dvec3 low(mesh.parts[i].low), high(mesh.parts[i].high);
        sight.lookAt(low, high, volume.end);
        if (!sight.isVolumeSeen) continue;
        const bool isKnown = !all.parts.empty() && (isWhole(all.bounds) || sight.isVolumeWithin(all.bounds));
        const auto bounds =
            isKnown ? all.bounds
                    : screenBounds(volumeHull(low, high, volume.end, volumes.volumes().light, clipFromMesh));
        if (!bounds) continue;
        const bool shows = sight.isBoxSeen && (!volumes.caster().hides(mesh.parts[i], start.eye) ||
                                               isUnseen(volumes, mesh.parts[i], unseen));
        const std::optional<int> holding =
            shows ? std::nullopt : volumesHolding(start, mesh, volumes.volumes(), i, sight.isCut);
        if (holding == 0 && volume.count == 0) continue;
        all.bounds = all.parts.empty() ? *bounds : united(all.bounds, *bounds);
        const bool showsBack = mayShowBack(start, mesh, volumes.volumes(), i, sight.isCut);
        all.parts.push_back({all.meshes.size(), i, holding, showsBack, {}});
    }
    if (all.parts.size() == before) return;
    all.meshes.push_back({&volumes, number, clipFromMesh, giveCaps(volumes, all.parts, before)});
}

} // namespace

bool ReceiverBox::fits(const ReceiverBox& other) const {
    if (!std::isfinite(glm::dot(low + high, glm::dvec3(1.0))))
        return !std::isfinite(glm::dot(other.low + other.high, glm::dvec3(1.0)));
    return glm::all(glm::lessThanEqual(low, other.low)) && glm::all(glm::greaterThanEqual(high, other.high)) &&
           glm::distance(low, high) <= 2.0 * glm::distance(other.low, other.high);
}

ReceiverBox ReceiverBox::grown() const {
    constexpr double share = 1.0 / 16.0;
    return {low - share * (high - low), high + share * (high - low)};
}

/// Leaves that share a matrix mostly follow one another.
ReceiverBox receiverBoxOf(const ViewFrame& view, const SceneFrame& scene) {
    const osg::Matrixd sceneFromEye = scene.sceneFromEye(view);
    const osg::RefMatrix* known = nullptr;
    osg::Matrixd sceneFromBox;
    ReceiverBox all{glm::dvec3(never), glm::dvec3(-never)};
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid() || view.movesReceivers) return {glm::dvec3(-never), glm::dvec3(never)};
        if (!known || known != leaf->_modelview) sceneFromBox = modelviewOf(*leaf) * sceneFromEye;
        known = leaf->_modelview.get();
        expand(all, box, sceneFromBox);
    }
    return all;
}

bool UnseenCasters::touch(const glm::dvec3& low, const glm::dvec3& high) const {
    const auto margin = [](const glm::dvec3& a, const glm::dvec3& b) {
        return 1e-6 * glm::length(glm::max(glm::abs(a), glm::abs(b)));
    };
    const double by = margin(low, high);
    const auto start = std::lower_bound(boxes.begin(), boxes.end(), low.x - by - widest,
                                        [](const AlignedBox& box, double x) { return box.low.x < x; });
    for (auto box = start; box != boxes.end() && box->low.x <= high.x + by; ++box)
        if (glm::all(glm::lessThanEqual(box->low, high + by)) && glm::all(glm::greaterThanEqual(box->high, low - by)))
            return true;
    return false;
}

UnseenCasters unseenCasters(const CasterLayers& casters, const ViewFrame& view, const SceneFrame& scene) {
    UnseenCasters unseen;
    if (!view.drawn) return unseen;
    const DrawablePlaces& drawn = view.drawn->standing(view.projection);
    const glm::dmat4 clipFromScene = scene.clipFromScene(view);
    const osg::Matrixd* groupFromLocal = nullptr; // of pieces that follow each other mostly the same
    osg::Matrixd eyeFromLocal;
    for (const auto& layer : {casters.still, casters.moving})
        for (const auto& piece : layer->pieces) {
            if (piece->hiding == Hiding::Neither) continue;
            if (!groupFromLocal || !hasSameBits(piece->groupFromLocal, *groupFromLocal))
                eyeFromLocal = piece->groupFromLocal * view.eyeFromGroup;
            groupFromLocal = &piece->groupFromLocal;
            if (drawn.hasAt(*piece->drawable, eyeFromLocal, 1e-14 * piece->groupFromLocal.getTrans().length()))
                continue;
            const AlignedBox box{scene.point(piece->bounds._min), scene.point(piece->bounds._max)};
            const auto corners = boxCorners(box.low, box.high, clipFromScene);
            if (!screenBounds(corners)) continue; // as out of sight
            unseen.boxes.push_back(box);
            unseen.widest = std::max(unseen.widest, box.high.x - box.low.x);
        }
    std::sort(unseen.boxes.begin(), unseen.boxes.end(), [](const auto& a, const auto& b) { return a.low.x < b.low.x; });
    return unseen;
}

bool VolumeCaster::hides(const SilhouetteMesh::Part& part, const glm::dvec3& eye) const {
    const unsigned kinds = part.kinds | kindOf(hiding);
    if (kinds & kindOf(Hiding::Neither)) return false;
    return !(kinds & kindOf(Hiding::Fronts)) || (part.closed && !part.inward && !part.boundsHold(eye));
}

LightVolumes::LightVolumes() : _sides(new VolumeGeometry) {}

bool LightVolumes::are(const VolumeCaster& caster, const glm::dvec4& light, const ReceiverBox& receivers) const {
    return _caster.mesh == caster.mesh && _caster.sceneFromMesh == caster.sceneFromMesh &&
           _caster.hiding == caster.hiding && _light == light && _receivers == receivers;
}

void LightVolumes::set(const VolumeCaster& caster, const glm::dvec4& light, const ReceiverBox& receivers) {
    _caster = caster;
    _light = light;
    _receivers = receivers;
    findShadowVolumes(*caster.mesh, lightIn(caster, light), endsIn(caster, receivers), _volumes);
    _sides->set(_volumes.vertices, _volumes.corners);
    _capped.clear();
}

osg::ref_ptr<const VolumeGeometry> LightVolumes::capsOf(const std::vector<CapsWanted>& wanted,
                                                        std::vector<CapRanges>& ranges) {
    if (wanted.empty()) return nullptr;
    if (!(wanted == _capped)) {
        if (!_caps || _caps->referenceCount() > 1) _caps = new VolumeGeometry;
        VolumeCaps caps;
        const auto end = [&caps] { return static_cast<unsigned>(caps.corners.size()); };
        _ranges.clear();
        for (const CapsWanted& of : wanted) {
            CapRanges range;
            const auto add = [&](VolumeGeometry::Range& range, auto&& append) {
                range.first = end();
                append(*_caster.mesh, _volumes, of.part, caps);
                range.count = end() - range.first;
            };
            if (of.light) add(range.light, appendLightCap);
            if (of.dark) add(range.dark, appendDarkCap);
            add(range.rim, appendRim);
            _ranges.push_back(range);
        }
        _caps->set(caps.vertices, caps.corners);
        _capped = wanted;
    }
    ranges = _ranges;
    return _caps;
}

void LightVolumes::resizeGLObjectBuffers(unsigned maxSize) {
    _sides->resizeGLObjectBuffers(maxSize);
    if (_caps) _caps->resizeGLObjectBuffers(maxSize);
}

void LightVolumes::releaseGLObjects(osg::State* state) const {
    _sides->releaseGLObjects(state);
    if (_caps) _caps->releaseGLObjects(state);
}

VolumeHull volumeHull(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& end, const glm::dvec4& light,
                      const glm::dmat4& clipFromBox) {
    const auto corners = boxCorners(low, high, clipFromBox);
    const glm::dvec4 awayFromSun = clipFromBox * glm::dvec4(awayFrom(light, low), 0.0); // the same anywhere
    VolumeHull points;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        const glm::dvec4 away = light.w == 0.0 ? awayFromSun : clipFromBox * glm::dvec4(awayFrom(light, corner), 0.0);
        const double length = lengthTo(end, corner, light);
        points[i] = corners[i];
        points[i + 8] = length < 0.0 ? away : corners[i] + length * away;
    }
    return points;
}

namespace {

std::vector<unsigned> roundsOf(std::vector<PrismLayers> tiles, unsigned capacity) {
    std::vector<unsigned> rounds(tiles.size(), 0u);
    std::size_t most = 0;
    for (const PrismLayers& tile : tiles) most += tile.mostOver;
    if (most <= capacity) return rounds;
    for (PrismLayers& tile : tiles) tile.mostOver = std::min(tile.mostOver, capacity);
    unsigned round = 0;
    for (const std::vector<LayerSlice>& together : stencilBatches(tiles, capacity)) {
        for (const LayerSlice& slice : together) rounds[slice.tile] = round;
        ++round;
    }
    return rounds;
}

} // namespace

VolumeRounds::VolumeRounds(const std::vector<osg::ref_ptr<LightVolumes>>& all) {
    for (const osg::ref_ptr<LightVolumes>& volumes : all) {
        _first.push_back(_prisms.size());
        for (unsigned i = 0; i < volumes->volumes().parts.size(); ++i) _prisms.push_back(prismsOf(*volumes, i));
    }
}

std::vector<unsigned> VolumeRounds::of(unsigned capacity) const {
    OpenThreads::ScopedLock<OpenThreads::Mutex> lock(_mutex);
    if (_capacity == capacity) return _rounds;
    _capacity = capacity;
    return _rounds = roundsOf(_prisms, capacity);
}

std::vector<unsigned> VolumeRounds::of(unsigned capacity, const std::vector<std::size_t>& parts) const {
    std::vector<PrismLayers> some;
    for (const std::size_t part : parts) some.push_back(_prisms[part]);
    return roundsOf(some, capacity);
}

/// Where a counter has one bit, volumes out of sight must not take rounds: without counters there is but one.
std::vector<unsigned> SeenVolumes::roundOfEach(unsigned capacity) const {
    if (!inRounds) return std::vector<unsigned>(parts.size(), 0u);
    std::vector<std::size_t> places;
    for (const SeenPart& seen : parts) places.push_back(inRounds->firstOf(meshes[seen.mesh].number) + seen.part);
    if (capacity == 1) return inRounds->of(capacity, places);
    const std::vector<unsigned> all = inRounds->of(capacity);
    std::vector<unsigned> rounds;
    for (const std::size_t place : places) rounds.push_back(all[place]);
    return rounds;
}

/// Parts in the order in which they lie in memory.
std::vector<VolumeRound> SeenVolumes::rounds(unsigned capacity) const {
    const std::vector<unsigned> numbers = roundOfEach(capacity);
    std::vector<VolumeRound> all(1);
    VolumeRound::Share* share = nullptr; // of parts that follow each other mostly the same
    std::size_t mesh = 0, round = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const SeenPart& seen = parts[i];
        const std::size_t in = numbers[i];
        if (all.size() <= in) {
            all.resize(in + 1);
            share = nullptr;
        }
        if (!share || seen.mesh != mesh || in != round) share = &all[round = in].shares[mesh = seen.mesh];
        add(*share, *this, seen);
        all[in].holding += seen.holding.value_or(0);
    }
    const auto isEmpty = [](const VolumeRound& round) { return round.shares.empty(); };
    all.erase(std::remove_if(all.begin(), all.end(), isEmpty), all.end());
    return all;
}

std::shared_ptr<const SeenVolumes::Counted> SeenVolumes::countedBy(unsigned capacity) const {
    OpenThreads::ScopedLock<OpenThreads::Mutex> lock(_mutex);
    const auto passes = [&](const SeenPart& seen) { return volumeOf(*this, seen).mostOver > capacity; };
    if (_capacity != capacity)
        _counted =
            std::make_shared<const Counted>(Counted{rounds(capacity), std::any_of(parts.begin(), parts.end(), passes)});
    _capacity = capacity;
    return _counted;
}

namespace {

/// See SeenVolumes.
double vertexStepOf(const SeenVolumes& all, double near) {
    double most = 0.0;
    for (const SeenPart& seen : all.parts) {
        const MeshInView& mesh = all.meshes[seen.mesh];
        const SilhouetteMesh::Part& part = mesh.volumes->caster().mesh->parts[seen.part];
        const glm::dvec3 low(part.low), high(part.high), away = glm::max(glm::max(low, -high), 0.0);
        const glm::dvec4 across = glm::row(mesh.clipFromMesh, 0), towards = glm::row(mesh.clipFromMesh, 3);
        const glm::dvec3 nearest = glm::mix(low, high, glm::lessThan(glm::dvec3(towards), glm::dvec3(0.0)));
        const double w = std::max(glm::dot(towards, glm::dvec4(nearest, 1.0)), near);
        const double step = std::max({away.x, away.y, away.z}) / (1 << 24);
        most = std::max(most, step * glm::length(glm::dvec3(across)) / 2.0 / w);
    }
    return most;
}

} // namespace

std::shared_ptr<const SeenVolumes> seenVolumes(const std::vector<osg::ref_ptr<LightVolumes>>& all,
                                               const glm::dmat4& clipFromScene, double near,
                                               const osg::ref_ptr<const VolumeRounds>& rounds,
                                               const UnseenCasters& unseen) {
    const auto result = std::make_shared<SeenVolumes>();
    result->inRounds = rounds;
    for (std::size_t i = 0; i < all.size(); ++i) lookAt(*all[i], i, clipFromScene, unseen, *result);
    if (result->parts.empty()) return nullptr;
    result->vertexStep = vertexStepOf(*result, near);
    return result;
}

} // namespace gnomon
