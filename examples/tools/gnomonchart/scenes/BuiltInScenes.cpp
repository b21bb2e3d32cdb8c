// SPDX-License-Identifier: MIT
#include "ChartScene.h"
#include "InputFile.h"
#include "Mesh.h"
#include "SceneLights.h"

#include <osg/Geometry>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr double townHalf = 55.0, mountainsHalf = 5000.0; // metres
constexpr int housesASide = 20;

/// Metres.
double hillHeight(double x, double y) {
    return 5.0 * std::sin(0.04 * x) * std::cos(0.045 * y) + std::sin(0.13 * x + 0.09 * y);
}

/// Five octaves of ridges in turned directions, metres.
double mountainHeight(double x, double y) {
    double height = 0.0, amplitude = 260.0, wave = 2.0 * osg::PI / 4200.0;
    for (int octave = 0; octave < 5; ++octave) {
        const double angle = 0.5 + 1.3 * octave;
        const double along = x * std::cos(angle) + y * std::sin(angle),
                     across = y * std::cos(angle) - x * std::sin(angle);
        height += amplitude * std::sin(wave * along + octave) * std::cos(0.7 * wave * across + 2.0 * octave);
        amplitude /= 2.6;
        wave *= 2.0;
    }
    return height;
}

osg::Vec3 normalOf(double (*height)(double, double), double x, double y, double step) {
    osg::Vec3d normal(height(x - step, y) - height(x + step, y), height(x, y - step) - height(x, y + step), 2.0 * step);
    normal.normalize();
    return osg::Vec3(normal);
}

osg::ref_ptr<osg::DrawElementsUInt> gridTriangles(unsigned side) {
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned j = 0; j < side; ++j)
        for (unsigned i = 0; i < side; ++i) {
            const unsigned a = j * (side + 1) + i, c = a + side + 1;
            for (const unsigned corner : {a, a + 1, c + 1, a, c + 1, c}) triangles->push_back(corner);
        }
    return triangles;
}

/// A height field of `side` × `side` cells as one drawable with smooth normals.
osg::ref_ptr<osg::Geode> landscape(double (*height)(double, double), double half, unsigned side) {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    const double step = 2.0 * half / side;
    for (unsigned j = 0; j <= side; ++j)
        for (unsigned i = 0; i <= side; ++i) {
            const double x = i * step - half, y = j * step - half;
            vertices->push_back(osg::Vec3d(x, y, height(x, y)));
            normals->push_back(normalOf(height, x, y, step));
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals);
    geometry->addPrimitiveSet(gridTriangles(side));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

/// Down to where its whole footprint is in the ground, and as much higher, so that it stands as far out.
Mesh dugIn(Mesh house) {
    double low = 1e9;
    for (const glm::dvec3& v : house) low = std::min(low, hillHeight(v.x, v.y));
    for (glm::dvec3& v : house) v.z += v.z > 0.0 ? hillHeight(v.x, v.y) : low - 0.5;
    double roof = -1e9;
    for (const glm::dvec3& v : house) roof = std::max(roof, v.z);
    for (glm::dvec3& v : house)
        if (v.z > low) v.z = roof;
    return house;
}

void add(osg::Group& group, const Mesh& mesh, const std::string& name = "") { group.addChild(node(mesh, name)); }

/// On four legs. @param top  height of its upper side.
Mesh table(const glm::dvec2& low, const glm::dvec2& high, double top, double thickness, double leg) {
    std::vector<Mesh> parts{box({low, top - thickness}, {high, top})};
    for (const double x : {low.x, high.x - leg})
        for (const double y : {low.y, high.y - leg})
            parts.push_back(box({x, y, 0.0}, {x + leg, y + leg, top - thickness}));
    return joined(parts);
}

Mesh chair(const glm::dvec2& at) {
    return joined(
        {table(at, at + glm::dvec2(0.45), 0.46, 0.04, 0.04), box({at, 0.46}, {at.x + 0.04, at.y + 0.45, 0.95})});
}

/// Four hundred boxes of various sizes and turns on level ground, 110 m square; the ground is named "ground".
osg::ref_ptr<osg::Group> flatTown() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    add(*group, square(townHalf), "ground");
    for (const Mesh& house : town(housesASide)) add(*group, house);
    return group;
}

/// The same boxes dug into hills of up to 6 m. Nothing in it is flat enough for a planar shadow.
osg::ref_ptr<osg::Group> hillyTown() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(landscape(hillHeight, townHalf, 110));
    group->getChild(0)->setName("terrain");
    for (const Mesh& house : town(housesASide)) add(*group, dugIn(house));
    return group;
}

/// Mountains, 10 km square, 800 m between valley and summit, one drawable of 125,000 triangles.
osg::ref_ptr<osg::Group> mountains() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(landscape(mountainHeight, mountainsHalf, 250));
    return group;
}

/// A room of 6 × 5 × 2.8 m, seen from inside, its floor named "ground", with a table, two chairs, a cupboard and a shelf.
osg::ref_ptr<osg::Group> furnishedRoom() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    add(*group, quad({-3.0, -2.5, 0.0}, {6.0, 0.0, 0.0}, {0.0, 5.0, 0.0}), "ground");
    const Mesh room = insideOut(box({-3.0, -2.5, 0.0}, {3.0, 2.5, 2.8}));
    add(*group, Mesh(room.begin() + 6, room.end()), "walls"); // without its floor, which box() gives first
    add(*group, table({0.6, -0.4}, {2.0, 0.5}, 0.75, 0.05, 0.06));
    add(*group, chair({0.2, -0.2}));
    add(*group, chair({1.0, 0.8}));
    add(*group, box({-0.6, 2.0, 0.0}, {0.6, 2.5, 1.9}), "cupboard");
    add(*group, box({2.6, -1.2, 1.5}, {3.0, 0.8, 1.55}), "shelf");
    return group;
}

