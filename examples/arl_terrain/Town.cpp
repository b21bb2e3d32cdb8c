// SPDX-License-Identifier: MIT
#include "Town.h"
#include "Mesh.h"

#include <glm/trigonometric.hpp>
#include <osg/Geode>
#include <osg/Material>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::examples {
namespace {

constexpr double footDepth = 2.0, plot = 45.0; // m
constexpr int neighbourhood = 12;              // plots along a side
constexpr double towerShare = 0.06, tankShare = 0.03, wingShare = 0.2;
constexpr int tankSides = 20;

/// Counter-clockwise from above; every corner is seen from the first.
using Outline = std::vector<glm::dvec2>;

/// Numbers as the standard has them for every library: its distributions differ.
class Dice {
public:
    double between(double low, double high) { return low + (high - low) * (double(_twister()) / 4294967296.0); }

private:
    std::mt19937 _twister{1902};
};

Outline block(double width, double depth) {
    const double x = width / 2.0, y = depth / 2.0;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

Outline lShape(double width, double depth, double wing) {
    const double x = width / 2.0, y = depth / 2.0;
    return {{wing - x, wing - y}, {wing - x, y}, {-x, y}, {-x, -y}, {x, -y}, {x, wing - y}};
}

Outline tank(double radius) {
    Outline outline;
    for (int i = 0; i < tankSides; ++i) {
        const double angle = glm::radians(360.0 * i / tankSides);
        outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return outline;
}

void stand(Outline& outline, const glm::dvec2& place, double degrees) {
    const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    for (glm::dvec2& p : outline) p = place + glm::dvec2(p.x * c - p.y * s, p.x * s + p.y * c);
}

Mesh prism(const Outline& outline, double low, double high) {
    Mesh mesh;
    const auto at = [&](std::size_t i, double z) { return glm::dvec3(outline[i % outline.size()], z); };
    for (std::size_t i = 0; i < outline.size(); ++i)
        mesh.insert(mesh.end(),
                    {at(i, low), at(i + 1, low), at(i + 1, high), at(i, low), at(i + 1, high), at(i, high)});
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        mesh.insert(mesh.end(), {at(0, high), at(i, high), at(i + 1, high), at(0, low), at(i + 1, low), at(i, low)});
    return mesh;
}

/// @param height  above the highest ground at a corner.
Mesh building(const Ground& ground, const Outline& outline, double height) {
    double lowest = INFINITY, highest = -INFINITY;
    for (const glm::dvec2& p : outline)
        if (const std::optional<double> z = ground.height(p.x, p.y))
            lowest = std::min(lowest, *z), highest = std::max(highest, *z);
    return highest >= lowest ? prism(outline, lowest - footDepth, highest + height) : Mesh{};
}

/// A building as it was drawn by lot.
struct Lot {
    enum Kind { Block, Wing, Tank } kind;
    Outline outline;
    double height;
};

Lot lotFor(Dice& dice, const glm::dvec2& plotCorner) {
    const double width = dice.between(14.0, 30.0), depth = dice.between(10.0, 18.0), degrees = dice.between(0.0, 360.0);
    const double tower = dice.between(0.0, 1.0) < towerShare ? 25.0 : 0.0, height = dice.between(6.0, 16.0) + tower,
                 kind = dice.between(0.0, 1.0);
    const double north = dice.between(0.4, 0.6), east = dice.between(0.4, 0.6);
    const glm::dvec2 aside(east, north);
    Lot lot{kind < tankShare ? Lot::Tank : kind < tankShare + wingShare ? Lot::Wing : Lot::Block, {}, height};
    lot.outline = lot.kind == Lot::Tank   ? tank(width / 2.0)
                  : lot.kind == Lot::Wing ? lShape(width, width, depth / 2.0)
                                          : block(width, depth);
    stand(lot.outline, plotCorner + aside * plot, degrees);
    return lot;
}

/// What all buildings of a kind share.
struct Looks {
    const char* name;
    osg::Vec4 colour;
};
constexpr std::size_t kinds = 3;
const Looks looksOf[kinds] = {{"blocks", {0.85f, 0.80f, 0.70f, 1.0f}},
                              {"L-shapes", {0.75f, 0.50f, 0.40f, 1.0f}},
                              {"tanks", {0.75f, 0.80f, 0.85f, 1.0f}}};

osg::ref_ptr<osg::Group> quarterOf(const Looks& looks) {
    osg::ref_ptr<osg::Group> quarter = new osg::Group;
    quarter->setName(looks.name);
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, looks.colour);
    material->setDiffuse(osg::Material::FRONT_AND_BACK, looks.colour);
    quarter->getOrCreateStateSet()->setAttributeAndModes(material);
    return quarter;
}

using Neighbours = std::vector<const Lot*>;

std::vector<Neighbours> neighbourhoodsOf(const std::vector<Lot>& lots, int plots) {
    const int along = (plots + neighbourhood - 1) / neighbourhood;
    std::vector<Neighbours> result(std::size_t(along) * std::size_t(along));
    for (std::size_t i = 0; i < lots.size(); ++i) {
        const int column = int(i) % plots / neighbourhood, row = int(i) / plots / neighbourhood;
        result[std::size_t(row * along + column)].push_back(&lots[i]);
    }
    return result;
}

} // namespace

int TownPlan::plots() const { return static_cast<int>(std::ceil(std::sqrt(double(buildings)))); }
double TownPlan::side() const { return plots() * plot; }

osg::ref_ptr<osg::Group> makeTown(const Ground& ground, const glm::dvec2& centre, const TownPlan& plan,
                                  const std::function<void(double)>& progress) {
    Dice dice;
    std::vector<Lot> lots;
    const int plots = plan.plots();
    const glm::dvec2 corner = centre - glm::dvec2(plan.side() / 2.0);
    for (int i = 0; i < plan.buildings; ++i)
        lots.push_back(lotFor(dice, corner + glm::dvec2(i % plots, i / plots) * plot));
    osg::ref_ptr<osg::Group> quarters[kinds];
    for (std::size_t k = 0; k < kinds; ++k) quarters[k] = quarterOf(looksOf[k]);
    const std::vector<Neighbours> neighbourhoods = neighbourhoodsOf(lots, plots);
    for (std::size_t i = 0; i < neighbourhoods.size(); ++i) {
        std::vector<Mesh> meshes[kinds];
        for (const Lot* lot : neighbourhoods[i])
            meshes[lot->kind].push_back(building(ground, lot->outline, lot->height));
        for (std::size_t k = 0; k < kinds; ++k)
            if (!meshes[k].empty()) quarters[k]->addChild(node(joined(std::move(meshes[k]))));
        progress(double(i + 1) / double(neighbourhoods.size()));
    }
    osg::ref_ptr<osg::Group> town = new osg::Group;
    town->setName("town");
    for (const osg::ref_ptr<osg::Group>& quarter : quarters) town->addChild(quarter);
    return town;
}

} // namespace gnomon::examples
