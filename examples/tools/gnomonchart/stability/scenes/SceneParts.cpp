// SPDX-License-Identifier: MIT
#include "SceneParts.h"

#include "SceneSetup.h"

#include <gnomon/NamedNode.h>

#include <glm/trigonometric.hpp>
#include <osg/MatrixTransform>

#include <cmath>
#include <utility>

namespace gnomon::examples {
namespace {

SceneCamera cameraOf(const SceneParts& parts, const osg::BoundingBoxd& bounds, int width, int height) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    const osg::Vec3d way = parts.center - parts.eye;
    const bool down = std::hypot(way.x(), way.y()) < 1e-3 * way.length();
    camera->setViewMatrixAsLookAt(parts.eye, parts.center,
                                  down ? osg::Vec3d(0.0, 1.0, 0.0) : osg::Vec3d(0.0, 0.0, 1.0));
    const double aspect = double(width) / height, near = parts.near.value_or(1.0), far = parts.far.value_or(2.0);
    if (parts.orthographic) {
        const double up = *parts.orthographic;
        camera->setProjectionMatrixAsOrtho(-up * aspect, up * aspect, -up, up, near, far);
    } else {
        camera->setProjectionMatrixAsPerspective(parts.fovy, aspect, near, far);
    }
    if (parts.near) camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    return sceneCamera(*camera, width, height, bounds);
}

} // namespace

void SceneParts::add(const Mesh& mesh, const std::string& name) { content->addChild(node(mesh, name)); }

void SceneParts::enclose(const osg::Matrixd& matrix) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(matrix);
    for (unsigned i = 0; i < content->getNumChildren(); ++i) place->addChild(content->getChild(i));
    content = new osg::Group;
    content->addChild(place);
}

StabilityCase stabilityCase(const SceneParts& parts, int width, int height) {
    StabilityCase result;
    ChartScene& scene = result.scene;
    scene.content = parts.content;
    scene.light = parts.light;
    scene.bounds = sceneBounds(*parts.content);
    scene.camera = cameraOf(parts, scene.bounds, width, height);
    scene.center = parts.center;
    scene.radius = parts.radius;
    if (findNamed(*parts.content, "ground")) scene.receiver = "ground";
    scene.terrain = findNamed(*parts.content, "terrain") ? "terrain" : scene.receiver;
    scene.round = parts.round;
    result.truth = parts.truth;
    return result;
}

std::function<StabilityCase(double, int, int)> madeOf(std::function<SceneParts(double)> parts) {
    return [make = std::move(parts)](double value, int width, int height) {
        return stabilityCase(make(value), width, height);
    };
}

SceneParts onGround(double half) {
    SceneParts parts;
    parts.add(square(half), "ground");
    return parts;
}

Mesh landscape(const std::function<double(double, double)>& height, double half, int cells) {
    const auto corner = [&](int i, int j) {
        const double x = half * (2.0 * i / cells - 1.0), y = half * (2.0 * j / cells - 1.0);
        return glm::dvec3(x, y, height(x, y));
    };
    Mesh mesh;
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const glm::dvec3 a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
            mesh.insert(mesh.end(), {a, b, c, a, c, d});
        }
    return mesh;
}

Mesh tilted(double half, double degrees) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    return quad(half * glm::dvec3(-c, -1.0, s), 2.0 * half * glm::dvec3(c, 0.0, -s),
                2.0 * half * glm::dvec3(0.0, 1.0, 0.0));
}

Mesh boxAt(const glm::dvec3& foot, const glm::dvec3& size) {
    const glm::dvec3 half(size.x / 2.0, size.y / 2.0, 0.0);
    return box(foot - half, foot + half + glm::dvec3(0.0, 0.0, size.z));
}

} // namespace gnomon::examples
