// SPDX-License-Identifier: MIT
// Where the light stands.
#include "SceneParts.h"

#include <osg/Geometry>

#include <cmath>
#include <map>

namespace gnomon::examples {
namespace {

using glm::dvec3;
using osg::Vec4d;

const std::vector<double> alongWalls{15.0, -15.0, 8.0, -8.0, 4.0, -4.0, 2.0, -2.0, 1.0, -1.0, 0.0, -0.5, 0.5};

/// A house and a sphere on level ground.
SceneParts houseAndSphere() {
    SceneParts parts = onGround();
    parts.add(house({2.0, 0.0}, {2.0, 2.0, 3.0}, 30.0));
    parts.add(sphere({-2.0, 0.0, 2.5}, 1.0));
    return parts;
}

SceneParts sunAtElevation(double degrees) {
    SceneParts parts = houseAndSphere();
    parts.light = sunAt(120.0, degrees);
    return parts;
}

SceneParts lampAway(double metres) {
    SceneParts parts = houseAndSphere();
    const osg::Vec3d way(0.48, -0.36, 0.8);
    parts.light = Vec4d(parts.center + way * metres, 1.0);
    return parts;
}

/// A lamp 3 m above the ground and 3 m beside a box.
SceneParts boxBesideLamp(double heights) {
    SceneParts parts = onGround();
    parts.add(boxAt({1.5, 0.0, 0.0}, {1.5, 2.0, 3.0 * heights}));
    parts.light = {-1.5, 0.0, 3.0, 1.0};
    return parts;
}

/// Sunk by so many of its radii.
SceneParts sunkenSphere(double radii) {
    SceneParts parts = onGround();
    parts.add(sphere({0.0, 0.0, 1.5 * (1.0 - radii)}, 1.5));
    parts.light = sunAt(120.0, 35.0);
    return parts;
}

/// A frame of four posts and a lid; the lamp goes from beside it into its box.
SceneParts lampInFrame(double inside) {
    SceneParts parts = onGround();
    std::vector<Mesh> frame{boxAt({0.0, 0.0, 2.6}, {3.4, 3.4, 0.3})};
    for (const double x : {-1.6, 1.6})
        for (const double y : {-1.6, 1.6}) frame.push_back(boxAt({x, y, 0.0}, {0.2, 0.2, 2.6}));
    parts.add(joined(frame));
    parts.light = {-6.0 * (1.0 - inside) + 0.3 * inside, 0.2, 2.0, 1.0};
    return parts;
}

SceneParts lowSunOnTower(double elevation) {
    SceneParts parts = onGround(450.0);
    parts.add(boxAt({0.0, 0.0, 0.0}, {8.0, 8.0, 20.0}));
    const double length = 20.0 / std::tan(osg::DegreesToRadians(elevation));
    parts.light = sunAt(270.0, elevation);
    parts.center = {0.5 * length, 0.0, 0.0};
    parts.eye = {0.5 * length, -0.9 * length - 50.0, 0.5 * length + 40.0};
    parts.radius = 20.0;
    return parts;
}

SceneParts highSun(double tilt) {
    SceneParts parts = onGround();
    parts.add(moved(sphere({0.0, 0.0, 0.0}, 1.0), {-2.0, 0.0, 2.5}));
    parts.add(moved(house({0.0, 0.0}, {2.0, 2.0, 0.5}, 20.0), {2.0, 0.0, 2.0}));
    parts.light = {tilt * 0.6, tilt * 0.8, 1.0, 0.0};
    return parts;
}

SceneParts lightOfLength(double length) {
    SceneParts parts = houseAndSphere();
    parts.light = sunAt(120.0, 45.0) * length;
    return parts;
}

/// The lamp nears the plane of the box's right side.
SceneParts lampOverFace(double off) {
    SceneParts parts = onGround();
    parts.add(boxAt({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}));
    parts.light = {1.0 + off, -3.0, 4.0, 1.0};
    return parts;
}

/// One normal a corner, the mean of its faces', as modellers' exports have them: it takes walls that are turned away for lit ones.
osg::ref_ptr<osg::Geode> withAveragedNormals(osg::ref_ptr<osg::Geode> geode) {
    osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
    const auto& corners = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    std::map<osg::Vec3, osg::Vec3> sums;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
        osg::Vec3 normal = (corners[i + 1] - corners[i]) ^ (corners[i + 2] - corners[i]);
        normal.normalize();
        for (std::size_t k = 0; k < 3; ++k) sums[corners[i + k]] += normal;
    }
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (const osg::Vec3& corner : corners) {
        normals->push_back(sums[corner]);
        normals->back().normalize();
    }
    geometry.setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    return geode;
}

/// Houses along streets. @param degrees  by which the nearer walls are turned away from the sun; below 0: towards it.
SceneParts streets(double degrees, bool averaged) {
    SceneParts parts = onGround(30.0);
    for (int i = 0; i < 6; ++i) {
        osg::ref_ptr<osg::Geode> house =
            node(boxAt({7.0 * (i % 3) - 7.0, 9.0 * (i / 3) - 4.5, 0.0}, {5.0, 6.0, 4.0 + i % 2}));
        parts.add(averaged ? withAveragedNormals(house) : house);
    }
    const double way = osg::DegreesToRadians(degrees), rise = osg::DegreesToRadians(30.0);
    parts.light = {std::cos(way) * std::cos(rise), std::sin(way) * std::cos(rise), std::sin(rise), 0.0};
    parts.eye = {-14.0, -24.0, 13.0};
    parts.radius = 12.0;
    return parts;
}

} // namespace

