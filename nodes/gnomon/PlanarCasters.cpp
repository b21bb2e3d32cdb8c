// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/PlanarCasters.h>
#include <gnomon/Plane.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

glm::dvec3 vertexAt(const CasterMesh& mesh, unsigned index) { return toGlm(osg::Vec3d((*mesh.vertices)[index])); }

std::vector<double> heightsAbove(const CasterMesh& mesh, const glm::dvec4& plane) {
    std::vector<double> heights(mesh.vertices->size());
    for (unsigned i = 0; i < heights.size(); ++i) heights[i] = distance(plane, vertexAt(mesh, i));
    return heights;
}

/// A vertex this near to the plane lies in it: four steps of the floats it is kept in and of those it came from.
double thicknessOf(const CasterMesh& mesh) {
    const double reach = (mesh.bounds._max - mesh.bounds._min).length() / 2.0;
    return 4.0 * (reach * std::numeric_limits<float>::epsilon() / 2.0 + mesh.rounding);
}

osg::ref_ptr<osg::Geometry> geometryOf(const CasterMesh& mesh, osg::DrawElementsUInt* triangles) {
    if (triangles->empty()) return nullptr;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(mesh.vertices.get());
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

} // namespace

PlanarCasters::PlanarCasters(const CasterMesh& mesh, const glm::dvec4& groupPlane)
    : plane(groupPlane.x, groupPlane.y, groupPlane.z, distance(groupPlane, toGlm(mesh.origin))),
      low(std::numeric_limits<double>::infinity()),
      high(-low),
      thickness(thicknessOf(mesh)),
      _mesh(&mesh),
      _groupPlane(groupPlane) {
    const std::vector<double> heights = heightsAbove(mesh, plane);
    osg::ref_ptr<osg::DrawElementsUInt> wholly = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
    osg::ref_ptr<osg::DrawElementsUInt> partly = new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES);
    const osg::DrawElementsUInt& all = *mesh.triangles;
    for (unsigned i = 0; i + 2 < all.size(); i += 3) {
        const auto [lowest, top] = std::minmax({heights[all[i]], heights[all[i + 1]], heights[all[i + 2]]});
        if (!(top > thickness)) continue;
        osg::DrawElementsUInt& kept = lowest < -thickness ? *partly : *wholly;
        for (unsigned corner = i; corner < i + 3; ++corner) {
            kept.push_back(all[corner]);
            low = glm::min(low, vertexAt(mesh, all[corner]));
            high = glm::max(high, vertexAt(mesh, all[corner]));
        }
        highest = std::max(highest, top);
    }
    above = geometryOf(mesh, wholly.get());
    crossing = geometryOf(mesh, partly.get());
}

void PlanarCasters::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& geometry : {above, crossing})
        if (geometry) geometry->resizeGLObjectBuffers(maxSize);
}

void PlanarCasters::releaseGLObjects(osg::State* state) const {
    for (const auto& geometry : {above, crossing})
        if (geometry) geometry->releaseGLObjects(state);
}

} // namespace gnomon
