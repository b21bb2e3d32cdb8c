// SPDX-License-Identifier: MIT
#include "Town.h"
#include "Mesh.h"

#include <gnomon/ProgressLine.h>
#include <gnomon/TerrainGround.h>

#include <glm/trigonometric.hpp>
#include <osg/Geode>
#include <osg/Material>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>

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

/// A group named "town": on the plots blocks turned at random, a fifth of them L-shaped, some towers, and some tanks of 20
/// sides. Each stands in the ground, its foot 2 m below the lowest ground at its corners, and is one closed mesh. They are
/// drawn by neighbourhoods, so that those out of sight can be left out. The same every time.
/// @param ground    metres, all over the square.
osg::ref_ptr<osg::Group> makeTown(const Ground& ground, const glm::dvec2& centre, const TownPlan& plan) {
    Dice dice;
    std::vector<Lot> lots;
    const int plots = plan.plots();
    const glm::dvec2 corner = centre - glm::dvec2(plan.side() / 2.0);
    for (int i = 0; i < plan.buildings; ++i)
        lots.push_back(lotFor(dice, corner + glm::dvec2(i % plots, i / plots) * plot));
    osg::ref_ptr<osg::Group> quarters[kinds];
    for (std::size_t k = 0; k < kinds; ++k) quarters[k] = quarterOf(looksOf[k]);
    ProgressLine progress("building the town");
    const std::vector<Neighbours> neighbourhoods = neighbourhoodsOf(lots, plots);
    for (std::size_t i = 0; i < neighbourhoods.size(); ++i) {
        std::vector<Mesh> meshes[kinds];
        for (const Lot* lot : neighbourhoods[i])
            meshes[lot->kind].push_back(building(ground, lot->outline, lot->height));
        for (std::size_t k = 0; k < kinds; ++k)
            if (!meshes[k].empty()) quarters[k]->addChild(node(joined(std::move(meshes[k]))));
        progress.show(double(i + 1) / double(neighbourhoods.size()));
    }
    osg::ref_ptr<osg::Group> town = new osg::Group;
    town->setName("town");
    for (const osg::ref_ptr<osg::Group>& quarter : quarters) town->addChild(quarter);
    return town;
}

constexpr double worthwhileRise = 0.1; // to the north, as a slope; more is no better
constexpr unsigned mostTried = 100;    // places along an axis
constexpr unsigned mostLooks = 16;     // along a side of the square
constexpr double mostCells = 1e6;      // along a side of the square

/// Cells from a post on, and how many.
struct Cells {
    unsigned column, row, columns, rows;
};

/// More than any model has where the step is none.
unsigned cellsAcross(double side, double step) {
    return static_cast<unsigned>(std::ceil(step * mostCells > side ? side / step : mostCells));
}

/// What speaks against a square.
struct Slopes {
    double steepest = 0.0, rise = 0.0; ///< along either axis; sum of those to the north.
    unsigned count = 0;

    /// @param east, north  from `here`, as heights and as ways.
    bool take(float here, float east, float north, const glm::dvec2& way) {
        if (!isHeight(here) || !isHeight(east) || !isHeight(north)) return false;
        const double northward = double(north - here) / way.y;
        steepest = std::max({steepest, std::abs(double(east - here) / way.x), std::abs(northward)});
        rise += northward;
        ++count;
        return true;
    }
};

/// Steepest slope less what the square rises to the north; infinite where a height is missing.
double unfitness(const osg::HeightField& field, const Cells& cells) {
    const unsigned right = cells.columns / mostLooks + 1, up = cells.rows / mostLooks + 1;
    const glm::dvec2 way(right * double(field.getXInterval()), up * double(field.getYInterval()));
    Slopes slopes;
    for (unsigned row = cells.row; row + up <= cells.row + cells.rows; row += up)
        for (unsigned column = cells.column; column + right <= cells.column + cells.columns; column += right)
            if (!slopes.take(field.getHeight(column, row), field.getHeight(column + right, row),
                             field.getHeight(column, row + up), way))
                return std::numeric_limits<double>::infinity();
    return slopes.steepest - std::min(slopes.rise / slopes.count, worthwhileRise);
}

[[noreturn]] void refuse(const osg::HeightField& field, double side) {
    std::ostringstream sentence;
    sentence << "the elevation model has no place for the town: " << side
             << " m each way are needed, with no height missing. "
             << "The model, whose unit must be metres, is "
             << (field.getNumColumns() - 1) * double(field.getXInterval()) << " by "
             << (field.getNumRows() - 1) * double(field.getYInterval()) << ".";
    throw std::runtime_error(sentence.str());
}

