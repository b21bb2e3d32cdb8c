// SPDX-License-Identifier: MIT
// What is hard on shadow maps.
#include "SceneParts.h"

#include <gnomon/Convert.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Program>

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

using glm::dvec3;

/// A row of posts along a street that the camera looks down.
SceneParts street(double half = 120.0) {
    SceneParts parts = onGround(half);
    for (int i = -4; i < 16; ++i) {
        parts.add(boxAt({-6.0, 6.0 * i, 0.0}, {2.0, 2.0, 4.0}));
        parts.add(boxAt({6.0, 6.0 * i + 3.0, 0.0}, {2.0, 2.0, 3.0 + i % 3}));
    }
    parts.eye = {0.0, -20.0, 8.0};
    parts.center = {0.0, 20.0, 0.0};
    parts.light = sunAt(120.0, 40.0);
    parts.radius = 50.0;
    return parts;
}

/// A sphere and a roof; lit surfaces as steep to the light as the elevation says.
SceneParts lit(double elevation) {
    SceneParts parts = onGround();
    parts.add(sphere({-2.5, 0.0, 2.0}, 1.5, 96));
    parts.add(moved(tilted(1.8, 35.0), {2.5, 0.0, 1.6}));
    parts.light = sunAt(100.0, elevation);
    return parts;
}

SceneParts kerb(double height) {
    SceneParts parts = onGround(40.0);
    parts.add(boxAt({0.0, 0.0, 0.0}, {1.0, 12.0, height}));
    parts.add(boxAt({8.0, 10.0, 0.0}, {3.0, 3.0, 8.0})); // what the map must cover besides
    parts.light = sunAt(100.0, 30.0);
    parts.eye = {-2.0, -8.0, 5.0};
    parts.center = {-0.5, 0.0, 0.0};
    parts.radius = 10.0;
    return parts;
}

/// A closed room of this thickness, seen from inside: no light gets in.
SceneParts closedRoom(double thickness) {
    SceneParts parts = onGround(20.0);
    const double t = thickness;
    parts.add(box({-3.0 - t, -3.0 - t, 2.8}, {3.0 + t, 3.0 + t, 2.8 + t}));
    parts.add(box({-3.0 - t, -3.0 - t, 0.0}, {-3.0, 3.0 + t, 2.8}));
    parts.add(box({3.0, -3.0 - t, 0.0}, {3.0 + t, 3.0 + t, 2.8}));
    parts.add(box({-3.0, -3.0 - t, 0.0}, {3.0, -3.0, 2.8}));
    parts.add(box({-3.0, 3.0, 0.0}, {3.0, 3.0 + t, 2.8}));
    parts.light = {0.7, -0.5, 1.0, 0.0};
    parts.eye = {2.6, -2.6, 2.4};
    parts.center = {-1.5, 1.5, 0.4};
    parts.fovy = 70.0;
    return parts;
}

/// The camera turns towards the sun.
SceneParts facingSun(double degrees) {
    SceneParts parts = street();
    const double angle = osg::DegreesToRadians(degrees);
    parts.light = {-std::sin(angle), -std::cos(angle), std::tan(osg::DegreesToRadians(18.0)), 0.0};
    return parts;
}

/// The camera goes on by so many hundredths of a metre, sideways and ahead.
SceneParts creeping(double hundredths) {
    SceneParts parts = lit(40.0);
    parts.add(house({0.5, -3.0}, {1.0, 1.0, 2.0}, 20.0));
    const osg::Vec3d by = osg::Vec3d(1.0, 0.5, 0.0) * (0.01 * hundredths);
    parts.eye += by;
    parts.center += by;
    return parts;
}

/// The camera turns by so many degrees.
SceneParts turning(double angle) {
    SceneParts parts = creeping(0.0);
    const osg::Quat turn(osg::DegreesToRadians(angle), osg::Z_AXIS);
    parts.center = parts.eye + turn * (parts.center - parts.eye);
    return parts;
}

/// A tower this far up-sun, of which only the shadow is seen.
SceneParts towerUpSun(double distance) {
    SceneParts parts = onGround(1500.0);
    const double height = distance * std::tan(osg::DegreesToRadians(20.0));
    parts.add(boxAt({-distance, 0.0, 0.0}, {6.0, 6.0, height}));
    parts.add(boxAt({4.0, 5.0, 0.0}, {1.5, 1.5, 2.0}));
    parts.light = sunAt(270.0, 20.0);
    parts.radius = 10.0;
    return parts;
}

