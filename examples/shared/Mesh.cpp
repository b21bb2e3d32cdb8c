// SPDX-License-Identifier: MIT
#include "Mesh.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/LightModel>
#include <osg/Material>

#include <cmath>
#include <utility>

namespace gnomon::examples {
namespace {

osg::Vec3 toFloat(const glm::dvec3& v) { return osg::Vec3(osg::Vec3d(v.x, v.y, v.z)); }

glm::dvec3 onSphere(const glm::dvec3& centre, double radius, int slice, int stack, int slices) {
    const double around = glm::two_pi<double>() * slice / slices;
    const double down = glm::pi<double>() * stack / (slices / 2);
    return centre +
           radius * glm::dvec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around), std::cos(down));
}

} // namespace

Mesh quad(const glm::dvec3& corner, const glm::dvec3& side, const glm::dvec3& up) {
    return {corner, corner + side, corner + side + up, corner, corner + side + up, corner + up};
}

Mesh square(double half, double height) {
    return quad({-half, -half, height}, {2.0 * half, 0.0, 0.0}, {0.0, 2.0 * half, 0.0});
}

Mesh box(const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 size = high - low;
    const glm::dvec3 x(size.x, 0.0, 0.0), y(0.0, size.y, 0.0), z(0.0, 0.0, size.z);
    return joined({quad(low, y, x), quad(low + z, x, y), quad(low, x, z), quad(low + y, z, x), quad(low, z, y),
                   quad(low + x, y, z)});
}

Mesh house(const glm::dvec2& centre, const glm::dvec3& size, double degrees) {
    const double angle = glm::radians(degrees);
    Mesh mesh = box({-size.x / 2.0, -size.y / 2.0, 0.0}, {size.x / 2.0, size.y / 2.0, size.z});
    for (glm::dvec3& v : mesh)
        v = {centre.x + v.x * std::cos(angle) - v.y * std::sin(angle),
             centre.y + v.x * std::sin(angle) + v.y * std::cos(angle), v.z};
    return mesh;
}

Mesh sphere(const glm::dvec3& centre, double radius, int slices) {
    Mesh mesh;
    for (int stack = 0; stack < slices / 2; ++stack)
        for (int slice = 0; slice < slices; ++slice) {
            const auto corner = [&](int right, int below) {
                return onSphere(centre, radius, slice + right, stack + below, slices);
            };
            if (stack > 0) mesh.insert(mesh.end(), {corner(0, 0), corner(0, 1), corner(1, 0)});
            if (stack + 1 < slices / 2) mesh.insert(mesh.end(), {corner(1, 0), corner(0, 1), corner(1, 1)});
        }
    return mesh;
}

/// The corners of three golden rectangles; a face is where three of them are as near to each other as can be.
Mesh icosahedron(double radius) {
    const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
    Mesh corners, mesh;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-golden, golden}) corners.insert(corners.end(), {{0.0, a, b}, {a, b, 0.0}, {b, 0.0, a}});
    const auto edge = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 2.1; };
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = i + 1; j < 12; ++j)
            for (std::size_t k = j + 1; k < 12; ++k) {
                glm::dvec3 a = corners[i], b = corners[j], c = corners[k];
                if (!edge(a, b) || !edge(b, c) || !edge(a, c)) continue;
                if (glm::dot(glm::cross(b - a, c - a), a) < 0.0) std::swap(b, c);
                for (const glm::dvec3& corner : {a, b, c})
                    mesh.push_back(corner * (radius / std::sqrt(1.0 + golden * golden)));
            }
    return mesh;
}