constexpr double latitude = 36.6;                               // degrees
constexpr double cameraAzimuth = 240.0, cameraDistance = 960.0; // degrees and m, from the town's middle
constexpr double cameraHeight = 420.0, clearance = 60.0;        // m, above the town's middle and any ground below it
constexpr double mostAway = 800.0 / cameraHeight;               // so many times: a large town is looked over from 800 m
constexpr double townSeenWhole = 900.0;                         // m, its side

osg::ref_ptr<osg::Geode> drawTerrain(osg::HeightField& field) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(&field));
    osg::ref_ptr<osg::Material> grass = new osg::Material;
    grass->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0.50f, 0.58f, 0.38f, 1.0f));
    grass->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(0.50f, 0.58f, 0.38f, 1.0f));
    geode->getOrCreateStateSet()->setAttributeAndModes(grass);
    geode->setName("terrain");
    return geode;
}

void lookAt(ViewOptions& view, const Ground& ground, const glm::dvec2& middle, double side) {
    const double azimuth = osg::DegreesToRadians(cameraAzimuth), away = std::clamp(side / townSeenWhole, 1.0, mostAway);
    const glm::dvec2 eye = middle + away * cameraDistance * glm::dvec2(std::sin(azimuth), std::cos(azimuth));
    const double low = ground.height(middle.x, middle.y).value_or(0.0);
    const double below = ground.height(eye.x, eye.y).value_or(low);
    view.center = osg::Vec3d(middle.x, middle.y, low);
    view.eye = osg::Vec3d(eye.x, eye.y, std::max(low + away * cameraHeight, below + clearance));
}

void setLooks(ViewOptions& view, double hour) {
    view.receiver = "terrain";
    view.casters = "town";
    view.ground = "none";
    const SunPosition sun = townSun(hour);
    view.lights = {sunAt(sun.azimuth, sun.elevation)};
    view.ambient = osg::Vec3d(0.35, 0.35, 0.35);
    view.diffuse = osg::Vec3d(0.9, 0.9, 0.9);
    view.background = {0.62, 0.74, 0.88};
}

/// Fills in the view, too.
osg::ref_ptr<osg::Group> makeScene(ViewOptions& view, double hour, osg::HeightField& field, const TownPlan& plan) {
    field.setOrigin(osg::Vec3());
    const std::shared_ptr<const Ground> ground = groundOf(field);
    const glm::dvec2 middle = townSite(field, plan.side());
    lookAt(view, *ground, middle, plan.side());
    setLooks(view, hour);
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(drawTerrain(field));
    scene->addChild(makeTown(*ground, middle, plan));
    return scene;
}

} // namespace

int TownPlan::plots() const { return static_cast<int>(std::ceil(std::sqrt(double(buildings)))); }
double TownPlan::side() const { return plots() * plot; }

glm::dvec2 townSite(const osg::HeightField& field, double side) {
    Cells cells{0, 0, cellsAcross(side, field.getXInterval()), cellsAcross(side, field.getYInterval())};
    const Cells first = cells;
    Cells best = cells;
    double least = std::numeric_limits<double>::infinity();
    const unsigned acrossStep = field.getNumColumns() / mostTried + 1, alongStep = field.getNumRows() / mostTried + 1;
    for (cells.row = 0; cells.row + cells.rows < field.getNumRows(); cells.row += alongStep)
        for (cells.column = 0; cells.column + cells.columns < field.getNumColumns(); cells.column += acrossStep)
            if (const double here = unfitness(field, cells); here < least) least = here, best = cells;
    if (!(least < std::numeric_limits<double>::infinity())) refuse(field, side);
    return {(best.column + first.columns / 2.0) * double(field.getXInterval()),
            (best.row + first.rows / 2.0) * double(field.getYInterval())};
}

SunPosition townSun(double hour) {
    const SunClock meridian(latitude, 0.0); // where UTC is mean solar time
    return meridian.at(*julianDay("2026-03-20T00:00:00Z") + hour / 24.0);
}

TownScene::TownScene(ViewOptions view, double hour, osg::HeightField& terrain, const TownPlan& plan)
    : _given(hour), _hour(hour), _view(std::move(view)) {
    const osg::ref_ptr<osg::Group> scene = makeScene(_view, hour, terrain, plan);
    _setup = setUpScene(_view, *scene);
}

void TownScene::setHour(double hour) {
    _hour = hour;
    const SunPosition given = townSun(_given), now = townSun(hour);
    _setup.lights->move({now.azimuth - given.azimuth, now.elevation - given.elevation}, *_view.center);
}

} // namespace gnomon::examples
