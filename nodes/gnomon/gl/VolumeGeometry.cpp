// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/VolumeGeometry.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

namespace gnomon {
namespace {

/// Keeps a geometry's arrays and primitive sets, which it has already, in buffer objects, and tells OpenGL that they change:
/// a driver may put what is said to be static where writing takes long.
inline void keepInChangingBuffers(osg::Geometry& geometry) {
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
    geometry.getOrCreateVertexBufferObject()->setUsage(GL_DYNAMIC_DRAW);
    geometry.getOrCreateElementBufferObject()->setUsage(GL_DYNAMIC_DRAW);
}

/// Where lines of sight are parallel, a triangle at infinity is beside all of them. A lamp's then ends far beyond all that
/// is seen: 10^7 times as far from it as the caster, which floats still hold.
double endlessIn(const glm::dmat4& clipFromVertices, const glm::dvec4& light) {
    const bool parallel = glm::dvec3(glm::row(clipFromVertices, 3)) == glm::dvec3(0.0);
    return parallel && light.w != 0.0 ? 1e7 : -1.0;
}

} // namespace

void placeVolumes(const osg::State& state, const glm::dmat4& clipFromVertices, const glm::dvec4& light) {
    setUniform(state, "clipFromVertex", clipFromVertices);
    setUniform(state, "light", light);
    setUniform(state, "endless", endlessIn(clipFromVertices, light));
    glFrontFace(glm::determinant(clipFromVertices) > 0.0 ? GL_CW : GL_CCW); // clip space is left-handed
}

VolumeGeometry::VolumeGeometry()
    : _geometry(new osg::Geometry), _vertices(new osg::Vec4Array), _corners(new osg::DrawElementsUInt(GL_TRIANGLES)) {
    _geometry->setVertexArray(_vertices);
    _geometry->addPrimitiveSet(_corners);
    keepInChangingBuffers(*_geometry);
}

void VolumeGeometry::set(const std::vector<glm::vec4>& vertices, const std::vector<unsigned>& corners) {
    static_assert(sizeof(glm::vec4) == sizeof(osg::Vec4));
    const auto* places = reinterpret_cast<const osg::Vec4*>(vertices.data());
    _vertices->assign(places, places + vertices.size());
    _corners->assign(corners.begin(), corners.end());
    _vertices->dirty();
    _corners->dirty();
}

void VolumeGeometry::draw(osg::RenderInfo& renderInfo, const std::vector<Range>& ranges) const {
    if (ranges.size() == 1 && ranges.front().count == _corners->size()) return drawAll(renderInfo);
    std::vector<TriangleClusters::Run> runs;
    for (const Range& range : ranges) runs.push_back({0, range.first, range.count});
    if (!runs.empty()) TriangleClusters::draw(renderInfo, *_geometry, runs);
}

void VolumeGeometry::drawAll(osg::RenderInfo& renderInfo) const {
    if (!_corners->empty()) _geometry->draw(renderInfo);
}

} // namespace gnomon
