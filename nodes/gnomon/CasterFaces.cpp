// SPDX-License-Identifier: MIT
#include <gnomon/CasterFaces.h>

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <unordered_map>

namespace gnomon {

osg::ref_ptr<osg::DrawElementsUInt> noTriangles() { return new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES); }

/// osg::Vec3 and glm::vec3 are three floats each.
ClosedParts closedPartsOf(const CasterMesh& mesh, const osg::DrawElementsUInt& triangles) {
    static_assert(sizeof(osg::Vec3) == sizeof(glm::vec3));
    return closedParts(reinterpret_cast<const glm::vec3*>(mesh.vertices->getDataPointer()), mesh.vertices->size(),
                       &triangles.front(), triangles.size());
}

CasterFaces::CasterFaces(const CasterMesh& mesh, osg::DrawElementsUInt* triangles, bool findSolids) {
    if (!findSolids) {
        others = casterGeometry(mesh, triangles);
        return;
    }
    const ClosedParts parts = closedPartsOf(mesh, *triangles);
    const osg::ref_ptr<osg::DrawElementsUInt> closed = noTriangles(), open = noTriangles();
    for (std::size_t i = 0; i < triangles->size(); ++i)
        (parts.closed[i / 3] ? closed : open)->push_back(parts.welded[(*triangles)[i]]); // fewer vertices to transform
    if (!closed->empty()) solids = casterGeometry(mesh, closed);
    std::unordered_map<unsigned, osg::BoundingBox> boxes; // by part
    for (std::size_t i = 0; i < triangles->size(); ++i)
        if (parts.closed[i / 3]) boxes[parts.part[i / 3]].expandBy((*mesh.vertices)[(*triangles)[i]]);
    for (const auto& entry : boxes) _boxes.push_back(entry.second);
    if (!open->empty()) others = casterGeometry(mesh, open);
}

bool CasterFaces::isOutside(const glm::dvec4& light) const {
    if (light.w == 0.0) return true;
    const osg::Vec3 lamp(osg::Vec3d(light.x, light.y, light.z));
    return std::none_of(_boxes.begin(), _boxes.end(), [&](const osg::BoundingBox& box) {
        const float rounding = 1e-6f * (lamp.length() + box.radius());
        const osg::Vec3 more(rounding, rounding, rounding);
        return osg::BoundingBox(box._min - more, box._max + more).contains(lamp);
    });
}

void CasterFaces::draw(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromMesh, bool outside) const {
    if (others) others->draw(renderInfo);
    if (!solids) return;
    const bool mirrored = glm::determinant(clipFromMesh) > 0.0; // OpenGL's own projections turn left to right hands
    if (outside) glEnable(GL_CULL_FACE);
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    solids->draw(renderInfo);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

void CasterFaces::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& geometry : {solids, others})
        if (geometry) geometry->resizeGLObjectBuffers(maxSize);
}

void CasterFaces::releaseGLObjects(osg::State* state) const {
    for (const auto& geometry : {solids, others})
        if (geometry) geometry->releaseGLObjects(state);
}

} // namespace gnomon
