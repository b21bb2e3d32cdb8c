// SPDX-License-Identifier: MIT
#include <gnomon/CasterMesh.h>
#include <gnomon/VertexTraverser.h>

#include <osg/BufferObject>

#include <limits>

namespace gnomon {
namespace {

osg::BoundingBoxd boundsOf(const VertexTraverser& casters) {
    osg::BoundingBoxd bounds;
    for (unsigned index : casters.getTriangles()) bounds.expandBy(casters.getVertices()[index]);
    return bounds;
}

} // namespace

CasterMesh::CasterMesh(const VertexTraverser& casters)
    : vertices(new osg::Vec3Array),
      triangles(new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES)),
      bounds(boundsOf(casters)),
      rounding(casters.getRounding()),
      drawn(casters.getDrawn()),
      invalidTriangles(casters.getInvalidTriangles()),
      invalidNode(casters.getInvalidNode()),
      sources(casters.getSources()) {
    // Attached here, for the first geometry to use the array would do so, perhaps in one of several threads.
    vertices->setVertexBufferObject(new osg::VertexBufferObject);
    triangles->setElementBufferObject(new osg::ElementBufferObject);
    if (bounds.valid()) origin = bounds.center();
    constexpr unsigned nowhere = std::numeric_limits<unsigned>::max();
    std::vector<unsigned> places(casters.getVertices().size(), nowhere);
    triangles->reserve(casters.getTriangles().size());
    for (unsigned index : casters.getTriangles()) {
        if (places[index] == nowhere) {
            places[index] = static_cast<unsigned>(vertices->size());
            vertices->push_back(osg::Vec3(casters.getVertices()[index] - origin));
        }
        triangles->push_back(places[index]);
    }
}

osg::ref_ptr<osg::Geometry> casterGeometry(const CasterMesh& mesh, osg::DrawElementsUInt* triangles) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(mesh.vertices.get());
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

} // namespace gnomon
