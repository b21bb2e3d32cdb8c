// SPDX-License-Identifier: MIT
#include "RandomScene.h"

#include "scenes/SceneParts.h"

#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>

namespace gnomon::examples {
namespace {

constexpr double groundHalf = 14.0, hillHeight = 1.2; // metres
constexpr double slopeDegrees = 18.0;
constexpr const char* shapeNames[] = {"box", "sphere", "prism", "sheet", "open sphere", "turned sphere"};
constexpr const char* groundNames[] = {"flat", "tilted", "hills"};

/// std's distributions differ between libraries.
class Dice {
public:
    explicit Dice(unsigned seed) : _random(seed) {}
    double between(double low, double high) {
        return low + (high - low) * double(std::uint32_t(_random())) / 4294967296.0;
    }
    int below(int count) { return std::min(count - 1, static_cast<int>(between(0.0, count))); }
    bool one(int in) { return below(in) == 0; }

private:
    std::mt19937 _random;
};

double groundHeight(RandomScene::Ground ground, double x, double y) {
    switch (ground) {
    case RandomScene::Ground::FLAT:
        return 0.0;
    case RandomScene::Ground::TILTED:
        return -x * std::tan(osg::DegreesToRadians(slopeDegrees));
    case RandomScene::Ground::HILLS:
        break;
    }
    return hillHeight * std::sin(0.5 * x) * std::cos(0.4 * y);
}

osg::ref_ptr<osg::Geode> groundNode(RandomScene::Ground ground) {
    switch (ground) {
    case RandomScene::Ground::FLAT:
        return node(square(groundHalf), "ground");
    case RandomScene::Ground::TILTED:
        return node(tilted(groundHalf, slopeDegrees), "ground");
    case RandomScene::Ground::HILLS:
        break;
    }
    return node(
        landscape([](double x, double y) { return groundHeight(RandomScene::Ground::HILLS, x, y); }, groundHalf, 28),
        "terrain");
}

RandomCaster randomCaster(Dice& dice, RandomScene::Ground ground) {
    RandomCaster caster;
    caster.shape = static_cast<RandomShape>(dice.one(3) ? dice.below(6) : 0);
    caster.size = {dice.between(0.4, 3.0), dice.between(0.4, 3.0), dice.between(0.5, 4.0)};
    caster.foot = {dice.between(-6.0, 6.0), dice.between(-6.0, 6.0), 0.0};
    caster.foot.z = groundHeight(ground, caster.foot.x, caster.foot.y) + (dice.one(3) ? dice.between(0.0, 2.0) : -0.6);
    caster.turn = dice.one(4) ? 0.0 : dice.between(0.0, 360.0);
    caster.tilt = dice.one(4) ? dice.between(-40.0, 40.0) : 0.0;
    caster.transforms = dice.one(4) ? 1 + dice.below(8) : 0;
    caster.broken = dice.one(10);
    return caster;
}

glm::dvec4 randomLight(Dice& dice) {
    const double azimuth = dice.between(0.0, 360.0),
                 elevation = dice.one(5) ? dice.between(4.0, 15.0) : dice.between(15.0, 88.0);
    const osg::Vec4d sun = sunAt(azimuth, elevation);
    if (!dice.one(3)) return {sun.x(), sun.y(), sun.z(), 0.0};
    const double distance = dice.between(5.0, 30.0);
    return {sun.x() * distance, sun.y() * distance, std::max(3.0, sun.z() * distance), 1.0};
}

Mesh openSphere(Mesh mesh) {
    Mesh kept;
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3)
        if ((i / 3) % 5 != 2) kept.insert(kept.end(), mesh.begin() + long(i), mesh.begin() + long(i) + 3);
    return kept;
}

Mesh turnedSphere(Mesh mesh) {
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 12) std::swap(mesh[i], mesh[i + 1]);
    return mesh;
}

