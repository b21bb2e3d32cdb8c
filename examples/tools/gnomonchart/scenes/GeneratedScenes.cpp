// SPDX-License-Identifier: MIT
#include "GeneratedScenes.h"
#include "Mesh.h"

#include <osg/Geometry>

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr double townHalf = 55.0, mountainsHalf = 5000.0; // metres
constexpr int housesASide = 20;

/// Metres.
double hillHeight(double x, double y) {
    return 5.0 * std::sin(0.04 * x) * std::cos(0.045 * y) + std::sin(0.13 * x + 0.09 * y);
}

/// Five octaves of ridges in turned directions, metres.
double mountainHeight(double x, double y) {
    double height = 0.0, amplitude = 260.0, wave = 2.0 * osg::PI / 4200.0;
    for (int octave = 0; octave < 5; ++octave) {
        const double angle = 0.5 + 1.3 * octave;
        const double along = x * std::cos(angle) + y * std::sin(angle),
                     across = y * std::cos(angle) - x * std::sin(angle);
        height += amplitude * std::sin(wave * along + octave) * std::cos(0.7 * wave * across + 2.0 * octave);
        amplitude /= 2.6;
        wave *= 2.0;
    }
    return height;
}

osg::Vec3 normalOf(double (*height)(double, double), double x, double y, double step) {
    osg::Vec3d normal(height(x - step, y) - height(x + step, y), height(x, y - step) - height(x, y + step), 2.0 * step);
    normal.normalize();
    return osg::Vec3(normal);
}

osg::ref_ptr<osg::DrawElementsUInt> gridTriangles(unsigned side) {
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned j = 0; j < side; ++j)
        for (unsigned i = 0; i < side; ++i) {
            const unsigned a = j * (side + 1) + i, c = a + side + 1;
            for (const unsigned corner : {a, a + 1, c + 1, a, c + 1, c}) triangles->push_back(corner);
        }
    return triangles;
}

/// A height field of `side` × `side` cells as one drawable with smooth normals.
osg::ref_ptr<osg::Geode> landscape(double (*height)(double, double), double half, unsigned side) {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    const double step = 2.0 * half / side;
    for (unsigned j = 0; j <= side; ++j)
        for (unsigned i = 0; i <= side; ++i) {
            const double x = i * step - half, y = j * step - half;
            vertices->push_back(osg::Vec3d(x, y, height(x, y)));
            normals->push_back(normalOf(height, x, y, step));
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals);
    geometry->addPrimitiveSet(gridTriangles(side));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

/// Down to where its whole footprint is in the ground, and as much higher, so that it stands as far out.
Mesh dugIn(Mesh house) {
    double low = 1e9;
    for (const glm::dvec3& v : house) low = std::min(low, hillHeight(v.x, v.y));
    for (glm::dvec3& v : house) v.z += v.z > 0.0 ? hillHeight(v.x, v.y) : low - 0.5;
    double roof = -1e9;
    for (const glm::dvec3& v : house) roof = std::max(roof, v.z);
    for (glm::dvec3& v : house)
        if (v.z > low) v.z = roof;
    return house;
}

void add(osg::Group& group, const Mesh& mesh, const std::string& name = "") { group.addChild(node(mesh, name)); }

/// On four legs. @param top  height of its upper side.
Mesh table(const glm::dvec2& low, const glm::dvec2& high, double top, double thickness, double leg) {
    std::vector<Mesh> parts{box({low, top - thickness}, {high, top})};
    for (const double x : {low.x, high.x - leg})
        for (const double y : {low.y, high.y - leg})
            parts.push_back(box({x, y, 0.0}, {x + leg, y + leg, top - thickness}));
    return joined(parts);
}

Mesh chair(const glm::dvec2& at) {
    return joined(
        {table(at, at + glm::dvec2(0.45), 0.46, 0.04, 0.04), box({at, 0.46}, {at.x + 0.04, at.y + 0.45, 0.95})});
}

} // namespace

osg::ref_ptr<osg::Group> flatTown() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    add(*group, square(townHalf), "ground");
    for (const Mesh& house : town(housesASide)) add(*group, house);
    return group;
}

osg::ref_ptr<osg::Group> hillyTown() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(landscape(hillHeight, townHalf, 110));
    group->getChild(0)->setName("terrain");
    for (const Mesh& house : town(housesASide)) add(*group, dugIn(house));
    return group;
}

osg::ref_ptr<osg::Group> mountains() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(landscape(mountainHeight, mountainsHalf, 250));
    return group;
}

osg::ref_ptr<osg::Group> furnishedRoom() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    add(*group, quad({-3.0, -2.5, 0.0}, {6.0, 0.0, 0.0}, {0.0, 5.0, 0.0}), "ground");
    const Mesh room = insideOut(box({-3.0, -2.5, 0.0}, {3.0, 2.5, 2.8}));
    add(*group, Mesh(room.begin() + 6, room.end()), "walls"); // without its floor, which box() gives first
    add(*group, table({0.6, -0.4}, {2.0, 0.5}, 0.75, 0.05, 0.06));
    add(*group, chair({0.2, -0.2}));
    add(*group, chair({1.0, 0.8}));
    add(*group, box({-0.6, 2.0, 0.0}, {0.6, 2.5, 1.9}), "cupboard");
    add(*group, box({2.6, -1.2, 1.5}, {3.0, 0.8, 1.55}), "shelf");
    return group;
}

} // namespace gnomon::examples
