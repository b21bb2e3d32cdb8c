// SPDX-License-Identifier: MIT
// Meshes as they come, and where the eye is among shadows.
#include "SceneParts.h"

#include <osg/Geometry>

#include <cmath>
#include <cstdint>
#include <random>

namespace gnomon::examples {
namespace {

/// The same on every machine.
bool drawn(std::mt19937& random, double share) { return double(std::uint32_t(random())) < share * 4294967296.0; }

Mesh withoutSome(const Mesh& mesh, double share) {
    std::mt19937 random(7);
    Mesh kept;
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3)
        if (!drawn(random, share)) kept.insert(kept.end(), mesh.begin() + long(i), mesh.begin() + long(i) + 3);
    return kept;
}

Mesh withSomeTurned(Mesh mesh, double share) {
    std::mt19937 random(11);
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3)
        if (drawn(random, share)) std::swap(mesh[i], mesh[i + 1]);
    return mesh;
}

SceneParts twoOf(Mesh (*spoil)(const Mesh&, double), double share) {
    SceneParts parts = onGround();
    parts.add(spoil(sphere({-2.0, 0.0, 2.0}, 1.5, 24), share));
    parts.add(spoil(house({2.5, 0.0}, {2.0, 2.0, 3.0}, 30.0), share));
    return parts;
}

SceneParts open(double share) { return twoOf(withoutSome, share); }
SceneParts turned(double share) {
    return twoOf([](const Mesh& mesh, double s) { return withSomeTurned(mesh, s); }, share);
}

/// The eye goes into the shadow of a tower, down to the ground.
SceneParts eyeInShadow(double way) {
    SceneParts parts = onGround(30.0);
    parts.add(boxAt({-4.0, 0.0, 0.0}, {2.0, 4.0, 8.0}));
    for (const double x : {1.0, 4.0, 7.0}) parts.add(boxAt({x, 2.8, 0.0}, {0.6, 0.6, 1.5}));
    parts.light = {-1.0, 0.0, 1.0, 0.0};
    parts.eye = osg::Vec3d(2.0, -12.0, 6.0) * (1.0 - way) + osg::Vec3d(-1.5, -0.5, 1.0) * way;
    parts.center = {4.0, 2.0, 0.3};
    parts.fovy = 55.0;
    parts.radius = 8.0;
    return parts;
}

/// The camera looks along the sun's rays, from behind the caster or from before it.
SceneParts alongRays(double degrees) {
    SceneParts parts = onGround();
    parts.add(sphere({0.0, 0.0, 2.5}, 1.2, 48));
    parts.add(boxAt({2.0, 2.0, 0.0}, {1.0, 1.0, 2.0}));
    const double angle = osg::DegreesToRadians(degrees);
    parts.light = {-1.0, 0.0, 1.0, 0.0};
    parts.eye = osg::Vec3d(-std::cos(angle), std::sin(angle), 1.0) * 11.0;
    return parts;
}

/// So many spheres, each about the next smaller one.
SceneParts shells(double count) {
    SceneParts parts = onGround();
    for (int i = 0; i < int(count); ++i) parts.add(sphere({0.0, 0.0, 2.5}, 2.0 * (i + 1) / count, 12));
    return parts;
}

SceneParts fine(double slices) {
    SceneParts parts = onGround();
    parts.add(sphere({0.0, 0.0, 2.2}, 2.0, int(slices)));
    return parts;
}

/// A sphere of so many slices, shaded as if it were round, alone. The terminator goes through the middle of the picture.
SceneParts roundBody(double slices) {
    SceneParts parts;
    const osg::ref_ptr<osg::Geode> body = node(sphere({0.0, 0.0, 0.0}, 2.0, int(slices)), "body");
    osg::Geometry& geometry = *body->getDrawable(0)->asGeometry();
    osg::ref_ptr<osg::Vec3Array> normals =
        new osg::Vec3Array(static_cast<const osg::Vec3Array&>(*geometry.getVertexArray()), osg::CopyOp());
    for (osg::Vec3& normal : *normals) normal.normalize();
    geometry.setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    parts.add(body);
    parts.round = "body";
    parts.light = {0.5, -0.4, 0.7, 0.0};
    parts.eye = {-10.0, -6.0, 4.0};
    parts.center = {0.0, 0.0, 0.0};
    parts.fovy = 24.0;
    parts.radius = 2.0;
    return parts;
}

/// So many towers under a low sun.
SceneParts towers(double count) {
    SceneParts parts = onGround(60.0);
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < int(count); ++i)
        parts.add(boxAt({50.0 * ((i % side + 0.5) / side - 0.5), 50.0 * ((i / side + 0.5) / side - 0.5), 0.0},
                        {1.0, 1.0, 8.0}));
    parts.light = sunAt(110.0, 15.0);
    parts.eye = {-30.0, -50.0, 40.0};
    parts.center = {0.0, 0.0, 0.0};
    parts.radius = 30.0;
    return parts;
}

/// A sheet without thickness, as a flag is, at this angle to the light's rays.
SceneParts sheet(double degrees) {
    SceneParts parts = onGround();
    const double angle = osg::DegreesToRadians(degrees);
    parts.add(quad({-2.0, 0.0, 0.5}, {4.0 * std::cos(angle), 4.0 * std::sin(angle), 0.0}, {0.0, 0.0, 2.5}));
    parts.light = {-1.0, 0.0, 0.9, 0.0};
    parts.eye = {3.0, -14.0, 9.0};
    return parts;
}

} // namespace

std::vector<StabilityScene> meshScenes() {
    Section section("meshes and volumes");
    section.add("V1", "Open meshes", "A mesh with holes casts the shadow of what is there.", "missing triangles",
                "share", {0.0, 0.05, 0.1, 0.3, 0.6, 0.9}, open);
    section.add("V1W", "Inconsistent winding", "A triangle casts whichever way round its corners go.",
                "turned triangles", "share", {0.0, 0.02, 0.1, 0.3, 0.5}, turned);
    section.add("V2", "Eye in the shadow", "An eye or a near plane inside of a shadow inverts nothing.",
                "way into the shadow", "", {0.0, 0.5, 0.8, 0.95, 1.0}, eyeInShadow);
    section.add("V3", "Along the rays", "Seen along its rays a shadow closes over its far end.",
                "from behind the caster", "°", {90.0, 45.0, 10.0, 1.0, 0.0, 180.0}, alongRays);
    section.add("V4", "Nested shells", "More layers than a stencil buffer counts are still layers.", "shells", "",
                {1.0, 10.0, 50.0, 120.0, 254.0, 300.0}, shells);
    section.add("V5", "Fine meshes", "No light shines through between two triangles.", "slices of a sphere", "",
                {12.0, 32.0, 96.0, 200.0}, fine);
    section.add("V6", "Many towers, low sun", "Shadows that overlap and cross half of the scene.", "towers", "",
                {1.0, 9.0, 25.0, 100.0, 225.0}, towers);
    section.add("V7", "Sheet edge-on", "A sheet without thickness casts less and less as it turns along the rays.",
                "angle to the rays", "°", {90.0, 45.0, 15.0, 5.0, 1.0, 0.0}, sheet);
    section.add("V8", "Round body of few facets", "A convex body is as bright as without shadows.",
                "slices of a sphere", "", {200.0, 96.0, 48.0, 24.0, 16.0, 12.0, 8.0}, roundBody);
    return section.scenes();
}

} // namespace gnomon::examples