Mesh joined(std::vector<Mesh> parts) {
    Mesh all;
    for (const Mesh& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

Mesh moved(Mesh mesh, const glm::dvec3& by) {
    for (glm::dvec3& v : mesh) v += by;
    return mesh;
}

Mesh insideOut(Mesh mesh) {
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) std::swap(mesh[i], mesh[i + 1]);
    return mesh;
}

std::vector<Mesh> town(int side) {
    std::vector<Mesh> houses;
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec2 place(5.0 * (i % side - side / 2) + 2.5, 5.0 * (i / side - side / 2) + 2.5);
        const int variety = (i * 7919) % 97; // sizes and turns that do not repeat along rows
        houses.push_back(
            house(place, {1.5 + variety % 5 * 0.3, 1.5 + variety % 7 * 0.2, 1.0 + variety % 11 * 0.3}, variety * 3.7));
    }
    return houses;
}

osg::ref_ptr<osg::Geode> node(const Mesh& mesh, const std::string& name) {
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array, normals = new osg::Vec3Array;
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
        const osg::Vec3 normal = toFloat(glm::normalize(glm::cross(mesh[i + 1] - mesh[i], mesh[i + 2] - mesh[i])));
        for (std::size_t corner = i; corner < i + 3; ++corner) {
            corners->push_back(toFloat(mesh[corner]));
            normals->push_back(normal);
        }
    }
    osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array;
    white->push_back({1.0f, 1.0f, 1.0f, 1.0f});
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(corners);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->setColorArray(white, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners->size())));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(name);
    geode->addDrawable(geometry);
    return geode;
}

namespace {

osg::ref_ptr<osg::Material> matt(const osg::Vec4& color) {
    constexpr auto both = osg::Material::FRONT_AND_BACK;
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(both, color);
    material->setDiffuse(both, color);
    material->setSpecular(both, osg::Vec4(0, 0, 0, 1));
    return material;
}

} // namespace

osg::ref_ptr<osg::Node> painted(osg::ref_ptr<osg::Node> node, const osg::Vec4& color) {
    node->getOrCreateStateSet()->setAttributeAndModes(matt(color));
    return node;
}

/// Lit by nothing but what it sends out itself, whatever colours its vertices have.
osg::ref_ptr<osg::Node> paintedUnlit(osg::ref_ptr<osg::Node> node, const osg::Vec4& color) {
    osg::ref_ptr<osg::Material> material = matt(osg::Vec4(0, 0, 0, 1));
    material->setEmission(osg::Material::FRONT_AND_BACK, color);
    node->getOrCreateStateSet()->setAttributeAndModes(material);
    return node;
}

osg::ref_ptr<osg::Texture2D> drawnTexture(int size, const std::function<osg::Vec3(int, int)>& color) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(size, size, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            image->setColor(osg::Vec4(color(column, row), 1.0f), static_cast<unsigned>(column),
                            static_cast<unsigned>(row));
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(side, osg::Texture::REPEAT);
    for (const auto use : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(use, osg::Texture::NEAREST);
    return texture;
}

osg::ref_ptr<osg::Node> texturedQuad(const osg::Vec3d& corner, const osg::Vec3d& side, const osg::Vec3d& up,
                                     double repeats) {
    const auto last = static_cast<float>(repeats);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(corner), osg::Vec3(side), osg::Vec3(up), last, last));
    return geode;
}

osg::ref_ptr<osg::LightSource> addLight(osg::Group& root, const osg::Vec4d& place) {
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light& light = *source->getLight();
    light.setPosition(osg::Vec4(place));
    light.setAmbient(osg::Vec4(0, 0, 0, 1));
    light.setDiffuse(osg::Vec4(1, 1, 1, 1));
    light.setSpecular(osg::Vec4(0, 0, 0, 1));
    root.addChild(source);
    osg::StateSet& set = *root.getOrCreateStateSet();
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(osg::Vec4(0.2f, 0.2f, 0.2f, 1.0f));
    set.setAttributeAndModes(model);
    for (const GLenum mode : {GLenum(GL_LIGHTING), GLenum(GL_LIGHT0), GLenum(GL_NORMALIZE)})
        set.setMode(mode, osg::StateAttribute::ON);
    return source;
}

} // namespace gnomon::examples