SceneParts fieldOfView(double degrees) {
    SceneParts parts = onGround(60.0);
    for (const double x : {-30.0, -8.0, -3.0, 3.0, 8.0, 30.0}) parts.add(boxAt({x, 2.0, 0.0}, {1.5, 1.5, 3.0}));
    parts.eye = {0.0, -8.0, 5.0};
    parts.center = {0.0, 0.0, 1.0};
    parts.fovy = degrees;
    return parts;
}

SceneParts fromAfar(double degrees) {
    SceneParts parts = onGround();
    parts.add(house({2.0, 0.0}, {2.0, 2.0, 3.0}, 30.0));
    const double distance = 5.0 / std::tan(osg::DegreesToRadians(degrees / 2.0));
    osg::Vec3d way(-8.0, -14.0, 9.0);
    way.normalize();
    parts.eye = parts.center + way * distance;
    parts.fovy = degrees;
    return parts;
}

/// Half of the picture's height, m.
SceneParts orthographic(double half) {
    SceneParts parts = street();
    parts.orthographic = half;
    parts.near = -500.0;
    parts.far = 500.0;
    parts.eye = {-20.0, -30.0, 30.0};
    parts.center = {0.0, 0.0, 0.0};
    return parts;
}

/// The eye this high above the ground, far from the origin.
SceneParts lowEye(double height) {
    SceneParts parts = street();
    const osg::Vec3d to(432100.25, 6400000.5, 812.0);
    parts.enclose(osg::Matrixd::translate(to));
    parts.eye = to + osg::Vec3d(0.0, -20.0, height);
    parts.center = to + osg::Vec3d(0.0, 0.0, 0.5 * height);
    return parts;
}

/// The camera walks down the street.
SceneParts walking(double metres) {
    SceneParts parts = street();
    parts.eye.y() += metres;
    parts.center.y() += metres;
    return parts;
}

/// A fence of slats this wide, and as far apart.
SceneParts fence(double width) {
    SceneParts parts = onGround();
    std::vector<Mesh> slats;
    const int count = std::min(static_cast<int>(4.0 / width), 200);
    for (int i = 0; i < count; ++i)
        slats.push_back(boxAt({(i - count / 2) * 2.0 * width, 0.0, 0.0}, {width, 0.05, 2.5}));
    parts.add(joined(slats));
    parts.light = {0.3, 1.0, 1.0, 0.0};
    parts.eye = {-3.0, -9.0, 6.0};
    parts.center = {0.0, -1.0, 0.5};
    return parts;
}

/// A lamp among posts, of which one stands this far from a seam of the cube's faces.
SceneParts lampAmongPosts(double degrees) {
    SceneParts parts = onGround();
    for (int i = 0; i < 8; ++i) {
        const double angle = osg::DegreesToRadians(45.0 * i + degrees);
        parts.add(boxAt({3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0}, {0.5, 0.5, 2.0}));
    }
    parts.light = {0.0, 0.0, 2.5, 1.0};
    parts.eye = {-6.0, -10.0, 11.0};
    parts.center = {0.0, 0.0, 0.0};
    return parts;
}

/// Casters that are drawn coarsely, as they are this many ranges away.
SceneParts coarseCasters(double ranges) {
    SceneParts parts = onGround();
    parts.truth = new osg::Group;
    parts.truth->addChild(node(square(12.0), "ground"));
    const bool coarse = ranges > 1.0;
    const double distance = osg::Vec3d(-8.0, -14.0, 9.0).length();
    for (const double x : {-2.5, 2.5}) {
        const Mesh fine = sphere({x, 0.0, 2.0}, 1.5), rough = boxAt({x, 0.0, 0.5}, {2.0, 2.0, 3.0});
        osg::ref_ptr<osg::LOD> levels = new osg::LOD;
        levels->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        levels->setCenter({0.0f, 0.0f, 1.0f});
        levels->setRadius(5.0);
        levels->addChild(node(fine), 0.0f, float(distance / ranges));
        levels->addChild(node(rough), float(distance / ranges), 1e6f);
        parts.add(levels);
        parts.truth->addChild(node(coarse ? rough : fine));
    }
    return parts;
}

