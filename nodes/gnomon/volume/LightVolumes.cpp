// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/silhouette/VolumeEnd.h>
#include <gnomon/volume/LightVolumes.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

/// Those of the scene, in the mesh's frame.
std::vector<glm::dvec4> endsIn(const VolumeCaster& caster, const ReceiverBox& receivers) {
    std::vector<glm::dvec4> planes;
    for (const glm::dvec4& plane : endPlanes(receivers.low, receivers.high))
        if (const auto there = normalizedPlane(glm::transpose(caster.sceneFromMesh) * plane)) planes.push_back(*there);
    return planes;
}

} // namespace

glm::dvec4 lightIn(const VolumeCaster& caster, const glm::dvec4& lightInScene) {
    const glm::dvec4 light = glm::inverse(caster.sceneFromMesh) * lightInScene;
    return light.w == 0.0 ? glm::dvec4(glm::normalize(glm::dvec3(light)), 0.0) : light;
}

LightVolumes::LightVolumes() : _sides(new VolumeGeometry) {}

bool LightVolumes::are(const VolumeCaster& caster, const glm::dvec4& light, const ReceiverBox& receivers) const {
    return _caster.mesh == caster.mesh && _caster.sceneFromMesh == caster.sceneFromMesh && _light == light &&
           _receivers == receivers;
}

void LightVolumes::set(const VolumeCaster& caster, const glm::dvec4& light, const ReceiverBox& receivers) {
    _caster = caster;
    _light = light;
    _receivers = receivers;
    findShadowVolumes(*caster.mesh, lightIn(caster, light), endsIn(caster, receivers), _volumes);
    _sides->set(_volumes.vertices, _volumes.corners);
    _caps.parts.clear();
    _backs.parts.clear();
}

template <class Append>
void LightVolumes::Surfaces::set(const std::vector<unsigned>& some, const glm::dvec4& from, const Append& append) {
    if (!geometry || geometry->referenceCount() > 1) geometry = new VolumeGeometry;
    VolumeCaps found;
    ranges.clear();
    for (const unsigned part : some) {
        const auto first = static_cast<unsigned>(found.corners.size());
        append(part, found);
        ranges.push_back({first, static_cast<unsigned>(found.corners.size()) - first});
    }
    geometry->set(found.vertices, found.corners);
    parts = some;
    eye = from;
}

osg::ref_ptr<const VolumeGeometry> LightVolumes::capsOf(const std::vector<unsigned>& parts,
                                                        std::vector<VolumeGeometry::Range>& ranges,
                                                        std::vector<VolumeGeometry::Range>& ends) {
    if (parts.empty()) return nullptr;
    if (!_caps.areOf(parts, glm::dvec4(0.0))) {
        _surfaces.clear();
        _caps.set(parts, glm::dvec4(0.0), [this](unsigned part, VolumeCaps& into) {
            _surfaces.push_back(appendCaps(*_caster.mesh, _volumes, part, into));
        });
    }
    ranges = ends = _caps.ranges;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        ranges[i].count = _surfaces[i];
        ends[i] = {ends[i].first + _surfaces[i], ends[i].count - _surfaces[i]};
    }
    return _caps.geometry;
}

osg::ref_ptr<const VolumeGeometry> LightVolumes::backsOf(const std::vector<unsigned>& parts, const glm::dvec4& eye,
                                                         std::vector<VolumeGeometry::Range>& ranges) {
    if (parts.empty()) return nullptr;
    const auto append = [&](unsigned part, VolumeCaps& into) { appendBacks(*_caster.mesh, _volumes, part, eye, into); };
    if (!_backs.areOf(parts, eye)) _backs.set(parts, eye, append);
    ranges = _backs.ranges;
    return _backs.geometry;
}

void LightVolumes::resizeGLObjectBuffers(unsigned maxSize) {
    _sides->resizeGLObjectBuffers(maxSize);
    for (const Surfaces* surfaces : {&_caps, &_backs})
        if (surfaces->geometry) surfaces->geometry->resizeGLObjectBuffers(maxSize);
}

void LightVolumes::releaseGLObjects(osg::State* state) const {
    _sides->releaseGLObjects(state);
    for (const Surfaces* surfaces : {&_caps, &_backs})
        if (surfaces->geometry) surfaces->geometry->releaseGLObjects(state);
}

} // namespace gnomon
