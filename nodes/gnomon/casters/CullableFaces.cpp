// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CullableFaces.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>

namespace gnomon {
namespace {

constexpr std::size_t mostTests = 1 << 16; // each hole is looked for in all runs of what has holes: a millisecond

/// Of what fills a hole the corners of those triangles that look to the light, in its clip space.
std::vector<glm::dvec4> turnedToLight(const std::vector<glm::dvec3>& filling, const glm::dmat4& clipFromScene) {
    const double hand = glm::determinant(clipFromScene) > 0.0 ? -1.0 : 1.0; // see CullableFaces::draw()
    const auto xyw = [](const glm::dvec4& p) { return glm::dvec3(p.x, p.y, p.w); };
    std::vector<glm::dvec4> result;
    for (std::size_t i = 0; i + 2 < filling.size(); i += 3) {
        glm::dvec4 corners[3];
        for (std::size_t k = 0; k < 3; ++k) corners[k] = clipFromScene * glm::dvec4(filling[i + k], 1.0);
        if (hand * glm::determinant(glm::dmat3(xyw(corners[0]), xyw(corners[1]), xyw(corners[2]))) > 0.0)
            result.insert(result.end(), std::begin(corners), std::end(corners));
    }
    return result;
}

/// Of the parts whose triangles are meant.
std::vector<osg::BoundingBox> boxesOf(const CasterMesh& mesh, const osg::DrawElementsUInt& triangles,
                                      const ClosedParts& parts, const std::vector<bool>& meant) {
    std::unordered_map<unsigned, osg::BoundingBox> boxes; // by part
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (meant[i / 3]) boxes[parts.part[i / 3]].expandBy((*mesh.vertices)[triangles[i]]);
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

bool isOutside(const glm::dvec4& light, const std::vector<osg::BoundingBox>& boxes) {
    const osg::Vec3 lamp(osg::Vec3d(light.x, light.y, light.z));
    return std::none_of(boxes.begin(), boxes.end(), [&](const osg::BoundingBox& box) {
        const float rounding = 1e-6f * (lamp.length() + box.radius());
        const osg::Vec3 more(rounding, rounding, rounding);
        return osg::BoundingBox(box._min - more, box._max + more).contains(lamp);
    });
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
    const auto inHoled = static_cast<std::size_t>(std::count(parts.holed.begin(), parts.holed.end(), true));
    const bool fewHoles = parts.holes.size() * inHoled / TriangleClusters::trianglesInRun <= mostTests;
    const osg::ref_ptr<osg::DrawElementsUInt> closed = noTriangles(), open = noTriangles(), withHoles = noTriangles();
    for (std::size_t i = 0; i < triangles->size(); ++i) {
        const auto& list = parts.closed[i / 3] ? closed : fewHoles && parts.holed[i / 3] ? withHoles : open;
        list->push_back(parts.welded[(*triangles)[i]]); // fewer vertices to transform
    }
    if (!closed->empty()) {
        solids = drawnOf(mesh, closed);
        _solidBoxes = boxesOf(mesh, *triangles, parts, parts.closed);
    }
    if (!open->empty()) others = drawnOf(mesh, open);
    if (!withHoles->empty()) {
        holed = drawnOf(mesh, withHoles);
        _holedBoxes = boxesOf(mesh, *triangles, parts, parts.holed);
        _clusters = new TriangleClusters(*holed);
        for (const auto& filling : parts.holes) {
            _holes.emplace_back();
            for (const unsigned vertex : filling) _holes.back().push_back(toGlm(osg::Vec3d((*mesh.vertices)[vertex])));
        }
    }
}

CullableFaces::Outside CullableFaces::outside(const glm::dvec4& light) const {
    return {light.w == 0.0 || isOutside(light, _solidBoxes), light.w == 0.0 || isOutside(light, _holedBoxes)};
}

void CullableFaces::draw(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene, const Outside& outside) const {
    if (others) others->draw(renderInfo);
    const bool mirrored = glm::determinant(clipFromScene) > 0.0; // OpenGL's own projections turn left to right hands
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    const auto drawTurned = [&](const osg::Geometry* geometry, bool culled) {
        if (!geometry) return;
        (culled ? glEnable : glDisable)(GL_CULL_FACE);
        geometry->draw(renderInfo);
    };
    drawTurned(solids, outside.solids);
    drawTurned(holed, outside.holed);
    if (holed && outside.holed) drawBehindHoles(renderInfo, clipFromScene);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

/// Faces turned away, of what has holes: elsewhere each is behind one that is turned to the light.
void CullableFaces::drawBehindHoles(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene) const {
    constexpr double rounding = 1.0 / 128.0; // of half the map: some texels
    glCullFace(GL_FRONT);
    for (const auto& filling : _holes) {
        const std::vector<glm::dvec4> opening = turnedToLight(filling, clipFromScene);
        const std::optional<ScreenRect> seen = opening.empty() ? std::nullopt : screenBounds(opening);
        if (!seen) continue;
        const ScreenRect bounds{seen->low - rounding, seen->high + rounding};
        TriangleClusters::draw(renderInfo, *holed, _clusters->touching(bounds, toOsg(clipFromScene)));
    }
    glCullFace(GL_BACK);
}

void CullableFaces::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& geometry : {solids, holed, others})
        if (geometry) geometry->resizeGLObjectBuffers(maxSize);
}

void CullableFaces::releaseGLObjects(osg::State* state) const {
    for (const auto& geometry : {solids, holed, others})
        if (geometry) geometry->releaseGLObjects(state);
}

} // namespace gnomon
