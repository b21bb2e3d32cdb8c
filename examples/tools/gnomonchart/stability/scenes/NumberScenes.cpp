// SPDX-License-Identifier: MIT
// What floating-point numbers do.
#include "SceneParts.h"

#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <limits>

namespace gnomon::examples {
namespace {

std::vector<Mesh> houses() {
    return {house({2.0, 0.0}, {2.0, 2.0, 3.0}, 30.0), house({-2.5, 1.5}, {1.5, 3.0, 2.0}, 75.0),
            sphere({-1.5, -2.0, 1.5}, 0.8)};
}

SceneParts village() {
    SceneParts parts = onGround();
    for (const Mesh& mesh : houses()) parts.add(mesh);
    return parts;
}

SceneParts farFromOrigin(double metres) {
    SceneParts parts = village();
    const osg::Vec3d to(metres, 0.7 * metres, 0.1 * metres);
    parts.enclose(osg::Matrixd::translate(to));
    parts.eye += to;
    parts.center += to;
    return parts;
}

/// The same with a lamp.
SceneParts lampFarFromOrigin(double metres) {
    SceneParts parts = farFromOrigin(metres);
    parts.light = osg::Vec4d(osg::Vec3d(metres, 0.7 * metres, 0.1 * metres) + osg::Vec3d(0.5, -1.0, 6.0), 1.0);
    return parts;
}

SceneParts ofScale(double scale) {
    SceneParts parts = village();
    parts.enclose(osg::Matrixd::scale(scale, scale, scale));
    parts.eye *= scale;
    parts.center *= scale;
    parts.radius *= scale;
    return parts;
}

/// Casters below so many transforms, of which every other one mirrors, and which come to the identity in pairs.
SceneParts nested(double depth) {
    SceneParts parts = onGround();
    for (const Mesh& mesh : houses()) {
        osg::ref_ptr<osg::Node> below = node(mesh);
        for (int i = 0; i < int(depth); ++i) {
            const double stretch = i % 2 ? -0.5 : -2.0;
            osg::ref_ptr<osg::MatrixTransform> over = new osg::MatrixTransform(osg::Matrixd::scale(stretch, 1.0, 1.0));
            over->addChild(below);
            below = over;
        }
        parts.add(below);
    }
    return parts;
}

/// OpenSceneGraph does not draw what is infinitely large.
class BoundsOf : public osg::Drawable::ComputeBoundingBoxCallback {
public:
    explicit BoundsOf(const Mesh& mesh) {
        for (const glm::dvec3& corner : mesh) _bounds.expandBy(float(corner.x), float(corner.y), float(corner.z));
    }
    osg::BoundingBox computeBound(const osg::Drawable&) const override { return _bounds; }

private:
    osg::BoundingBox _bounds;
};

/// Triangles that are none, in the casters' own drawable.
SceneParts withBadTriangles(double count) {
    SceneParts parts = onGround();
    parts.truth = new osg::Group;
    parts.truth->addChild(node(square(12.0), "ground"));
    for (const Mesh& mesh : houses()) parts.truth->addChild(node(mesh));
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    const glm::dvec3 bad[] = {{nan, nan, nan}, {infinite, 0.0, 1.0}, {0.0, -infinite, 1.0}, {0.0, 0.0, nan}};
    for (const Mesh& whole : houses()) {
        Mesh mesh = whole;
        const glm::dvec3 corner = mesh.front();
        for (int i = 0; i < int(count); ++i)
            mesh.insert(mesh.begin() + 3 * i, {i % 3 ? bad[i % 4] : corner, corner, corner}); // some have no area
        const osg::ref_ptr<osg::Geode> caster = node(mesh);
        caster->getDrawable(0)->setComputeBoundingBoxCallback(new BoundsOf(whole));
        parts.add(caster);
    }
    return parts;
}

/// A tower 800 m away, with the far plane at 1 km.
SceneParts depthRange(double ratio) {
    SceneParts parts = onGround(1200.0);
    parts.add(boxAt({0.0, 800.0, 0.0}, {40.0, 40.0, 60.0}));
    parts.add(boxAt({-10.0, 60.0, 0.0}, {6.0, 6.0, 8.0}));
    parts.eye = {-480.0, 300.0, 420.0};
    parts.center = {-20.0, 800.0, 10.0};
    parts.fovy = 30.0;
    parts.far = 1000.0;
    parts.near = 1000.0 / ratio;
    parts.radius = 60.0;
    return parts;
}

} // namespace

std::vector<StabilityScene> numberScenes() {
    Section section("numbers");
    section.add("N1", "Far from the origin, sun", "The picture must be that at the origin.", "distance", "m",
                {0.0, 1e3, 1e4, 1e5, 5e5, 1e6, 6e6, 1e7}, farFromOrigin);
    section.add("N1L", "Far from the origin, lamp", "A lamp's matrix multiplies coordinates, and loses them twice.",
                "distance", "m", {0.0, 1e3, 1e4, 1e5, 5e5, 1e6, 6e6, 1e7}, lampFarFromOrigin);
    section.add("N2", "Broken triangles", "NaN, infinity and triangles without area count as if they were not there.",
                "broken triangles in each caster", "", {0.0, 1.0, 4.0, 16.0, 100.0}, withBadTriangles);
    section.add("N3", "Scale", "The same scene in any unit gives the same picture.", "size of a metre", "units",
                {1.0, 0.1, 10.0, 1e-2, 1e2, 1e-3, 1e3, 1e4}, ofScale);
    section.add("N4", "Nested and mirrored transforms",
                "Each transform mirrors and stretches the caster, and turns its faces inside out.",
                "transforms above a caster", "", {0.0, 1.0, 2.0, 7.0, 16.0, 33.0}, nested);
    section.add("N5", "Depth range", "Marks drawn at the receiver's own depth fight with it where depth is coarse.",
                "far plane over near plane", "", {1e2, 1e3, 1e4, 1e5, 1e6}, depthRange);
    return section.scenes();
}

} // namespace gnomon::examples
