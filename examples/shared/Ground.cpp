// SPDX-License-Identifier: MIT
#include "Ground.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>

namespace gnomon::examples {
namespace {

constexpr unsigned cells = 16; // a side: OpenGL lights vertices, and a lamp's light varies over the ground

osg::ref_ptr<osg::Vec3Array> gridVertices(double side) {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (unsigned j = 0; j <= cells; ++j)
        for (unsigned i = 0; i <= cells; ++i)
            vertices->push_back(osg::Vec3d(double(i) / cells - 0.5, double(j) / cells - 0.5, 0.0) * side);
    return vertices;
}

osg::ref_ptr<osg::DrawElementsUShort> gridTriangles() {
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    const unsigned row = cells + 1;
    for (unsigned j = 0; j < cells; ++j)
        for (unsigned i = 0; i < cells; ++i)
            for (const unsigned corner : {0u, 1u, row + 1, 0u, row + 1, row})
                triangles->push_back(static_cast<GLushort>(j * row + i + corner));
    return triangles;
}

osg::ref_ptr<osg::Material> mattWhite() {
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
    material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
    return material;
}

osg::ref_ptr<osg::Geometry> grid(double side) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> normal = new osg::Vec3Array(osg::Array::BIND_OVERALL);
    normal->push_back(osg::Vec3(0, 0, 1));
    geometry->setVertexArray(gridVertices(side));
    geometry->setNormalArray(normal);
    geometry->addPrimitiveSet(gridTriangles());
    geometry->getOrCreateStateSet()->setAttributeAndModes(mattWhite());
    return geometry;
}

} // namespace

osg::ref_ptr<osg::Node> makeGround(const osg::BoundingBoxd& scene, double side) {
    const osg::Vec3d centre = scene.center();
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::translate(centre.x(), centre.y(), scene.zMin()));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(grid(side));
    place->addChild(geode);
    place->setName("ground");
    return place;
}

} // namespace gnomon::examples
