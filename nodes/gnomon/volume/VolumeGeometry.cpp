// SPDX-License-Identifier: MIT
#include <gnomon/gl/ChangingBuffers.h>
#include <gnomon/volume/VolumeGeometry.h>

namespace gnomon {

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
