// SPDX-License-Identifier: MIT
// Overlaps, edges of receivers, counts; and what the method of ARL-TN-156 stumbles over.
#include "SceneParts.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/Texture2D>

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

/// A square sheet whose texture is clear but for some of its texels, drawn late and blended as leaves are.
struct LeafySheet {
    glm::dvec3 corner, along, up;
    int texels; ///< on a side.

    /// A pattern without repeats.
    bool isLeaf(int x, int y) const { return (x * 7 + y * 13 + x * y * 3) % 5 < 3; }
    osg::ref_ptr<osg::Node> drawn() const {
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(texels, texels, 1, GL_RGBA, GL_UNSIGNED_BYTE);
        for (int y = 0; y < texels; ++y)
            for (int x = 0; x < texels; ++x)
                image->setColor({1.0f, 1.0f, 1.0f, isLeaf(x, y) ? 1.0f : 0.0f}, unsigned(x), unsigned(y));
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
        for (const auto filter : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
            texture->setFilter(filter, osg::Texture::NEAREST);
        const osg::ref_ptr<osg::Geode> geode = node(quad(corner, along, up));
        osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
        const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
        for (const osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray())) {
            const glm::dvec3 from = glm::dvec3(vertex.x(), vertex.y(), vertex.z()) - corner;
            places->push_back(
                osg::Vec2d(glm::dot(from, along) / glm::dot(along, along), glm::dot(from, up) / glm::dot(up, up)));
        }
        geometry.setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
        geode->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
        geode->getStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
        geode->getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
        return geode;
    }
    /// A square for each texel that is not clear.
    Mesh seen() const {
        Mesh mesh;
        const glm::dvec3 right = along / double(texels), upwards = up / double(texels);
        for (int y = 0; y < texels; ++y)
            for (int x = 0; x < texels; ++x) {
                if (!isLeaf(x, y)) continue;
                const Mesh texel = quad(corner + double(x) * right + double(y) * upwards, right, upwards);
                mesh.insert(mesh.end(), texel.begin(), texel.end());
            }
        return mesh;
    }
};

/// Hedges behind one another, as so many texels a side show them.
SceneParts hedges(double texels) {
    SceneParts parts = onGround();
    SceneParts seen = onGround();
    for (const LeafySheet& sheet : {LeafySheet{{-3.0, 1.5, 0.0}, {3.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, int(texels)},
                                    LeafySheet{{-1.5, 0.0, 0.0}, {2.4, 1.8, 0.0}, {0.0, 0.0, 3.0}, int(texels)},
                                    LeafySheet{{0.5, -1.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 3.0}, int(texels)}}) {
        parts.add(sheet.drawn());
        seen.add(sheet.seen());
    }
    for (SceneParts* each : {&parts, &seen}) each->add(house({3.0, 1.0}, {1.5, 1.0, 3.0}, 20.0));
    parts.truth = seen.content;
    return parts;
}

/// A tower in a pond, of which the bottom is the ground. Water takes no shadow; where its alpha is less than a half, a pixel
/// shows more of what the ground has.
SceneParts pond(double alpha) {
    SceneParts parts = onGround();
    parts.add(boxAt({0.0, 0.0, 0.0}, {1.0, 1.0, 3.0}));
    parts.truth = new osg::Group(*parts.content);
    const osg::ref_ptr<osg::Geode> water = node(square(5.0, 0.5));
    const osg::ref_ptr<osg::Image> image = new osg::Image; // looks leave textures as they are
    image->allocateImage(1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    image->setColor({1.0f, 1.0f, 1.0f, float(alpha)}, 0, 0);
    osg::Geometry& surface = *water->getDrawable(0)->asGeometry();
    surface.setTexCoordArray(0, new osg::Vec2Array(surface.getVertexArray()->getNumElements()),
                             osg::Array::BIND_PER_VERTEX);
    osg::StateSet& set = *water->getOrCreateStateSet();
    set.setTextureAttributeAndModes(0, new osg::Texture2D(image));
    set.setMode(GL_BLEND, osg::StateAttribute::ON);
    set.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    parts.add(water);
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
    section.add("B6", "Hedges that blend",
                "Leaves cut out by a texture cast and receive, and what is seen between them does.", "texels a side",
                "", {2.0, 4.0, 8.0, 16.0, 32.0}, hedges);
    section.add("B7", "Tower in a pond", "The ground keeps its shadow below water.", "alpha of the water", "",
                {0.1, 0.2, 0.3, 0.4}, pond);
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
