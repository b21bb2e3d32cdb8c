// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/casters/CullableFaces.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/planar/PlanarCasters.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

glm::dvec3 vertexAt(const CasterMesh& mesh, unsigned index) { return toGlm(osg::Vec3d((*mesh.vertices)[index])); }

/// A vertex this near to the plane lies in it: four steps of the floats it is kept in and of those it came from.
double thicknessAt(const CasterMesh& mesh, const glm::dvec3& vertex) {
    return 4.0 * (glm::length(vertex) * std::numeric_limits<float>::epsilon() / 2.0 + mesh.rounding);
}

/// 0 of what lies in the plane.
std::vector<double> heightsAbove(const CasterMesh& mesh, const glm::dvec4& plane) {
    std::vector<double> heights(mesh.vertices->size());
    for (unsigned i = 0; i < heights.size(); ++i) {
        const glm::dvec3 vertex = vertexAt(mesh, i);
        const double height = distance(plane, vertex);
        if (!(std::abs(height) <= thicknessAt(mesh, vertex))) heights[i] = height;
    }
    return heights;
}

} // namespace

PlanarCasters::PlanarCasters(const CasterMesh& mesh, const glm::dvec4& groupPlane, bool under, bool findSolids)
    : plane(SceneFrame(mesh.origin).plane(groupPlane)),
      low(std::numeric_limits<double>::infinity()),
      high(-low),
      _mesh(&mesh),
      _groupPlane(groupPlane),
      _under(under),
      _knowsSolids(findSolids) {
    const std::vector<double> heights = heightsAbove(mesh, plane);
    const osg::DrawElementsUInt& all = *mesh.triangles;
    const ClosedParts closed = findSolids ? closedPartsOf(mesh, all) : ClosedParts();
    osg::ref_ptr<osg::DrawElementsUInt> lists[2][2]; // [crossing][solid]
    for (auto& row : lists)
        for (auto& list : row) list = noTriangles();
    for (unsigned i = 0; i + 2 < all.size(); i += 3) {
        const auto [lowest, top] = std::minmax({heights[all[i]], heights[all[i + 1]], heights[all[i + 2]]});
        if (!(top > 0.0 || (under && lowest < 0.0))) continue;
        osg::DrawElementsUInt& list = *lists[lowest < 0.0][findSolids && closed.closed[i / 3]];
        for (unsigned corner = i; corner < i + 3; ++corner) {
            list.push_back(findSolids ? closed.welded[all[corner]] : all[corner]);
            low = glm::min(low, vertexAt(mesh, all[corner]));
            high = glm::max(high, vertexAt(mesh, all[corner]));
            if (lowest < 0.0) thickness = std::max(thickness, thicknessAt(mesh, vertexAt(mesh, all[corner])));
        }
        highest = std::max(highest, top);
    }
    for (const bool crossing : {false, true})
        for (const bool solid : {false, true})
            if (!lists[crossing][solid]->empty())
                parts.push_back({casterGeometry(mesh, lists[crossing][solid]), crossing, solid});
    crosses = !parts.empty() && parts.back().crossing;
}

void PlanarCasters::resizeGLObjectBuffers(unsigned maxSize) {
    for (const Part& part : parts) part.geometry->resizeGLObjectBuffers(maxSize);
}

void PlanarCasters::releaseGLObjects(osg::State* state) const {
    for (const Part& part : parts) part.geometry->releaseGLObjects(state);
}

} // namespace gnomon
