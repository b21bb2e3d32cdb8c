// SPDX-License-Identifier: MIT
// What shadows fall on.
#include "SceneParts.h"

#include <osg/LOD>

#include <cmath>

namespace gnomon::examples {
namespace {

SceneParts onSlope(double degrees) {
    SceneParts parts;
    parts.add(tilted(12.0, degrees), "ground");
    const double drop = 2.0 * std::tan(osg::DegreesToRadians(degrees)); // of the ground, 2 m downhill
    parts.add(boxAt({-1.0, 0.0, -drop}, {2.0, 2.0, 3.0 + drop + 0.5 * drop}));
    parts.light = {0.4, -0.6, 1.3, 0.0};
    parts.eye = {3.0, -16.0, 9.0};
    parts.center = {0.5, 0.0, 0.5};
    return parts;
}

/// A step down, half a shadow's length from a house.
SceneParts atCliff(double step) {
    SceneParts parts;
    parts.add(
        landscape([=](double x, double) { return x <= 1.0   ? 0.0
                                                 : x >= 2.0 ? -step
                                                            : -step * (x - 1.0); }, 40.0, 80),
        "terrain");
    parts.add(boxAt({-1.5, 0.0, -0.5}, {3.0, 3.0, 5.5}));
    parts.light = {-1.0, -0.2, 1.0, 0.0};
    parts.center = {3.0, 0.0, -0.5 * step};
    parts.eye = parts.center + osg::Vec3d(9.0, -14.0, 9.0) * (1.0 + step / 12.0);
    parts.radius = 4.0;
    return parts;
}

/// A house this far from where the terrain ends.
SceneParts atBorder(double metres) {
    SceneParts parts;
    parts.add(landscape([](double x, double y) { return 0.3 * std::sin(0.5 * x) * std::cos(0.4 * y); }, 10.0, 20),
              "terrain");
    parts.add(boxAt({10.0 - metres - 1.0, 0.0, -0.6}, {2.0, 2.0, 3.6}));
    parts.light = {-1.0, -0.3, 0.9, 0.0};
    parts.center = {7.0, 0.0, 0.0};
    parts.eye = {4.0, -15.0, 10.0};
    return parts;
}

/// A deck above ground, a box on the deck.
SceneParts bridge(double height) {
    SceneParts parts = onGround();
    parts.add(boxAt({0.0, 0.0, height}, {10.0, 3.0, 0.3}));
    parts.add(boxAt({1.0, 0.0, height + 0.3}, {1.0, 1.0, 1.5}));
    parts.light = {-0.5, 0.6, 1.0, 0.0};
    return parts;
}

osg::ref_ptr<osg::Geode> hills(int cells) {
    return node(landscape([](double x, double y) { return 1.2 * std::sin(0.5 * x) * std::cos(0.4 * y); }, 12.0, cells),
                "terrain");
}

/// A terrain that is drawn coarsely, as it is this many ranges away.
SceneParts coarseTerrain(double ranges) {
    SceneParts parts;
    const bool coarse = ranges > 1.0;
    const double distance = (osg::Vec3d(-8.0, -14.0, 10.0)).length(); // of the eye from the origin
    osg::ref_ptr<osg::LOD> levels = new osg::LOD;
    levels->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    levels->setCenter({0.0f, 0.0f, 0.0f});
    levels->setRadius(20.0);
    levels->addChild(hills(48), 0.0f, float(distance / ranges));
    levels->addChild(hills(8), float(distance / ranges), 1e6f);
    levels->setName("terrain");
    for (unsigned i = 0; i < 2; ++i) levels->getChild(i)->setName("");
    const Mesh tower = boxAt({0.0, 0.0, -2.0}, {2.0, 2.0, 5.5});
    parts.add(levels);
    parts.add(tower);
    parts.truth = new osg::Group;
    parts.truth->addChild(coarse ? hills(8) : hills(48));
    parts.truth->addChild(node(tower));
    parts.light = sunAt(120.0, 40.0);
    parts.center = {0.0, 0.0, 0.0};
    return parts;
}

/// Two towers this far apart.
SceneParts twoTowers(double apart) {
    SceneParts parts = onGround(30.0);
    parts.add(boxAt({-1.5 - apart / 2.0, 0.0, 0.0}, {3.0, 3.0, 6.0}));
    parts.add(boxAt({1.5 + apart / 2.0, 0.0, 0.0}, {3.0, 4.0, 8.0}));
    parts.light = {-1.0, -0.25, 0.8, 0.0};
    parts.center = {0.0, 0.0, 2.0};
    parts.eye = {-6.0, -20.0, 12.0};
    parts.radius = 6.0;
    return parts;
}

/// A thin slab on the ground, a house that shadows both.
SceneParts decal(double thickness) {
    SceneParts parts = onGround();
    parts.add(boxAt({2.5, 0.0, 0.0}, {3.0, 5.0, thickness}));
    parts.add(boxAt({-0.5, 0.0, 0.0}, {1.5, 2.0, 3.0}));
    parts.light = {-1.0, -0.2, 1.0, 0.0};
    parts.eye = {2.0, -13.0, 10.0};
    return parts;
}

/// A plate this far above the ground.
SceneParts plate(double gap) {
    SceneParts parts = onGround();
    parts.add(boxAt({0.0, 0.0, gap}, {4.0, 3.0, 0.5}));
    parts.light = sunAt(120.0, 40.0);
    return parts;
}

} // namespace

std::vector<StabilityScene> receiverScenes() {
    Section section("receivers");
    section.add("R1", "Slope", "The shadow follows the receiver's own plane, not a level one.", "slope", "°",
                {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0}, onSlope);
    section.add("R2", "Cliff", "The shadow splits into plateau, face and lower ground; nothing bridges the air.",
                "step", "m", {0.0, 0.5, 1.0, 3.0, 6.0, 12.0}, atCliff);
    section.add("R3", "Edge of the terrain", "The shadow ends where the terrain does, and the rest of it stays.",
                "house from the edge", "m", {6.0, 3.0, 2.0, 1.0, 0.5, 0.0, -0.5}, atBorder);
    section.add("R4", "Bridge", "Both layers are shadowed, and the deck not by its own top.", "deck's height", "m",
                {3.0, 1.5, 0.7, 0.3, 0.1, 0.03}, bridge);
    section.add("R5", "Terrain with levels of detail",
                "The shadow lies on the level that is drawn, without floating or fighting.", "distance",
                "switching ranges", {0.5, 0.9, 1.1, 2.0, 5.0}, coarseTerrain);
    section.add("R6", "Wall as a receiver", "The shadow climbs the other building's wall.", "distance of the towers",
                "m", {20.0, 10.0, 6.0, 3.0, 1.0, 0.3}, twoTowers);
    section.add("R7", "Receiver thinner than the bias", "A thin slab and the ground below it are shadowed once each.",
                "thickness", "m", {0.5, 0.2, 0.1, 0.03, 0.01, 0.003}, decal);
    section.add("R8", "Caster close to its receiver", "The contact shadow stays, without acne.", "gap", "m",
                {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001}, plate);
    return section.scenes();
}

} // namespace gnomon::examples