/// One drawable below so many transforms.
SceneParts instances(double count) {
    SceneParts parts = onGround();
    const osg::ref_ptr<osg::Geode> shared = node(house({0.0, 0.0}, {0.3, 0.3, 0.8}, 25.0));
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < int(count); ++i) {
        const double x = 8.0 * ((i % side + 0.5) / side - 0.5), y = 8.0 * ((i / side + 0.5) / side - 0.5);
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(x, y, 0.0));
        place->addChild(shared);
        parts.add(place);
    }
    return parts;
}

/// A drawable whose program takes vertex v and normal n elsewhere, lit as by OpenGL. Drawn from buffers, as lists hold no instances.
osg::ref_ptr<osg::Node> programmed(const Mesh& mesh, const std::string& declared, const std::string& motion,
                                   const osg::BoundingBox& bounds) {
    const osg::ref_ptr<osg::Geode> result = node(mesh);
    osg::Geometry& geometry = *result->getDrawable(0)->asGeometry();
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
    geometry.setInitialBound(bounds);
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(
        osg::Shader::VERTEX,
        "#version 140\n#extension GL_ARB_compatibility : enable\n" + declared +
            "\nvoid main() { vec4 v = gl_Vertex; vec3 n = gl_Normal; " + motion +
            "\nfloat share = max(dot(normalize(gl_NormalMatrix * n), normalize(gl_LightSource[0].position.xyz)), "
            "0.0);\n"
            "gl_FrontColor = gl_FrontLightModelProduct.sceneColor + gl_FrontLightProduct[0].ambient + share * "
            "gl_FrontLightProduct[0].diffuse; gl_Position = gl_ModelViewProjectionMatrix * v; }"));
    geometry.getOrCreateStateSet()->setAttribute(program);
    geometry.getStateSet()->setName(movingState);
    return result;
}

/// So many columns by one drawable: its program tells where each stands.
SceneParts instancesByProgram(double count) {
    SceneParts parts = onGround();
    parts.truth = new osg::Group;
    parts.truth->addChild(node(square(12.0), "ground"));
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    const Mesh column = house({0.0, 0.0}, {0.3, 0.3, 0.8}, 25.0);
    const osg::ref_ptr<osg::Node> drawn =
        programmed(column, "uniform int side;",
                   "int row = gl_InstanceID / side; vec2 place = vec2(gl_InstanceID - row * side, row) + vec2(0.5);\n"
                   "v.xy += 8.0 * (place / float(side) - 0.5);",
                   osg::BoundingBox(-4.5f, -4.5f, 0.0f, 4.5f, 4.5f, 1.0f));
    osg::Geometry& geometry = *drawn->asGroup()->getChild(0)->asGeometry();
    geometry.getPrimitiveSet(0)->setNumInstances(int(count));
    geometry.getStateSet()->addUniform(new osg::Uniform("side", side));
    parts.add(drawn);
    for (int i = 0; i < int(count); ++i)
        parts.truth->addChild(
            node(moved(column, 8.0 * dvec3((i % side + 0.5) / side - 0.5, (i / side + 0.5) / side - 0.5, 0.0))));
    return parts;
}

/// Two trunks that two bones bend, by weights that grow with the height.
SceneParts skinned(double degrees) {
    SceneParts parts = onGround();
    parts.truth = new osg::Group;
    parts.truth->addChild(node(square(12.0), "ground"));
    const glm::dmat4 bone = glm::rotate(glm::translate(glm::dmat4(1.0), dvec3(0.0, 0.0, 1.5)), glm::radians(degrees),
                                        dvec3(0.6, 0.8, 0.0)) *
                            glm::translate(glm::dmat4(1.0), dvec3(0.0, 0.0, -1.5));
    for (const double x : {-2.0, 2.0}) {
        Mesh trunk;
        for (int ring = 0; ring < 12; ++ring) {
            const Mesh part = boxAt({0.0, 0.0, 0.25 * ring}, {0.7, 0.7, 0.25});
            trunk.insert(trunk.end(), part.begin(), part.end());
        }
        const osg::ref_ptr<osg::Node> drawn =
            programmed(trunk, "uniform mat4 bones[2];",
                       "float weight = clamp(gl_Vertex.z - 1.0, 0.0, 1.0);\n"
                       "v = (1.0 - weight) * (bones[0] * gl_Vertex) + weight * (bones[1] * gl_Vertex);\n"
                       "n = (1.0 - weight) * gl_Normal + weight * (mat3(bones[1]) * gl_Normal);",
                       osg::BoundingBox(-3.5f, -3.5f, -1.0f, 3.5f, 3.5f, 3.5f));
        const osg::ref_ptr<osg::Uniform> bones = new osg::Uniform(osg::Uniform::FLOAT_MAT4, "bones", 2);
        bones->setElement(0, osg::Matrixf());
        bones->setElement(1, osg::Matrixf(toOsg(bone)));
        drawn->asGroup()->getChild(0)->getStateSet()->addUniform(bones);
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(x, 0.0, 0.0));
        place->addChild(drawn);
        parts.add(place);
        for (dvec3& corner : trunk) {
            const double weight = std::clamp(corner.z - 1.0, 0.0, 1.0);
            corner = (1.0 - weight) * corner + weight * dvec3(bone * glm::dvec4(corner, 1.0)) + dvec3(x, 0.0, 0.0);
        }
        parts.truth->addChild(node(trunk));
    }
    return parts;
}

} // namespace

