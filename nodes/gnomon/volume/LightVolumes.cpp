// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/silhouette/ShadowVolumes.h>
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

} // namespace gnomon