std::vector<StabilityScene> lightScenes() {
    Section section("light");
    section.add("L1", "Sun in the plane", "The shadow grows without bound as the sun sets, and then there is none.",
                "sun's elevation", "°", {45.0, 10.0, 3.0, 1.0, 0.1, 1e-3, 1e-6, 0.0, -1e-6, -1e-3}, sunAtElevation);
    section.add("L2", "Sun below the plane", "A sun below the ground must darken nothing that it does not light.",
                "sun's elevation", "°", {30.0, 0.0, -1.0, -5.0, -30.0, -80.0}, sunAtElevation);
    section.add("L3", "Lamp far away", "A lamp that moves away must become a sun, without losing digits.",
                "lamp's distance", "m", {10.0, 30.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7}, lampAway);
    section.add("L4", "Caster taller than the lamp",
                "Only what lies below the lamp casts on the ground; the rest must not throw an inverted shadow.",
                "caster's height over the lamp's", "", {0.3, 0.6, 0.9, 0.999, 1.0, 1.001, 1.2, 2.0}, boxBesideLamp);
    section.add("L5", "Caster that crosses the plane", "Only the part above the ground casts onto it.", "sunk by",
                "radii", {-0.5, 0.0, 0.3, 0.6, 1.0, 1.4, 1.8}, sunkenSphere);
    section.add("L6", "Lamp inside the caster's box",
                "A lamp within a caster's bounding box casts outwards; no hull of the caster may be taken for it.",
                "way into the frame", "", {0.0, 0.4, 0.7, 0.8, 0.9, 1.0}, lampInFrame);
    section.add("L7", "Grazing sun", "A low sun stretches a tower's shadow, and every error with it.",
                "sun's elevation", "°", {45.0, 20.0, 10.0, 7.0, 5.0, 4.0, 3.2}, lowSunOnTower);
    section.add("L8", "Sun overhead", "The direction across the ground vanishes, and no azimuth may be made of it.",
                "tilt from the vertical", "", {0.3, 0.1, 1e-3, 1e-6, 1e-12, 0.0}, highSun);
    section.add("L9", "Light vectors of odd length", "A direction's length means nothing.", "length of the direction",
                "", {1.0, 1e3, 1e-3, 1e10, 1e-10, 1e18, 1e-18}, lightOfLength);
    section.add("L10", "Lamp in the plane of a face",
                "A face seen edge-on by the lamp is neither front nor back: the silhouette must stay closed.",
                "lamp's distance from the plane", "m", {1.0, 0.1, 1e-2, 1e-4, 1e-6, 0.0}, lampOverFace);
    section.add(
        "L11", "Sun along walls",
        "A wall that is turned away from the sun by a little is in shadow as a whole, without stripes and bright rims.",
        "walls turned away by", "°", alongWalls, [](double degrees) { return streets(degrees, false); });
    section.add("L12", "Sun along walls, averaged normals", "The same of walls that their normals make bright.",
                "walls turned away by", "°", alongWalls, [](double degrees) { return streets(degrees, true); });
    return section.scenes();
}

} // namespace gnomon::examples
