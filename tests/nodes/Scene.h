// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/VertexTraverser.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <array>
#include <initializer_list>
#include <vector>

/// Small scenes for the tests of nodes, and what was extracted from them as plain numbers.
namespace scene {

using Corners = std::array<osg::Vec3d, 3>;

template <class Array>
osg::ref_ptr<osg::Geometry> geometryOf(const osg::ref_ptr<Array>& vertices, osg::PrimitiveSet* primitives) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices.get());
    geometry->addPrimitiveSet(primitives);
    return geometry;
}

template <class Array>
osg::ref_ptr<Array> arrayOf(std::initializer_list<typename Array::ElementDataType> vertices) {
    osg::ref_ptr<Array> array = new Array;
    array->assign(vertices.begin(), vertices.end());
    return array;
}

inline osg::ref_ptr<osg::Vec3Array> vec3s(std::initializer_list<osg::Vec3> vertices) {
    return arrayOf<osg::Vec3Array>(vertices);
}

/// The triangle (0,0,0), (1,0,0), (0,1,0), its front to +z.
inline osg::ref_ptr<osg::Geometry> triangle() {
    return geometryOf(vec3s({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                      new osg::DrawArrays(osg::PrimitiveSet::TRIANGLES, 0, 3));
}

inline osg::ref_ptr<osg::Geode> geodeOf(osg::Drawable* drawable) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(drawable);
    return geode;
}

inline osg::ref_ptr<osg::MatrixTransform> under(const osg::Matrixd& matrix, osg::Node* node) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(matrix);
    transform->addChild(node);
    return transform;
}

/// The triangle, moved to begin at (x, 0, 0): tests recognise it by that.
inline osg::ref_ptr<osg::MatrixTransform> triangleAt(double x) {
    return under(osg::Matrix::translate(x, 0, 0), geodeOf(triangle().get()));
}

inline std::vector<Corners> trianglesOf(const gnomon::VertexTraverser& casters) {
    std::vector<Corners> result;
    const auto& v = casters.getVertices();
    const auto& i = casters.getTriangles();
    for (std::size_t at = 0; at + 2 < i.size(); at += 3) result.push_back({v[i[at]], v[i[at + 1]], v[i[at + 2]]});
    return result;
}

inline std::vector<Corners> trianglesOf(osg::Node& root, const gnomon::Selection& selection = {}) {
    gnomon::VertexTraverser casters(selection);
    root.accept(casters);
    return trianglesOf(casters);
}

/// Where the triangles begin in x: for scenes of triangleAt().
inline std::vector<double> startsOf(osg::Node& root, const gnomon::Selection& selection = {}) {
    std::vector<double> result;
    for (const Corners& corners : trianglesOf(root, selection)) result.push_back(corners[0].x());
    return result;
}

} // namespace scene
