// SPDX-License-Identifier: MIT
#include <gnomon/gl/ChangingBuffers.h>
#include <gnomon/gl/TriangleClusters.h>
#include <gnomon/overlay/ShadowPrisms.h>
#include <gnomon/terrain/TileMesh.h>

#include <algorithm>

namespace gnomon {

TileMesh::TileMesh() : _geometry(new osg::Geometry) {
    _geometry->setVertexArray(new osg::Vec3Array);
    _geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES));
    keepInChangingBuffers(*_geometry);
}

osg::Vec3Array& TileMesh::vertices() { return static_cast<osg::Vec3Array&>(*_geometry->getVertexArray()); }
osg::DrawElementsUInt& TileMesh::corners() {
    return static_cast<osg::DrawElementsUInt&>(*_geometry->getPrimitiveSet(0));
}

/// @param of  ShadowPrisms or ShadowDecals, whose layers are appended.
template <typename Shadows, typename Append>
void TileMesh::setFrom(const Shadows& of, Append append) {
    static_assert(sizeof(glm::vec3) == sizeof(osg::Vec3));
    const auto* places = reinterpret_cast<const osg::Vec3*>(of.vertices.data());
    vertices().assign(places, places + of.vertices.size());
    corners().clear();
    _ends.clear();
    append([&](const std::vector<unsigned>& layer) {
        corners().insert(corners().end(), layer.begin(), layer.end());
        _ends.push_back(static_cast<unsigned>(corners().size()));
    });
    vertices().dirty();
    corners().dirty();
    low = of.low;
    high = of.high;
}

void TileMesh::set(const ShadowPrisms& prisms) {
    setFrom(prisms, [&](auto add) { std::for_each(prisms.layers.begin(), prisms.layers.end(), add); });
    mostOver = prisms.mostOver;
}

void TileMesh::set(const ShadowDecals& decals) {
    setFrom(decals, [&](auto add) {
        if (!decals.triangles.empty()) add(decals.triangles);
    });
}

void TileMesh::draw(osg::RenderInfo& renderInfo, unsigned firstLayer, unsigned count) const {
    const unsigned first = firstLayer ? _ends[firstLayer - 1] : 0, end = _ends[firstLayer + count - 1];
    if (first == 0 && end == _ends.back())
        _geometry->draw(renderInfo);
    else
        TriangleClusters::draw(renderInfo, *_geometry, {{0, first, end - first}});
}

} // namespace gnomon
