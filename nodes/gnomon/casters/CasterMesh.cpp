// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>

#include <osg/BufferObject>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

osg::BoundingBoxd boundsOf(const CasterExtraction& casters) {
    osg::BoundingBoxd bounds;
    for (unsigned index : casters.getTriangles()) bounds.expandBy(casters.getVertices()[index]);
    return bounds;
}

/// The middle one of the corners along each axis: near most of them, however far a few are. Floats are fine about it.
osg::Vec3d middleOf(const CasterExtraction& casters) {
    const std::vector<unsigned>& corners = casters.getTriangles();
    const std::size_t every = corners.size() / 1000 + 1;
    osg::Vec3d middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> places;
        for (std::size_t i = 0; i < corners.size(); i += every)
            places.push_back(casters.getVertices()[corners[i]][axis]);
        const auto half = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
        std::nth_element(places.begin(), half, places.end());
        middle[axis] = *half;
    }
    return middle;
}

constexpr unsigned nowhere = std::numeric_limits<unsigned>::max();

/// @param places  where each vertex went, if it is used; those of a drawable still follow one another.
CasterExtraction::Cutout renumbered(const CasterExtraction::Cutout& found, const std::vector<unsigned>& places) {
    CasterExtraction::Cutout result{found.drawn, found.test, nowhere, {}};
    const unsigned* own = places.data() + found.firstVertex;
    for (std::size_t i = 0; i < found.coordinates.size(); ++i)
        result.firstVertex = std::min(result.firstVertex, own[i]);
    for (std::size_t i = 0; i < found.coordinates.size(); ++i) {
        if (own[i] == nowhere) continue;
        const std::size_t at = own[i] - result.firstVertex;
        if (result.coordinates.size() <= at) result.coordinates.resize(at + 1);
        result.coordinates[at] = found.coordinates[i];
    }
    return result;
}

} // namespace

CasterMesh::CasterMesh(const CasterExtraction& casters, const std::optional<osg::Vec3d>& about)
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
    if (about || bounds.valid()) origin = about ? *about : middleOf(casters);
    std::vector<unsigned> places(casters.getVertices().size(), nowhere);
    triangles->reserve(casters.getTriangles().size());
    for (unsigned index : casters.getTriangles()) {
        if (places[index] == nowhere) {
            places[index] = static_cast<unsigned>(vertices->size());
            vertices->push_back(osg::Vec3(casters.getVertices()[index] - origin));
        }
        triangles->push_back(places[index]);
    }
    for (const CasterExtraction::Cutout& cutout : casters.getCutouts()) {
        cutouts.push_back(renumbered(cutout, places));
        if (cutouts.back().coordinates.empty()) cutouts.pop_back(); // points and lines
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
