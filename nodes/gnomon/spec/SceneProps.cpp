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

constexpr double hair = 1e-4;      // of the scene's radius: a level underside does not fight with the ground
constexpr unsigned cells = 16;     // a side: OpenGL lights vertices, and a lamp's light varies over the ground
constexpr double fineRadii = 4.0;  // of the scene: side of the square that has these cells; they grow beyond
constexpr double growth = 1.5;     // of the distance from the middle, from line to line beyond
constexpr double leastFine = 1e-6; // of the side

/// Where the lines of the grid lie on either axis, in order.
std::vector<double> gridLines(double side, double fine) {
    std::vector<double> lines;
    const double middle = std::clamp(fine, leastFine * side, side);
    for (unsigned i = 0; i <= cells; ++i) lines.push_back((double(i) / cells - 0.5) * middle);
    while (lines.back() < 0.499 * side) {
        const double next = std::min(lines.back() * growth, 0.5 * side);
        lines.push_back(next);
        lines.insert(lines.begin(), -next);
    }
    return lines;
}

osg::ref_ptr<osg::Vec3Array> gridVertices(const std::vector<double>& lines) {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const double y : lines)
        for (const double x : lines) vertices->push_back(osg::Vec3d(x, y, 0.0));
    return vertices;
}

osg::ref_ptr<osg::DrawElementsUShort> gridTriangles(unsigned row) {
    osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (unsigned j = 0; j + 1 < row; ++j)
        for (unsigned i = 0; i + 1 < row; ++i)
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

osg::ref_ptr<osg::Geometry> grid(const std::vector<double>& lines) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> normal = new osg::Vec3Array(osg::Array::BIND_OVERALL);
    normal->push_back(osg::Vec3(0, 0, 1));
    geometry->setVertexArray(gridVertices(lines));
    geometry->setNormalArray(normal);
    geometry->addPrimitiveSet(gridTriangles(static_cast<unsigned>(lines.size())));
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
    geode->addDrawable(grid(gridLines(side, fineRadii * scene.radius())));
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
