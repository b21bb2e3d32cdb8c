// SPDX-License-Identifier: MIT
#include <gnomon/casters/CullableFaces.h>

#include <glm/matrix.hpp>

#include <algorithm>
#include <unordered_map>

namespace gnomon {
namespace {

/// Of the parts that are closed.
std::vector<osg::BoundingBox> boxesOf(const CasterMesh& mesh, const osg::DrawElementsUInt& triangles,
                                      const ClosedParts& parts) {
    std::unordered_map<unsigned, osg::BoundingBox> boxes; // by part
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (parts.closed[i / 3]) boxes[parts.part[i / 3]].expandBy((*mesh.vertices)[triangles[i]]);
    std::vector<osg::BoundingBox> result;
    for (const auto& entry : boxes) result.push_back(entry.second);
    return result;
}

/// With the offsets as texture coordinates, as mark.vert takes them.
osg::ref_ptr<osg::Geometry> drawnOf(const CasterMesh& mesh, osg::DrawElementsUInt* triangles) {
    osg::ref_ptr<osg::Geometry> geometry = casterGeometry(mesh, triangles);
    if (mesh.offsets) geometry->setTexCoordArray(0, mesh.offsets.get(), osg::Array::BIND_PER_VERTEX);
    return geometry;
}

} // namespace

osg::ref_ptr<osg::DrawElementsUInt> noTriangles() { return new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES); }

ClosedParts closedPartsOf(const CasterMesh& mesh, const osg::DrawElementsUInt& triangles) {
    return closedParts(positionsOf(mesh), mesh.vertices->size(), &triangles.front(), triangles.size(), true);
}

CullableFaces::CullableFaces(const CasterMesh& mesh, osg::DrawElementsUInt* triangles, bool findSolids)
    : smooth(mesh.offsets.valid()) {
    if (!findSolids) {
        others = drawnOf(mesh, triangles);
        return;
    }
    const ClosedParts parts = closedPartsOf(mesh, *triangles);
    const osg::ref_ptr<osg::DrawElementsUInt> closed = noTriangles(), open = noTriangles();
    for (std::size_t i = 0; i < triangles->size(); ++i)
        (parts.closed[i / 3] ? closed : open)->push_back(parts.welded[(*triangles)[i]]); // fewer vertices to transform
    if (!closed->empty()) {
        solids = drawnOf(mesh, closed);
        _solidBoxes = boxesOf(mesh, *triangles, parts);
    }
    if (!open->empty()) others = drawnOf(mesh, open);
}

bool CullableFaces::isOutside(const glm::dvec4& light) const {
    const osg::Vec3 lamp(osg::Vec3d(light.x, light.y, light.z));
    return light.w == 0.0 || std::none_of(_solidBoxes.begin(), _solidBoxes.end(), [&](const osg::BoundingBox& box) {
               const float rounding = 1e-6f * (lamp.length() + box.radius());
               const osg::Vec3 more(rounding, rounding, rounding);
               return osg::BoundingBox(box._min - more, box._max + more).contains(lamp);
           });
}

void CullableFaces::draw(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene, bool outside) const {
    if (others) others->draw(renderInfo);
    if (!solids) return;
    const bool mirrored = glm::determinant(clipFromScene) > 0.0; // OpenGL's own projections turn left to right hands
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    if (outside) glEnable(GL_CULL_FACE);
    solids->draw(renderInfo);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

void CullableFaces::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& geometry : {solids, others})
        if (geometry) geometry->resizeGLObjectBuffers(maxSize);
}

void CullableFaces::releaseGLObjects(osg::State* state) const {
    for (const auto& geometry : {solids, others})
        if (geometry) geometry->releaseGLObjects(state);
}

} // namespace gnomon
