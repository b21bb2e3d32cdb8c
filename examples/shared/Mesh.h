// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <osg/Geode>
#include <osg/LightSource>
#include <osg/Node>
#include <osg/Texture2D>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Plain triangles, three corners each, counter-clockwise from outside: what generated scenes are made of and what a
/// test's oracle sees.
using Mesh = std::vector<glm::dvec3>;

Mesh quad(const glm::dvec3& corner, const glm::dvec3& side, const glm::dvec3& up);
Mesh square(double half, double height = 0.0);
Mesh box(const glm::dvec3& low, const glm::dvec3& high);
/// Box on the ground, turned about the vertical by `degrees`.
Mesh house(const glm::dvec2& centre, const glm::dvec3& size, double degrees);
Mesh sphere(const glm::dvec3& centre, double radius, int slices = 48);
/// About the origin. @param radius  of its corners.
Mesh icosahedron(double radius);
Mesh joined(std::vector<Mesh> parts);
Mesh moved(Mesh mesh, const glm::dvec3& by);
/// Seen from inside: the corners go round the other way.
Mesh insideOut(Mesh mesh);
/// `side` × `side` houses of various sizes and turns on a grid of pitch 5.
std::vector<Mesh> town(int side);

/// The mesh as a node: one osg::Geometry of white triangles with facet normals, corners as floats.
osg::ref_ptr<osg::Geode> node(const Mesh& mesh, const std::string& name = "");

/// Gives a node a matt colour, lit or not, and returns it.
osg::ref_ptr<osg::Node> painted(osg::ref_ptr<osg::Node> node, const osg::Vec4& color);
osg::ref_ptr<osg::Node> paintedUnlit(osg::ref_ptr<osg::Node> node, const osg::Vec4& color);

/// A texture of size × size texels, repeated, nearest texel. @param color  of column, row; from the lower left.
osg::ref_ptr<osg::Texture2D> drawnTexture(int size, const std::function<osg::Vec3(int column, int row)>& color);

/// A parallelogram with texture coordinates 0 … repeats along both sides, normal side × up.
osg::ref_ptr<osg::Node> texturedQuad(const osg::Vec3d& corner, const osg::Vec3d& side, const osg::Vec3d& up,
                                     double repeats = 1.0);

/// Light 0, white without specular light, on below `root`, where normals are kept at length 1; the scene's ambient light
/// is 0.2, OpenGL's own.
osg::ref_ptr<osg::LightSource> addLight(osg::Group& root, const osg::Vec4d& place);

} // namespace gnomon::examples
