// SPDX-License-Identifier: MIT
#include "SceneTriangles.h"

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Projection>
#include <osg/Transform>
#include <osg/TriangleIndexFunctor>

#include <algorithm>

namespace gnomon::examples {
namespace {

struct Collect {
    std::vector<unsigned>* into = nullptr;
    unsigned first = 0, count = 0;

    void operator()(unsigned a, unsigned b, unsigned c) const {
        if (a >= count || b >= count || c >= count) return;
        for (const unsigned corner : {a, b, c}) into->push_back(first + corner);
    }
};

template <typename Array>
bool append(const osg::Array& array, std::vector<osg::Vec3d>& into) {
    const auto* typed = dynamic_cast<const Array*>(&array);
    if (!typed) return false;
    for (const auto& v : *typed) into.emplace_back(v.x(), v.y(), v.z());
    return true;
}

template <typename Array>
bool appendFlat(const osg::Array& array, std::vector<osg::Vec3d>& into) {
    const auto* typed = dynamic_cast<const Array*>(&array);
    if (!typed) return false;
    for (const auto& v : *typed) into.emplace_back(v.x(), v.y(), 0.0);
    return true;
}

template <typename Array>
bool appendHomogeneous(const osg::Array& array, std::vector<osg::Vec3d>& into) {
    const auto* typed = dynamic_cast<const Array*>(&array);
    if (!typed) return false;
    for (const auto& v : *typed) into.push_back(osg::Vec3d(v.x(), v.y(), v.z()) / double(v.w()));
    return true;
}

std::vector<osg::Vec3d> positions(const osg::Array* array) {
    std::vector<osg::Vec3d> result;
    if (array)
        (void)(append<osg::Vec3Array>(*array, result) || append<osg::Vec3dArray>(*array, result) ||
               appendHomogeneous<osg::Vec4Array>(*array, result) ||
               appendHomogeneous<osg::Vec4dArray>(*array, result) || appendFlat<osg::Vec2Array>(*array, result) ||
               appendFlat<osg::Vec2dArray>(*array, result));
    return result;
}

class Collector : public osg::NodeVisitor {
public:
    Collector(SceneTriangles& into, Clear clear)
        : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), _into(into), _clear(clear) {}

    void apply(osg::Camera&) override {}
    void apply(osg::Projection&) override {}
    void apply(osg::Geometry& geometry) override {
        const std::vector<osg::Vec3d> local = positions(geometry.getVertexArray());
        if (local.empty() || Cutout::isUnfilled(getNodePath(), geometry)) return;
        const osg::Matrixd world = osg::computeLocalToWorld(getNodePath());
        _into.objects.push_back({Cutout::of(getNodePath(), geometry)});
        if (_clear == Clear::PASSES && !_into.objects.back().cutout)
            _into.objects.back().cutout = Cutout::blended(getNodePath(), geometry);
        addTriangles(geometry, local.size());
        for (const osg::Vec3d& v : local) _into.vertices.push_back(v * world);
        addTexcoords(dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0)));
    }

private:
    void addTriangles(const osg::Geometry& geometry, std::size_t vertices) {
        osg::TriangleIndexFunctor<Collect> collect;
        collect.into = &_into.indices;
        collect.first = static_cast<unsigned>(_into.vertices.size());
        collect.count = static_cast<unsigned>(vertices);
        geometry.accept(collect);
        _into.object.resize(_into.indices.size() / 3, static_cast<unsigned>(_into.objects.size() - 1));
    }

    void addTexcoords(const osg::Vec2Array* texcoords) {
        if (texcoords)
            for (const osg::Vec2& t : *texcoords) _into.texcoords.emplace_back(t.x(), t.y());
        _into.texcoords.resize(_into.vertices.size());
    }

    SceneTriangles& _into;
    const Clear _clear;
};

} // namespace

bool SceneTriangles::solidAt(unsigned triangle, double u, double v) const {
    const std::optional<Cutout>& cutout = objects[object[triangle]].cutout;
    if (!cutout) return true;
    const unsigned* corner = &indices[3 * std::size_t{triangle}];
    return cutout->keeps(texcoords[corner[0]] * (1.0 - u - v) + texcoords[corner[1]] * u + texcoords[corner[2]] * v);
}

bool SceneTriangles::hasCutouts() const {
    return std::any_of(objects.begin(), objects.end(), [](const Object& each) { return each.cutout.has_value(); });
}

double SceneTriangles::longestEdge(unsigned triangle) const {
    const unsigned* corner = &indices[3 * std::size_t{triangle}];
    const osg::Vec3d &a = vertices[corner[0]], &b = vertices[corner[1]], &c = vertices[corner[2]];
    return std::max({(b - a).length(), (c - b).length(), (a - c).length()});
}

SceneTriangles sceneTriangles(osg::Node& scene, Clear clear) {
    SceneTriangles result;
    Collector collector(result, clear);
    scene.accept(collector);
    return result;
}

} // namespace gnomon::examples
