// SPDX-License-Identifier: MIT
#include "TracedLamps.h"

#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/TriangleIndexFunctor>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::testing {
namespace {

constexpr int texels = 508; // of a beam, a side

struct Triangles {
    std::vector<unsigned> indices;
    void operator()(unsigned a, unsigned b, unsigned c) { indices.insert(indices.end(), {a, b, c}); }
};

osg::Vec3d rgb(const osg::Vec4& color) { return {color.r(), color.g(), color.b()}; }
osg::Vec3d product(const osg::Vec3d& a, const osg::Vec3d& b) { return osg::componentMultiply(a, b); }
osg::Vec3d unit(osg::Vec3d v) {
    v.normalize();
    return v;
}
osg::Vec3d clamped(const osg::Vec3d& c) { return {std::min(c.x(), 1.0), std::min(c.y(), 1.0), std::min(c.z(), 1.0)}; }
osg::Vec3d rounded(const osg::Vec3d& c) {
    return {std::round(c.x() * 255.0), std::round(c.y() * 255.0), std::round(c.z() * 255.0)};
}

osg::Matrixd clipFrom(const osg::Vec3d& place, double aspect, double turned = 0.0) {
    return osg::Matrixd::lookAt(place, osg::Vec3d(), osg::Vec3d(0, 1, 0)) *
           osg::Matrixd::rotate(osg::DegreesToRadians(turned), osg::Y_AXIS) *
           osg::Matrixd::perspective(40.0, aspect, 0.1, 10.0);
}

glm::dvec3 toGlm(const osg::Vec3d& v) { return {v.x(), v.y(), v.z()}; }
osg::Vec3d toOsg(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// How far along a way the plane of what is seen lies.
double toPlane(const osg::Vec3d& place, const osg::Vec3d& normal, const osg::Vec3d& from, const osg::Vec3d& way) {
    return (normal * (place - from)) / (normal * way);
}

} // namespace

osg::Vec3d onOrbit(double elevation, double azimuth, double distance) {
    const double e = osg::DegreesToRadians(elevation), a = osg::DegreesToRadians(azimuth);
    return osg::Vec3d(-std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)) * distance;
}

TracedScene::TracedScene(const std::string& file, double radius, const osg::Vec3d& eye, const Size& size)
    : _eye(eye), _size(size), _worldFromClip(osg::Matrixd::inverse(clipFrom(eye, double(size.width) / size.height))) {
    read(file, radius);
    std::vector<glm::vec3> vertices;
    std::vector<unsigned> indices;
    for (const Corner& corner : _corners) {
        indices.push_back(static_cast<unsigned>(vertices.size()));
        vertices.emplace_back(toGlm(corner.place));
    }
    _rays = std::make_unique<RayScene>(TriangleSoup{vertices.data(), vertices.size(), indices.data(), indices.size()});
}

void TracedScene::read(const std::string& file, double radius) {
    const osg::ref_ptr<osg::Group> scene = dynamic_cast<osg::Group*>(osgDB::readRefNodeFile(file).get());
    if (!scene) throw std::runtime_error("no scene " + file);
    osg::BoundingBoxd box;
    for (unsigned i = 0; i < scene->getNumChildren(); ++i) {
        const osg::Geometry& geometry = *scene->getChild(i)->asGeode()->getDrawable(0)->asGeometry();
        const auto& places = dynamic_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
        const auto& normals = dynamic_cast<const osg::Vec3Array&>(*geometry.getNormalArray());
        const auto& paint =
            dynamic_cast<const osg::Material&>(*geometry.getStateSet()->getAttribute(osg::StateAttribute::MATERIAL));
        osg::TriangleIndexFunctor<Triangles> triangles;
        geometry.accept(triangles);
        for (const unsigned v : triangles.indices) {
            _corners.push_back({osg::Vec3d(places[v]), unit(osg::Vec3d(normals[v])), _materials.size()});
            box.expandBy(osg::Vec3d(places[v]));
        }
        constexpr auto front = osg::Material::FRONT;
        _materials.push_back({rgb(paint.getDiffuse(front)), rgb(paint.getSpecular(front)), paint.getShininess(front)});
    }
    for (Corner& corner : _corners) corner.place = (corner.place - box.center()) * (radius / box.radius());
}

std::optional<TracedScene::Seen> TracedScene::see(double x, double y) const {
    const osg::Vec3d end = osg::Vec3d(2.0 * x / _size.width - 1.0, 2.0 * y / _size.height - 1.0, 1.0) * _worldFromClip;
    const RayHit hit = _rays->closest(Ray{toGlm(_eye), toGlm(end - _eye)});
    if (!hit) return std::nullopt;
    Seen seen;
    seen.place = _eye + (end - _eye) * hit.distance;
    seen.normal = toOsg(hit.normal);
    if (seen.normal * (_eye - seen.place) < 0.0) seen.normal = -seen.normal;
    for (std::size_t i = 0; i < 3; ++i) seen.corners[i] = &_corners[3 * hit.triangle + i];
    const osg::Vec3d &a = seen.corners[0]->place, &b = seen.corners[1]->place, &c = seen.corners[2]->place;
    const osg::Vec3d all = (b - a) ^ (c - a);
    const double v = (((seen.place - a) ^ (c - a)) * all) / all.length2();
    const double w = (((b - a) ^ (seen.place - a)) * all) / all.length2();
    seen.weights = {1.0 - v - w, v, w};
    return seen;
}

