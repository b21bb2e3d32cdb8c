// SPDX-License-Identifier: MIT
#include <gnomon/CasterFaces.h>
#include <gnomon/Convert.h>
#include <gnomon/ScreenBounds.h>

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>

namespace gnomon {
namespace {

constexpr std::size_t mostHoles = 64; // each is looked for in all that has holes

/// Of what fills a hole the corners of those triangles that look to the light, in its clip space.
std::vector<glm::dvec4> turnedToLight(const std::vector<glm::dvec3>& filling, const glm::dmat4& clipFromMesh) {
    const double hand = glm::determinant(clipFromMesh) > 0.0 ? -1.0 : 1.0; // see CasterFaces::draw()
    const auto xyw = [](const glm::dvec4& p) { return glm::dvec3(p.x, p.y, p.w); };
    std::vector<glm::dvec4> result;
    for (std::size_t i = 0; i + 2 < filling.size(); i += 3) {
        glm::dvec4 corners[3];
        for (std::size_t k = 0; k < 3; ++k) corners[k] = clipFromMesh * glm::dvec4(filling[i + k], 1.0);
        if (hand * glm::determinant(glm::dmat3(xyw(corners[0]), xyw(corners[1]), xyw(corners[2]))) > 0.0)
            result.insert(result.end(), std::begin(corners), std::end(corners));
    }
    return result;
}

} // namespace

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
    const bool fewHoles = parts.holes.size() <= mostHoles;
    const osg::ref_ptr<osg::DrawElementsUInt> closed = noTriangles(), open = noTriangles(), withHoles = noTriangles();
    for (std::size_t i = 0; i < triangles->size(); ++i) {
        const auto& list = parts.closed[i / 3] ? closed : fewHoles && parts.holed[i / 3] ? withHoles : open;
        list->push_back(parts.welded[(*triangles)[i]]); // fewer vertices to transform
    }
    if (!closed->empty()) solids = casterGeometry(mesh, closed);
    if (!open->empty()) others = casterGeometry(mesh, open);
    if (!withHoles->empty()) {
        holed = casterGeometry(mesh, withHoles);
        _clusters = new IndexClusters(*holed);
        for (const auto& filling : parts.holes) {
            _holes.emplace_back();
            for (const unsigned vertex : filling) _holes.back().push_back(toGlm(osg::Vec3d((*mesh.vertices)[vertex])));
        }
    }
    findBoxes(mesh, *triangles, parts);
}

void CasterFaces::findBoxes(const CasterMesh& mesh, const osg::DrawElementsUInt& triangles, const ClosedParts& parts) {
    std::unordered_map<unsigned, osg::BoundingBox> boxes; // by part
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (parts.closed[i / 3] || (holed && parts.holed[i / 3]))
            boxes[parts.part[i / 3]].expandBy((*mesh.vertices)[triangles[i]]);
    for (const auto& entry : boxes) _boxes.push_back(entry.second);
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
    if (!solids && !holed) return;
    const bool mirrored = glm::determinant(clipFromMesh) > 0.0; // OpenGL's own projections turn left to right hands
    if (outside) glEnable(GL_CULL_FACE);
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    for (const auto& geometry : {solids, holed})
        if (geometry) geometry->draw(renderInfo);
    if (outside && holed) drawBehindHoles(renderInfo, clipFromMesh);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

/// Faces turned away, of what has holes: elsewhere each is behind one that is turned to the light.
void CasterFaces::drawBehindHoles(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromMesh) const {
    constexpr double rounding = 1.0 / 1024.0; // of the map: some texels
    glCullFace(GL_FRONT);
    for (const auto& filling : _holes) {
        const std::vector<glm::dvec4> opening = turnedToLight(filling, clipFromMesh);
        const std::optional<ScreenRect> seen = opening.empty() ? std::nullopt : screenBounds(opening);
        if (!seen) continue;
        const ScreenRect bounds{seen->low - rounding, seen->high + rounding};
        IndexClusters::draw(renderInfo, *holed, _clusters->touching(bounds, toOsg(clipFromMesh)));
    }
    glCullFace(GL_BACK);
}

void CasterFaces::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& geometry : {solids, holed, others})
        if (geometry) geometry->resizeGLObjectBuffers(maxSize);
}

void CasterFaces::releaseGLObjects(osg::State* state) const {
    for (const auto& geometry : {solids, holed, others})
        if (geometry) geometry->releaseGLObjects(state);
}

} // namespace gnomon