/// Of size 1, standing on the origin.
Mesh unitMesh(RandomShape shape) {
    const Mesh ball = sphere({0.0, 0.0, 0.5}, 0.5, 16);
    switch (shape) {
    case RandomShape::BOX:
        return boxAt({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    case RandomShape::SPHERE:
        return ball;
    case RandomShape::PRISM:
        return moved(sphere({0.0, 0.0, 0.0}, 0.5, 4), {0.0, 0.0, 0.5});
    case RandomShape::SHEET:
        return quad({-0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
    case RandomShape::OPEN:
        return openSphere(ball);
    case RandomShape::TURNED:
        break;
    }
    return turnedSphere(ball);
}

void breakMesh(Mesh& mesh) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 corner = mesh.front(), bad(nan, 0.0, nan);
    mesh.insert(mesh.end(), {corner, corner, corner, corner, bad, corner, bad, bad, bad});
}

osg::ref_ptr<osg::Node> casterNode(const RandomCaster& caster, bool broken) {
    Mesh mesh = unitMesh(caster.shape);
    if (broken) breakMesh(mesh);
    osg::ref_ptr<osg::Node> below = node(mesh);
    for (int i = 0; i < caster.transforms; ++i) {
        osg::ref_ptr<osg::MatrixTransform> over =
            new osg::MatrixTransform(osg::Matrixd::scale(i % 2 ? -0.5 : -2.0, 1.0, i % 2 ? 1.25 : 0.8));
        over->addChild(below);
        below = over;
    }
    const double odd = caster.transforms % 2 ? 0.5 : 1.0; // so that its size is its size
    const glm::dvec3& size = caster.size;
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::scale(size.x * odd, size.y, size.z) *
                                 osg::Matrixd::rotate(osg::DegreesToRadians(caster.tilt), 1.0, 0.0, 0.0) *
                                 osg::Matrixd::rotate(osg::DegreesToRadians(caster.turn), 0.0, 0.0, 1.0) *
                                 osg::Matrixd::translate(caster.foot.x, caster.foot.y, caster.foot.z));
    place->addChild(below);
    return place;
}

osg::Matrixd placeOf(const RandomScene& scene) {
    return osg::Matrixd::scale(scene.scale, scene.scale, scene.scale) *
           osg::Matrixd::translate(scene.offset, -0.6 * scene.offset, 0.1 * scene.offset);
}

osg::ref_ptr<osg::Group> contentOf(const RandomScene& scene, bool broken) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(placeOf(scene));
    place->addChild(groundNode(scene.ground));
    for (const RandomCaster& caster : scene.casters) place->addChild(casterNode(caster, broken && caster.broken));
    osg::ref_ptr<osg::Group> content = new osg::Group;
    content->addChild(place);
    return content;
}

osg::Vec3d placed(const glm::dvec3& point, const RandomScene& scene) {
    return osg::Vec3d(point.x, point.y, point.z) * placeOf(scene);
}

/// Adds what `change` makes of a copy, if that is any different.
template <typename Part, typename Value>
void plainer(std::vector<RandomScene>& into, const RandomScene& scene, Part part, const Value& plain) {
    RandomScene copy = scene;
    auto& value = part(copy);
    if (value == plain) return;
    value = plain;
    into.push_back(std::move(copy));
}

} // namespace

RandomScene randomScene(unsigned seed) {
    Dice dice(seed);
    RandomScene scene;
    scene.seed = seed;
    scene.ground = static_cast<RandomScene::Ground>(dice.one(2) ? 0 : dice.below(3));
    const int casters = 1 + dice.below(dice.one(4) ? 12 : 4);
    for (int i = 0; i < casters; ++i) scene.casters.push_back(randomCaster(dice, scene.ground));
    scene.light = randomLight(dice);
    const double azimuth = dice.between(0.0, 2.0 * osg::PI), distance = dice.between(12.0, 26.0);
    scene.center = {dice.between(-2.0, 2.0), dice.between(-2.0, 2.0), 0.5};
    scene.eye =
        scene.center + glm::dvec3(distance * std::cos(azimuth), distance * std::sin(azimuth), dice.between(4.0, 18.0));
    scene.fovy = dice.between(25.0, 60.0);
    if (dice.one(4)) scene.offset = std::pow(10.0, dice.between(2.0, 7.0));
    if (dice.one(4)) scene.scale = std::pow(10.0, dice.between(-3.0, 3.0));
    return scene;
}

StabilityCase caseOf(const RandomScene& scene, int width, int height) {
    SceneParts parts;
    parts.content = contentOf(scene, true);
    parts.truth = contentOf(scene, false);
    const osg::Vec3d light = scene.light.w == 0.0 ? osg::Vec3d(scene.light.x, scene.light.y, scene.light.z)
                                                  : placed(glm::dvec3(scene.light), scene);
    parts.light = osg::Vec4d(light, scene.light.w);
    parts.eye = placed(scene.eye, scene);
    parts.center = placed(scene.center, scene);
    parts.fovy = scene.fovy;
    parts.radius = 6.0 * scene.scale;
    return stabilityCase(parts, width, height);
}

std::vector<RandomScene> simpler(const RandomScene& scene) {
    std::vector<RandomScene> all;
    for (std::size_t i = 0; scene.casters.size() > 1 && i < scene.casters.size(); ++i) {
        all.push_back(scene);
        all.back().casters.erase(all.back().casters.begin() + long(i));
    }
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.offset; }, 0.0);
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.scale; }, 1.0);
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.ground; }, RandomScene::Ground::FLAT);
    for (std::size_t i = 0; i < scene.casters.size(); ++i) {
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].broken; }, false);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].transforms; }, 0);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].shape; }, RandomShape::BOX);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].tilt; }, 0.0);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].turn; }, 0.0);
    }
    return all;
}

std::string describe(const RandomScene& scene) {
    std::ostringstream out;
    const auto put = [&out](const glm::dvec3& v) { out << "(" << v.x << ", " << v.y << ", " << v.z << ")"; };
    out << "seed " << scene.seed << ": " << groundNames[int(scene.ground)] << " ground, "
        << (scene.light.w == 0.0 ? "sun " : "lamp ");
    put(glm::dvec3(scene.light));
    out << ", eye ";
    put(scene.eye);
    out << ", center ";
    put(scene.center);
    out << ", fovy " << scene.fovy << ", offset " << scene.offset << ", scale " << scene.scale;
    for (const RandomCaster& caster : scene.casters) {
        out << "; " << shapeNames[int(caster.shape)] << " at ";
        put(caster.foot);
        out << " of ";
        put(caster.size);
        out << " turned " << caster.turn << ", tilted " << caster.tilt << ", " << caster.transforms << " transforms"
            << (caster.broken ? ", broken" : "");
    }
    return out.str();
}

} // namespace gnomon::examples
