// SPDX-License-Identifier: MIT
// Overlaps, edges of receivers, counts; and what the method of ARL-TN-156 stumbles over.
#include "SceneParts.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace gnomon::examples {
namespace {

/// So many plates above one another, whose shadows overlap.
SceneParts stacked(double count) {
    SceneParts parts = onGround();
    for (int i = 0; i < int(count); ++i) {
        const double at = i / count;
        parts.add(moved(square(1.2), {1.5 * at - 1.0, 0.8 * at, 0.6 + 3.0 * at}));
    }
    return parts;
}

/// The sun goes about a sphere and a house: their own far sides are dark once.
SceneParts selfShadow(double azimuth) {
    SceneParts parts = onGround();
    parts.add(sphere({-2.0, 0.0, 1.5}, 1.5, 64));
    parts.add(house({2.0, 0.0}, {2.0, 2.0, 2.5}, 35.0));
    parts.light = sunAt(30.0 + azimuth, 40.0);
    return parts;
}

/// A table whose edge is this far from a jug that stands on it.
SceneParts onTable(double metres) {
    SceneParts parts;
    parts.add(quad({-4.0, -3.0, 2.0}, {8.0, 0.0, 0.0}, {0.0, 6.0, 0.0}), "ground");
    parts.add(square(12.0));
    parts.add(boxAt({4.0 - metres - 0.5, 0.0, 2.0}, {1.0, 1.0, 2.0}));
    parts.light = {-1.0, 0.2, 1.0, 0.0};
    parts.eye = {2.0, -14.0, 12.0};
    parts.center = {2.0, 0.0, 1.5};
    return parts;
}

SceneParts many(double count) {
    SceneParts parts = onGround(30.0);
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < int(count); ++i)
        parts.add(house({24.0 * ((i % side + 0.5) / side - 0.5), 24.0 * ((i / side + 0.5) / side - 0.5)},
                        {10.0 / side, 8.0 / side, 14.0 / side}, 17.0 * i));
    parts.eye = {-18.0, -30.0, 24.0};
    parts.center = {0.0, 0.0, 0.0};
    parts.radius = 17.0;
    return parts;
}

SceneParts turnedBox(double degrees) {
    SceneParts parts = onGround();
    parts.add(house({0.0, 0.0}, {3.0, 1.5, 3.0}, degrees));
    return parts;
}

/// An upright prism with so many sides.
Mesh prism(int sides, double radius, double height) {
    Mesh mesh;
    const auto corner = [&](int i, double z) {
        const double angle = 2.0 * glm::pi<double>() * i / sides;
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    for (int i = 0; i < sides; ++i) {
        const glm::dvec3 a = corner(i, 0.0), b = corner(i + 1, 0.0), c = corner(i + 1, height), d = corner(i, height);
        mesh.insert(mesh.end(), {a, b, c, a, c, d, {0.0, 0.0, height}, d, c, {0.0, 0.0, 0.0}, b, a});
    }
    return mesh;
}

SceneParts withSides(double sides) {
    SceneParts parts = onGround();
    parts.add(prism(int(sides), 1.5, 2.5));
    return parts;
}

SceneParts sunFrom(double azimuth) {
    SceneParts parts = onGround();
    parts.add(house({0.0, 0.0}, {3.0, 1.5, 3.0}, 0.0));
    parts.light = sunAt(azimuth, 40.0);
    return parts;
}

/// A box whose one corner nears the middle of its own frame.
SceneParts cornerAtZero(double off) {
    SceneParts parts = onGround();
    parts.add(box({off, off, 0.0}, {off + 2.0, off + 1.5, 3.0}));
    parts.light = sunAt(135.0, 45.0);
    return parts;
}

/// A house dug into a slope.
SceneParts dugIn(double metres) {
    SceneParts parts;
    parts.add(landscape([](double x, double y) { return -0.25 * x + 0.2 * std::sin(0.6 * y); }, 12.0, 24), "terrain");
    parts.add(boxAt({0.0, 0.0, -1.0 - metres}, {2.5, 2.0, 4.0 + metres}));
    parts.light = {0.4, -0.6, 1.3, 0.0};
    parts.eye = {3.0, -16.0, 9.0};
    return parts;
}

} // namespace

std::vector<StabilityScene> blendingScenes() {
    Section section("blending and ARL");
    section.add("B1", "Overlap", "A place in many shadows is as dark as one in a single shadow.", "plates", "",
                {1.0, 2.0, 5.0, 20.0, 60.0}, stacked);
    section.add("B3", "Casters' far sides", "A solid's own far side is dark once, and its shadow is not drawn on it.",
                "sun's turn", "°", {0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0}, selfShadow);
    section.add("B4", "Edge of a table", "The shadow ends at the table's edge, and goes on upon the ground below.",
                "jug from the edge", "m", {6.0, 3.0, 2.0, 1.0, 0.5, 0.0}, onTable);
    section.add("B5", "Number of casters", "Nothing depends on how many casters there are.", "casters", "",
                {0.0, 1.0, 9.0, 100.0, 900.0}, many);
    section.add("A1", "Turned box", "A box has no preferred azimuth.", "turn", "°",
                {0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 89.0}, turnedBox);
    section.add("A2", "Prism of many sides", "Vertices that lie close to each other all count.", "sides", "",
                {4.0, 3.0, 5.0, 6.0, 9.0, 16.0, 64.0}, withSides);
    section.add("A3", "Sun about a box", "The outline closes whichever edge comes last.", "sun's azimuth", "°",
                {45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0}, sunFrom);
    section.add("A4", "Corner at zero", "A coordinate that is exactly zero has a side, too.",
                "corner's distance from 0", "m", {1.0, 0.1, 1e-3, 1e-6, 0.0, -1e-6}, cornerAtZero);
    section.add("A5", "House dug into a slope", "The part below the terrain casts nothing onto it.", "depth", "m",
                {0.0, 0.5, 1.0, 2.0, 4.0}, dugIn);
    return section.scenes();
}

} // namespace gnomon::examples