std::vector<StabilityScene> mapScenes() {
    Section section("maps");
    section.add("S1", "Acne", "Surfaces that the light meets at a flat angle must not shadow themselves.",
                "sun's elevation", "°", {75.0, 45.0, 25.0, 15.0, 10.0, 7.0, 5.0}, lit);
    section.add("S2", "Kerb", "A low step keeps its shadow: a bias that is too large takes it away.", "height", "m",
                {1.0, 0.5, 0.2, 0.1, 0.05}, kerb);
    section.add("S3", "Closed room", "No light leaks through walls, thin as they may be.", "thickness of the walls",
                "m", {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001}, closedRoom);
    section.add("S4", "Looking into the sun", "With light and view face to face no warp of the map helps.",
                "from the sun behind", "°", {0.0, 45.0, 90.0, 135.0, 165.0, 175.0, 180.0}, facingSun);
    section.add("S5", "Creeping camera", "Edges stand still while the camera goes on by fractions of a texel.", "way",
                "cm", {0.0, 0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.4, 2.7, 3.0, 3.3}, creeping);
    section.add("S5T", "Turning camera", "Edges stand still while the camera turns.", "turned by", "°",
                {0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55}, turning);
    section.add("S6", "Caster far up-sun", "A caster outside of the view casts into it.", "distance", "m",
                {10.0, 30.0, 100.0, 200.0, 400.0, 800.0, 1400.0}, towerUpSun);
    section.add("S7", "Wide view", "A wide view stretches what a map has to cover.", "field of view", "°",
                {40.0, 80.0, 110.0, 140.0, 160.0, 170.0}, fieldOfView);
    section.add("S7N", "Narrow view", "A telescope shows a few metres of a scene from afar.", "field of view", "°",
                {30.0, 10.0, 3.0, 1.0, 0.3, 0.1}, fromAfar);
    section.add("S7O", "Orthographic view", "A camera without perspective sees from behind its eye.",
                "half of the picture's height", "m", {10.0, 20.0, 40.0, 80.0}, orthographic);
    section.add("S8", "Eye close to the ground, far from the origin",
                "The map must cover the first metres of the view.", "eye's height", "m", {20.0, 8.0, 3.0, 1.5, 0.7},
                lowEye);
    section.add("S9", "Walk over seams of cascades", "No seam is seen between one map and the next.", "way", "m",
                {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0}, walking);
    section.add("S10", "Thin slats", "Slats thinner than a texel still cast.", "width", "m", {0.5, 0.3, 0.2, 0.1, 0.05},
                fence);
    section.add("S11", "Lamp among posts", "A shadow runs on over the seams of a lamp's six maps.", "turn of the posts",
                "°", {0.0, 7.5, 15.0, 22.5, 30.0, 37.5}, lampAmongPosts);
    section.add("S12", "Casters with levels of detail", "The level that is drawn is the level that casts.", "distance",
                "switching ranges", {0.5, 0.9, 1.1, 2.0, 5.0}, coarseCasters);
    section.add("S13", "Shared subgraphs", "One drawable under many parents casts at each of its places.", "places", "",
                {1.0, 4.0, 16.0, 64.0, 256.0}, instances);
    section.add("S14", "Instances", "What a program draws in many places casts at each of them.", "places", "",
                {1.0, 4.0, 16.0, 64.0, 256.0}, instancesByProgram);
    section.add("S15", "Skinned bodies", "The shadow bends with the body that a program bends.", "bend", "°",
                {0.0, 15.0, 30.0, 60.0, 90.0}, skinned);
    return section.scenes();
}

} // namespace gnomon::examples
