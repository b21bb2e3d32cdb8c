// SPDX-License-Identifier: MIT
#include "ChartScene.h"
#include "GeneratedScenes.h"
#include "SceneFile.h"
#include "SceneLights.h"

#include <osg/MatrixTransform>

#include <functional>
#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

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
        return scene;
    }
    std::ostringstream allowed;
    for (const std::string& each : chartSceneNames()) allowed << " " << each;
    throw std::invalid_argument("no scene is named \"" + name + "\". Allowed:" + allowed.str() + ".");
}

} // namespace gnomon::examples