/// OpenGL's lighting of a vertex, the viewer far away, without its limit of 1.
osg::Vec3d TracedScene::lit(const Corner& corner, const TracedLamp& lamp, bool ambientOnly) const {
    const Material& m = _materials[corner.material];
    osg::Vec3d sum = m.diffuse * lamp.ambient; // the materials' ambient colour is their diffuse one
    const osg::Vec3d way = unit(lamp.place - corner.place);
    const double facing = corner.normal * way;
    if (ambientOnly || !(facing > 0.0)) return sum;
    sum += product(m.diffuse, lamp.color) * facing;
    const double shine = std::max(0.0, corner.normal * unit(way + unit(_eye)));
    return sum + product(m.specular, lamp.color) * std::pow(shine, m.shininess);
}

/// Between the vertices, by all lights at once. @param ambientOnly  a light each.
osg::Vec3d TracedScene::lit(const Seen& seen, const std::vector<TracedLamp>& lamps,
                            const std::vector<bool>& ambientOnly) const {
    osg::Vec3d result;
    for (std::size_t i = 0; i < 3; ++i) {
        osg::Vec3d sum;
        for (std::size_t k = 0; k < lamps.size(); ++k) sum += lit(*seen.corners[i], lamps[k], ambientOnly[k]);
        result += clamped(sum) * seen.weights[static_cast<int>(i)];
    }
    return result;
}

bool TracedScene::standsAlone(double x, double y, const Seen& seen, const TracedLamp& lamp) const {
    const osg::Vec3d here = lit(seen, {lamp}, {false});
    for (const double d : {-0.02, 0.02})
        for (const auto& other : {see(x + d, y), see(x, y + d)})
            if (!other || (lit(*other, {lamp}, {false}) - here).length() > 0.3 / 255.0) return false;
    return true;
}

bool TracedScene::goesOn(double x, double y, const Seen& seen) const {
    for (const double d : {-1.0, 1.0})
        for (const auto& other : {see(x + d, y), see(x, y + d)})
            if (!other || std::abs(seen.normal * (other->place - seen.place)) > 0.01) return false;
    return true;
}

std::optional<TracedScene::Arrival> TracedScene::arrival(const Seen& seen, const TracedLamp& lamp) const {
    constexpr double still = 1e-3; // between a ray's end and the surface, of rays that start 1.5 away
    constexpr double gap = 0.03;   // a surface that ends there
    const osg::Matrixd clip = clipFrom(lamp.place, 1.0, lamp.turned), world = osg::Matrixd::inverse(clip);
    const osg::Vec3d at = seen.place * clip;
    int blocked = 0, beyond = 0, inside = 0;
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const osg::Vec3d near(at.x() + 2.0 * dx / texels, at.y() + 2.0 * dy / texels, at.z());
            const osg::Vec3d way = unit(near * world - lamp.place);
            const double surface = toPlane(seen.place, seen.normal, lamp.place, way);
            const double met = _rays->closest(Ray{toGlm(lamp.place), toGlm(way)}).distance;
            blocked += met < surface - still;
            beyond += met > surface + gap;
            inside += std::max(std::abs(near.x()), std::abs(near.y())) < 1.0;
        }
    if ((blocked != 0 && blocked != 25) || (beyond != 0 && blocked == 0) || (inside != 0 && inside != 25))
        return std::nullopt;
    return Arrival{blocked == 0, inside == 25};
}

std::optional<TracedScene::Pixel> TracedScene::color(int x, int y, const std::vector<TracedLamp>& lamps,
                                                     Sum sum) const {
    const auto seen = see(x + 0.5, y + 0.5);
    if (!seen || (sum == Sum::Compositor && !goesOn(x + 0.5, y + 0.5, *seen))) return std::nullopt;
    Pixel pixel;
    std::vector<bool> ambientOnly;
    for (const TracedLamp& lamp : lamps) {
        if (!standsAlone(x + 0.5, y + 0.5, *seen, lamp)) return std::nullopt;
        const auto arrives = arrival(*seen, lamp);
        if (!arrives) return std::nullopt;
        pixel.shadows += !arrives->reaches;
        ambientOnly.push_back(!arrives->reaches);
        if (sum == Sum::Passes && arrives->reaches && arrives->inBeam)
            pixel.color += rounded(lit(*seen, {lamp}, {false}));
    }
    if (sum == Sum::Compositor) pixel.color = lit(*seen, lamps, ambientOnly) * 255.0;
    for (int i = 0; i < 3; ++i) pixel.color[i] = std::min(pixel.color[i], 255.0);
    return pixel;
}

} // namespace gnomon::testing
