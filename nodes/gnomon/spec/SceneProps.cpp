// SPDX-License-Identifier: MIT
#include <gnomon/SceneProps.h>
#include <gnomon/VertexTraverser.h>

#include <osg/ComputeBoundsVisitor>
#include <osg/DisplaySettings>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

bool finite(const osg::Vec3d& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

osg::BoundingBoxd ofVertices(osg::Node& root) {
    VertexTraverser traverser;
    root.accept(traverser);
    osg::BoundingBoxd box;
    for (const osg::Vec3d& vertex : traverser.getVertices())
        if (finite(vertex)) box.expandBy(vertex);
    return box;
}

/// Text and billboards, which are no casters, have bounds only here.
osg::BoundingBoxd ofDrawables(osg::Node& root) {
    osg::ComputeBoundsVisitor visitor;
    root.accept(visitor);
    const osg::BoundingBox& box = visitor.getBoundingBox();
    const osg::Vec3d low(box._min), high(box._max);
    return box.valid() && finite(low) && finite(high) ? osg::BoundingBoxd(low, high) : osg::BoundingBoxd();
}

class LightFinder : public osg::NodeVisitor {
public:
    LightFinder() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}
    void apply(osg::LightSource& source) override {
        if (source.getLight()) found.push_back(&source);
        traverse(source);
    }
    std::vector<osg::ref_ptr<osg::LightSource>> found;
};

constexpr double hair = 1e-4;  // of the scene's radius: a level underside does not fight with the ground
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

osg::BoundingBoxd sceneBounds(osg::Node& root) {
    const osg::BoundingBoxd box = ofVertices(root);
    return box.valid() ? box : ofDrawables(root);
}

osg::ref_ptr<osg::Node> makeGround(const osg::BoundingBoxd& scene, double side) {
    const osg::Vec3d centre = scene.center();
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::translate(centre.x(), centre.y(), scene.zMin() - hair * scene.radius()));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(grid(side));
    place->addChild(geode);
    place->setName("ground");
    return place;
}

osg::Vec4d sunAt(double azimuth, double elevation) {
    const double a = osg::DegreesToRadians(azimuth), e = osg::DegreesToRadians(elevation);
    return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e), 0.0};
}

std::vector<osg::ref_ptr<osg::LightSource>> lightSourcesIn(osg::Node& root) {
    LightFinder finder;
    root.accept(finder);
    return finder.found;
}

void askForStencilBits() {
    osg::DisplaySettings& settings = *osg::DisplaySettings::instance();
    settings.setMinimumNumStencilBits(std::max(settings.getMinimumNumStencilBits(), 8u));
}

void askForAlphaBits() {
    osg::DisplaySettings& settings = *osg::DisplaySettings::instance();
    settings.setMinimumNumAlphaBits(std::max(settings.getMinimumNumAlphaBits(), 8u));
}

} // namespace gnomon