constexpr double townFovy = 16.0; // degrees; wider, silhouettes would be more than 5 % of the surface

const std::string program = "gnomonchart";

/// One of the scenes that are built in.
struct Entry {
    std::string name, title;
    std::function<osg::ref_ptr<osg::Node>()> make;
    osg::Vec4d light;
    std::optional<osg::Vec3d> eye, center;
    double fovy = 40.0;          ///< degrees.
    std::string ground = "none"; ///< as --ground.
    std::string round = {};      ///< see ChartScene.
};

std::function<osg::ref_ptr<osg::Node>()> file(const std::string& path) {
    return [path] { return readScene({path}, program); };
}

osg::ref_ptr<osg::Node> townAtUtm() {
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::translate(432100.25, 6400000.5, 812.0));
    place->addChild(flatTown());
    return place;
}

/// The same scene under a sun of 45 and of 10 degrees.
void addTwice(std::vector<Entry>& entries, const Entry& scene, double azimuth) {
    for (const int elevation : {45, 10}) {
        Entry entry = scene;
        entry.name += "-" + std::to_string(elevation);
        entry.title += ", sun at " + std::to_string(elevation) + "°";
        entry.light = sunAt(azimuth, elevation);
        entries.push_back(entry);
    }
}

void addGenerated(std::vector<Entry>& entries) {
    const osg::Vec3d overTown(-50.0, -70.0, 45.0), town(-26.0, -34.0, 0.0), utm(432100.25, 6400000.5, 812.0);
    addTwice(entries, {"town", "Flat town of 400 boxes", flatTown, {}, overTown, town, townFovy}, 105.0);
    addTwice(entries, {"hills", "Hilly town of 400 boxes", hillyTown, {}, overTown, town, townFovy}, 105.0);
    entries.push_back({"town-utm", "The flat town at UTM coordinates, sun at 45°", townAtUtm, sunAt(105.0, 45.0),
                       overTown + utm, town + utm, townFovy});
    entries.push_back({"street", "Street level in the flat town, sun at 30°", flatTown, sunAt(105.0, 30.0),
                       osg::Vec3d(1.0, -20.0, 1.7), osg::Vec3d(4.0, 20.0, 1.5), 50.0});
    entries.push_back({"mountains-10", "10 km of mountains, long view, sun at 10°", mountains, sunAt(120.0, 10.0),
                       osg::Vec3d(-4700.0, -4300.0, 900.0), osg::Vec3d(0.0, 0.0, 0.0)});
    entries.push_back({"room",
                       "Room with a lamp among furniture",
                       furnishedRoom,
                       {0.1, 0.3, 1.25, 1.0},
                       osg::Vec3d(-2.8, -2.3, 2.1),
                       osg::Vec3d(0.5, 0.6, 0.7),
                       70.0});
}

void addModels(std::vector<Entry>& entries) {
    const auto onGround = [](const std::string& name, const std::string& title, const std::string& path) {
        Entry entry{name, title, file(path), {}, std::nullopt, std::nullopt};
        entry.ground = "auto";
        return entry;
    };
    Entry lab8 = onGround("lab8", "Lab 8: sphere and cube", GNOMON_LAB8);
    lab8.eye = osg::Vec3d(-1.0, -3.6, 2.2);
    lab8.center = osg::Vec3d(-0.15, 0.1, 0.1);
    lab8.round = "sphere";
    addTwice(entries, lab8, 120.0);
    addTwice(entries, onGround("bunny", "Stanford bunny", "/usr/share/glmark2/models/bunny.obj"), 120.0);
    addTwice(entries, onGround("flyer", "Wright Flyer", "/usr/share/inventor/data/models/vehicles/kittyHawk.iv"),
             120.0);
    addTwice(entries, onGround("casting", "CAD casting", "/usr/share/opencascade/data/stl/TR12J_OCC.stl"), 120.0);
}

const std::vector<Entry>& catalogue() {
    static const std::vector<Entry> entries = [] {
        std::vector<Entry> all;
        addModels(all);
        addGenerated(all);
        return all;
    }();
    return entries;
}

ViewOptions viewOf(const Entry& entry, int width, int height) {
    ViewOptions options;
    options.lights = {entry.light};
    options.eye = entry.eye;
    options.center = entry.center;
    options.fovy = entry.fovy;
    options.ground = entry.ground;
    options.width = width;
    options.height = height;
    return options;
}

} // namespace

std::vector<std::string> chartSceneNames() {
    std::vector<std::string> names;
    for (const Entry& entry : catalogue()) names.push_back(entry.name);
    return names;
}

ChartScene chartScene(const std::string& name, int width, int height) {
    for (const Entry& entry : catalogue()) {
        if (entry.name != name) continue;
        ChartScene scene = chartSceneOf(*entry.make(), viewOf(entry, width, height));
        scene.name = entry.name;
        scene.title = entry.title;
        scene.round = entry.round;
        return scene;
    }
    std::ostringstream allowed;
    for (const std::string& each : chartSceneNames()) allowed << " " << each;
    throw std::invalid_argument("no scene is named \"" + name + "\". Allowed:" + allowed.str() + ".");
}

} // namespace gnomon::examples
