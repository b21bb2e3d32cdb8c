// SPDX-License-Identifier: MIT
#include <gnomon/group/SceneFrame.h>
#include <gnomon/planar/PlanarCasters.h>

#include <glm/common.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {

PlanarCasters::PlanarCasters(const CasterLayers& layers, const glm::dvec4& groupPlane, bool under, const Source& source)
    : plane(SceneFrame(layers.origin).plane(groupPlane)),
      low(std::numeric_limits<double>::infinity()),
      high(-low),
      _layers(layers.retired()),
      _groupPlane(groupPlane),
      _under(under) {
    for (const PlacedMesh& placed : layers.meshes()) {
        _meshes.push_back(source(placed, plane));
        add(*_meshes.back());
    }
}

void PlanarCasters::add(const PlanarParts& more) {
    if (more.parts.empty()) return;
    low = glm::min(low, more.low);
    high = glm::max(high, more.high);
    highest = std::max(highest, more.highest);
    for (const PlanarPart& part : more.parts) {
        parts.push_back(part);
        crosses = crosses || part.crossing;
    }
}

bool PlanarCasters::seeksSolids(unsigned frame) const {
    return std::any_of(_meshes.begin(), _meshes.end(),
                       [frame](const auto& mesh) { return !mesh->knowsSolids && mesh->firstFrame != frame; });
}

osg::ref_ptr<const PlanarParts> PlanarCasters::find(const PlacedMesh& placed) const {
    const auto found =
        std::find_if(_meshes.begin(), _meshes.end(), [&](const auto& mesh) { return mesh->madeFrom(placed); });
    return found == _meshes.end() ? nullptr : *found;
}

osg::ref_ptr<const PlanarParts> PlanarCasters::at(std::size_t place, const PlacedMesh& placed) const {
    return place < _meshes.size() && _meshes[place]->madeFrom(placed) ? _meshes[place] : nullptr;
}

void PlanarCasters::resizeGLObjectBuffers(unsigned maxSize) {
    for (const PlanarPart& part : parts) part.geometry->resizeGLObjectBuffers(maxSize);
}

void PlanarCasters::releaseGLObjects(osg::State* state) const {
    for (const PlanarPart& part : parts) part.geometry->releaseGLObjects(state);
}

} // namespace gnomon
