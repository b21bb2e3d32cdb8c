// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/silhouette/LightFacing.h>
#include <gnomon/volume/LightVolumes.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
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

/// What its drawables hide, a bit each, for each triangle; empty if that is all the same.
std::vector<std::uint8_t> kindsOf(const CasterMesh& mesh) {
    const auto hidesAll = [](const auto& drawn) { return drawn.hiding == Hiding::Both; };
    std::vector<std::uint8_t> kinds;
    if (std::all_of(mesh.drawn.begin(), mesh.drawn.end(), hidesAll)) return kinds;
    kinds.resize(mesh.triangles->size() / 3);
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        const std::size_t end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : mesh.triangles->size();
        std::fill(kinds.begin() + std::ptrdiff_t(mesh.drawn[i].first / 3), kinds.begin() + std::ptrdiff_t(end / 3),
                  kindOf(mesh.drawn[i].hiding));
    }
    return kinds;
}

std::shared_ptr<const SilhouetteMesh> edgesOf(const CasterMesh& mesh) {
    if (mesh.empty()) return std::make_shared<const SilhouetteMesh>();
    const std::vector<std::uint8_t> kinds = kindsOf(mesh);
    return std::make_shared<const SilhouetteMesh>(positionsOf(mesh), mesh.vertices->size(), &mesh.triangles->front(),
                                                  mesh.triangles->size(), kinds.empty() ? nullptr : kinds.data());
}

/// Those of the scene, in the mesh's frame.
std::vector<glm::dvec4> endsIn(const VolumeCaster& caster, const ReceiverBox& receivers) {
    std::vector<glm::dvec4> planes;
    for (const glm::dvec4& plane : endPlanes(receivers.low, receivers.high))
        if (const auto there = normalizedPlane(glm::transpose(caster.sceneFromMesh) * plane)) planes.push_back(*there);
    return planes;
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

/// Leaves share few matrices.
ReceiverBox receiversOf(const ViewFrame& view, const SceneFrame& scene) {
    const osg::Matrixd sceneFromEye = scene.sceneFromEye(view);
    std::map<const osg::RefMatrix*, osg::Matrixd> known;
    ReceiverBox all{glm::dvec3(never), glm::dvec3(-never)};
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) return {glm::dvec3(-never), glm::dvec3(never)};
        const auto found = known.find(leaf->_modelview.get());
        const osg::Matrixd& sceneFromBox =
            found != known.end()
                ? found->second
                : known.emplace(leaf->_modelview.get(), modelviewOf(*leaf) * sceneFromEye).first->second;
        expand(all, box, sceneFromBox);
    }
    return all;
}

bool VolumeCaster::hides(const SilhouetteMesh::Part& part, const glm::dvec3& eye) const {
    const unsigned kinds = part.kinds | kindOf(hiding);
    if (kinds & kindOf(Hiding::Neither)) return false;
    return !(kinds & kindOf(Hiding::Fronts)) || (part.closed && !part.inward && !part.boundsHold(eye));
}

std::vector<VolumeCaster> VolumeCasters::of(const CasterLayers& casters, unsigned round) {
    std::vector<VolumeCaster> all;
    for (const auto& layer : {casters.still, casters.moving})
        for (const PlacedMesh& placed : layer->meshes) {
            Entry& entry = _entries[placed.mesh.get()];
            if (!entry.mesh) entry = {placed.mesh, edgesOf(*placed.mesh), 0};
            entry.used = round;
            all.push_back({entry.edges, placed.sceneFromMesh, placed.hiding});
        }
    for (auto entry = _entries.begin(); entry != _entries.end();)
        entry = round - entry->second.used > longUnused ? _entries.erase(entry) : std::next(entry);
    return all;
}

glm::dvec4 lightIn(const VolumeCaster& caster, const glm::dvec4& lightInScene) {
    const glm::dvec4 light = glm::inverse(caster.sceneFromMesh) * lightInScene;
    return light.w == 0.0 ? glm::dvec4(glm::normalize(glm::dvec3(light)), 0.0) : light;
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
    _showBacks.clear();
}

bool LightVolumes::showsBack(const SightStart& start, unsigned part, bool mayBeCut) {
    if (_towardsEye != start.towardsEye) _showBacks.clear();
    _towardsEye = start.towardsEye;
    const auto [known, isNew] = _showBacks.try_emplace({part, mayBeCut}, false);
    if (isNew) known->second = mayShowBack(start, *_caster.mesh, _volumes, part, mayBeCut);
    return known->second;
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
            range.light.first = end();
            appendLightCap(*_caster.mesh, _volumes, of.part, caps);
            range.dark.first = end();
            range.light.count = range.dark.first - range.light.first;
            if (of.dark) appendDarkCap(*_caster.mesh, _volumes, of.part, caps);
            range.dark.count = end() - range.dark.first;
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
    VolumeHull points;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
        const glm::dvec3 away = awayFrom(light, corner);
        const double length = lengthTo(end, corner, light);
        points[i] = clipFromBox * glm::dvec4(corner, 1.0);
        points[i + 8] = clipFromBox * (length < 0.0 ? glm::dvec4(away, 0.0) : glm::dvec4(corner + length * away, 1.0));
    }
    return points;
}

/// Not if it is beyond one of the sides of what is seen.
bool isInSight(const VolumeHull& hull) {
    const auto isBeyond = [&hull](auto&& distance) { return std::all_of(hull.begin(), hull.begin() + 8, distance); };
    return !(isBeyond([](const glm::dvec4& at) { return at.x < -at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.x > at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.y < -at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.y > at.w; }) ||
             isBeyond([](const glm::dvec4& at) { return at.z < -at.w; }));
}

std::optional<ScreenRect> boundsOf(const VolumeHull& hull) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ScreenRect rect{glm::dvec2(infinity), glm::dvec2(-infinity)};
    for (const glm::dvec4& point : hull) {
        if (!(point.w > 1e-6 * (std::abs(point.x) + std::abs(point.y))))
            return screenBounds({hull.begin(), hull.end()});
        const glm::dvec2 at = glm::dvec2(point) / point.w;
        rect.low = glm::min(rect.low, at);
        rect.high = glm::max(rect.high, at);
    }
    rect = common(rect, wholeScreen);
    if (!overlap(rect, rect)) return std::nullopt;
    return rect;
}

} // namespace gnomon
