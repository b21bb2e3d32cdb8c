// SPDX-License-Identifier: MIT
// Shadows where numbers are large: wide grounds, long views, coordinates far from the origin, casters far from the rest.
// Every pixel that is no edge is right, by rays in double at what the floats of the vertices say.
#include <support/Oracle.h>
#include <support/Scene.h>

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/Material>
#include <osg/MatrixTransform>

#include <cmath>
#include <functional>
#include <string>

using test::Mesh;

namespace {

/// A ground that receives, and what stands on it.
struct Case {
    Mesh ground;
    std::vector<Mesh> casters;
    osg::Vec4d light;
    test::View view;
    osg::ref_ptr<osg::Node> stray{}; ///< one more caster, which is not seen, nor its shadow.

    /// @param black  casters are.
    test::Scene build(bool black = false) const {
        test::Scene result = test::scene(light);
        result.content->addChild(test::node(ground, "ground"));
        osg::ref_ptr<osg::Group> group = new osg::Group;
        result.content->addChild(group);
        for (const Mesh& caster : casters) group->addChild(test::node(caster));
        osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setAmbient(osg::Material::FRONT_AND_BACK, {0.0f, 0.0f, 0.0f, 1.0f});
        material->setDiffuse(osg::Material::FRONT_AND_BACK, {0.0f, 0.0f, 0.0f, 1.0f});
        if (black) group->getOrCreateStateSet()->setAttribute(material);
        if (stray) result.content->addChild(stray);
        return result;
    }
};

using Technique = std::function<osg::ref_ptr<gnomon::ShadowTechnique>()>;

osg::ref_ptr<gnomon::ShadowTechnique> traced() { return new gnomon::TracedShadowTechnique; }
osg::ref_ptr<gnomon::ShadowTechnique> planar() { return test::planar(); }
osg::ref_ptr<gnomon::ShadowTechnique> volume() { return new gnomon::ShadowVolumeTechnique; }
osg::ref_ptr<gnomon::ShadowTechnique> map() {
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = new gnomon::ShadowMapTechnique;
    technique->setSize(2048);
    return technique;
}

/// What is wrong away from edges, of a picture in which there is a shadow. Pixels do not count in which OpenGL draws the
/// ground before a caster's foot, or the other way round, for want of depths.
/// @param reach  pixels from an edge that count as at the edge, see Mask::atEdge().
int wrong(const Case& given, const Technique& technique, int reach = 1) {
    test::Scene shadowed = given.build();
    shadowed.addShadow(technique());
    shadowed.group->setCasters({nullptr, 2}); // no sky
    test::Scene dark = given.build();
    dark.takeLightAway();
    const auto drawn = [&given](test::Scene scene) { return test::render(scene.root, given.view); };
    const test::Picture actual = drawn(shadowed), unlit = drawn(dark), lit = drawn(given.build()),
                        blackened = drawn(given.build(true));
    const test::Mask mask = test::castRays(given.ground, given.casters, given.light, given.view);
    EXPECT_GT(mask.count(test::Seen::ShadowedReceiver), 100) << "or this shows nothing";
    int result = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const test::Seen seen = mask.at(x, y);
            const bool casterDrawn = blackened.at(x, y) == test::grey(0);
            if (mask.atEdge(x, y, reach) || casterDrawn != (seen == test::Seen::Caster)) continue;
            result += actual.at(x, y) != (seen == test::Seen::ShadowedReceiver ? unlit : lit).at(x, y);
        }
    return result;
}

/// As the vertices of a node have them.
Mesh asFloats(Mesh mesh) {
    for (glm::dvec3& corner : mesh) corner = glm::dvec3(glm::vec3(corner));
    return mesh;
}

const osg::Vec4d sun(1.0, 0.3, 0.8, 0.0);

/// A box of 2 m on a level quad, seen from some distance.
Case boxOnAQuad(double side, double distance, double near, double far) {
    return {test::square(side / 2.0),
            {test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})},
            sun,
            test::perspective({-0.5 * distance, -0.8 * distance, 0.3 * distance}, {0.0, 0.0, 0.0}, 320, 240,
                              distance > 50.0 ? 8.0 : 40.0, near, far)};
}

TEST(Scales, TracedShadowsNothingFalselyOnQuadsOfKilometres) {
    for (const double side : {200.0, 2e3, 4e4, 1e6})
        for (const double distance : {4.0, 60.0})
            for (const glm::dvec2& planes : {glm::dvec2(0.1, 1e5), glm::dvec2(1.0, 1e4)}) {
                const int found = wrong(boxOnAQuad(side, distance, planes.x, planes.y), traced);
                EXPECT_EQ(found, 0) << "a quad of " << side << " from " << distance << " m, near " << planes.x
                                    << ", far " << planes.y;
            }
}

// OpenGL cuts such a quad at the near plane in floats, and draws it off its place.
TEST(Scales, WhatTakesDepthsForPlacesTakesThoseOfVastQuadsForWhatTheyAre) {
    for (const Technique& technique : {Technique(volume), Technique(planar)})
        for (const double side : {200.0, 2e3, 4e4, 2e5}) {
            EXPECT_EQ(wrong(boxOnAQuad(side, 4.0, 0.1, 1e4), technique), 0) << technique()->className() << " " << side;
            Case ant{test::square(side / 2.0),
                     {test::box({-0.02, -0.02, 0.0}, {0.02, 0.02, 0.04})},
                     sun,
                     test::perspective({-0.12, -0.2, 0.16}, {0.0, 0.0, 0.0}, 320, 240, 40.0, 0.005, 5.0)};
            EXPECT_EQ(wrong(ant, technique), 0) << technique()->className() << " an ant on " << side;
        }
}

/// Houses of 6 to 20 m that stand far from one another, along a view to the horizon.
Case longView(double side, double near, double far) {
    Case result{test::square(side / 2.0),
                {},
                sun,
                test::perspective({0.0, -30.0, 6.0}, {0.0, 100.0, 0.0}, 320, 240, 40.0, near, far)};
    for (int i = 0; i < 12; ++i) {
        const double away = 10.0 * std::pow(1.6, i), size = 6.0 + 0.15 * away;
        result.casters.push_back(test::box({-0.3 * away, away, 0.0}, {-0.3 * away + size, away + size, size}));
    }
    return result;
}

TEST(Scales, TracedShadowsNothingFalselyInLongViews) {
    for (const double side : {2e4, 2e5})
        for (const double near : {0.1, 0.5})
            EXPECT_EQ(wrong(longView(side, near, 1e5), traced), 0) << side << ", near " << near;
}

/// A scene of 100 m with its offset in its vertices, as files in national grids have it.
/// @param far  plane of the view.
Case baked(const glm::dvec3& offset, bool lamp, double far) {
    const auto at = [&offset](const Mesh& mesh) { return asFloats(test::moved(mesh, offset)); };
    Case result;
    result.ground = at(test::square(50.0));
    for (const glm::dvec2& place : {glm::dvec2(0.0, 0.0), glm::dvec2(20.0, 8.0), glm::dvec2(-15.0, 25.0)})
        result.casters.push_back(
            at(test::box({place.x - 4.0, place.y - 4.0, 0.0}, {place.x + 4.0, place.y + 4.0, 6.0})));
    const osg::Vec3d by(offset.x, offset.y, offset.z);
    result.light = lamp ? osg::Vec4d(osg::Vec4(osg::Vec3(osg::Vec3d(-14.0, 6.0, 18.0) + by), 1.0f)) : sun;
    result.view = test::perspective(osg::Vec3d(-20.0, -50.0, 30.0) + by, osg::Vec3d(0.0, 5.0, 0.0) + by, 320, 240, 50.0,
                                    1.0, far);
    return result;
}

const std::vector<glm::dvec3> places{
    {0.0, 0.0, 0.0}, {5e3, 0.0, 0.0}, {5e3, 5e3, 100.0}, {-2e4, 3e3, 0.0}, {6e4, 8e4, 300.0}};

// 100 km off, floats have steps of 8 mm: a pixel or two of ground is drawn over the foot of a box.
TEST(Scales, TracedIsRightWhereLargeCoordinatesAreInTheVertices) {
    for (const glm::dvec3& place : places)
        for (const bool lamp : {false, true})
            for (const double far : {200.0, 1e3})
                EXPECT_LE(wrong(baked(place, lamp, far), traced), place.x > 5e4 ? 2 : 0)
                    << place.x << (lamp ? ", a lamp, " : ", a sun, ") << far;
}

TEST(Scales, MapIsRightWhereLargeCoordinatesAreInTheVertices) {
    for (const glm::dvec3& place : places)
        for (const bool lamp : {false, true})
            for (const double far : {200.0, 1e3})
                EXPECT_EQ(wrong(baked(place, lamp, far), map, 2), 0)
                    << place.x << (lamp ? ", a lamp, " : ", a sun, ") << far;
}

/// Houses on a ground in UTM coordinates, as city models have them, seen from a hill: vertices and matrices of floats have steps of
/// half a metre there.
Case city() {
    Case result = baked({433000.0, 5410000.0, 0.0}, false, 600.0);
    const osg::Vec3d by(433000.0, 5410000.0, 0.0);
    result.view = test::perspective(osg::Vec3d(-60.0, -90.0, 70.0) + by, by, 320, 240, 40.0, 10.0, 600.0);
    return result;
}

std::vector<std::string> saidOf(const test::Scene& given, gnomon::ShadowTechnique* technique, const test::View& view) {
    test::Scene scene = given;
    const osg::ref_ptr<gnomon::ShadowTechnique> kept = technique;
    scene.addShadow(technique);
    test::render(scene.root, view);
    return technique->diagnose();
}

TEST(Scales, AutoCastsRaysWhereVerticesLieTooFarFromTheirOriginForDepths) {
    test::Scene scene = city().build(), rays = city().build();
    const osg::ref_ptr<gnomon::AutoShadowTechnique> chooser = new gnomon::AutoShadowTechnique;
    scene.addShadow(chooser);
    rays.addShadow(traced());
    EXPECT_EQ(test::render(scene.root, city().view).different(test::render(rays.root, city().view)), 0);
    ASSERT_EQ(chooser->lastDecision().size(), 1u);
    const std::string reason = chooser->lastDecision()[0].reason;
    EXPECT_NE(reason.find("'ground' lie far from their origin, an offset for a transform"), reason.npos) << reason;
}

TEST(Scales, WhatTakesDepthsForPlacesSaysWhereVerticesLieTooFarFromTheirOrigin) {
    const Case given = city();
    const osg::ref_ptr<osg::Node> local = baked({0.0, 0.0, 0.0}, false, 600.0).build().content;
    for (const Technique& technique : {Technique(map), Technique(volume), Technique(planar)}) {
        const std::vector<std::string> said = saidOf(given.build(), technique(), given.view);
        ASSERT_EQ(said.size(), 1u) << technique()->className();
        EXPECT_NE(said[0].find("'ground' lie so far from their origin"), std::string::npos) << said[0];
        test::Scene placed = test::scene(sun); // the cure
        const osg::ref_ptr<osg::MatrixTransform> offset =
            new osg::MatrixTransform(osg::Matrixd::translate(433000.0, 5410000.0, 0.0));
        offset->addChild(local);
        placed.content->addChild(offset);
        EXPECT_EQ(saidOf(placed, technique(), given.view), std::vector<std::string>()) << technique()->className();
    }
    EXPECT_EQ(saidOf(given.build(), traced(), given.view), std::vector<std::string>());
}

/// Tiles of a terrain that begins at the eye: as far from their origin as they are from the eye.
TEST(Scales, NothingIsSaidOfWhatIsAsFarAwayAsItsVerticesAreLarge) {
    Case given = boxOnAQuad(100.0, 40.0, 0.5, 1e5);
    for (double away = 50.0; away < 2e4; away *= 2.0)
        given.casters.push_back(test::box({away, away, -1.0}, {1.9 * away, 1.9 * away, 0.01 * away}));
    EXPECT_EQ(saidOf(given.build(), map(), given.view), std::vector<std::string>());
}

/// A transform that takes a box far away.
osg::ref_ptr<osg::Node> strayAt(const osg::Vec3d& place) {
    const osg::ref_ptr<osg::MatrixTransform> result = new osg::MatrixTransform(osg::Matrixd::translate(place));
    result->addChild(test::node(test::box({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0})));
    return result;
}

Case withStray(double distance, double size) {
    Case result{test::square(10.0 * size),
                {test::box({-size, -size, 0.0}, {size, size, 2.0 * size}),
                 test::box({3.0 * size, 2.0 * size, 0.0}, {4.0 * size, 3.0 * size, size})},
                sun,
                test::perspective({-6.0 * size, -10.0 * size, 7.0 * size}, {0.0, 0.0, 0.0}, 320, 240, 40.0, size,
                                  100.0 * size)};
    if (distance > 0.0) result.stray = strayAt({distance, 0.3 * distance, 0.0});
    return result;
}

TEST(Scales, ACasterFarAwayDoesNotShiftTheShadowsOfTheOthers) {
    for (const Technique& technique : {Technique(traced), Technique(map), Technique(planar)})
        for (const double distance : {0.0, 1e4, 1e5, 1e6, 1e7})
            EXPECT_EQ(wrong(withStray(distance, 1.0), technique), 0) << technique()->className() << " " << distance;
    for (const double distance : {0.0, 1e6, 1e7}) {
        Case given = withStray(distance, 1.0);
        given.light = {2.0, 1.0, 3.0, 1.0}; // between both, a metre above the larger one
        for (const Technique& technique : {Technique(traced), Technique(map)})
            EXPECT_EQ(wrong(given, technique, 2), 0) << technique()->className() << ", a lamp, " << distance;
    }
}

/// What moves by more than rounding is another light, and its maps are drawn again.
TEST(Scales, MapFollowsALightHoweverFarAwayACasterIs) {
    for (const osg::Vec4& light : {osg::Vec4(1.0f, 0.3f, 0.8f, 0.0f), osg::Vec4(-4.0f, -0.8f, 5.0f, 1.0f)}) {
        const osg::Vec4 moved = light + osg::Vec4(0.0f, 0.05f * light.z(), 0.0f, 0.0f);
        Case given = withStray(1e7, 1.0);
        given.light = light;
        test::Scene scene = given.build();
        scene.addShadow(map());
        test::Camera camera(scene.root, given.view);
        for (int frame = 0; frame < 4; ++frame) camera.frame();
        scene.light->getLight()->setPosition(moved);
        camera.frame();
        given.light = moved;
        test::Scene fresh = given.build();
        fresh.addShadow(map());
        EXPECT_LE(camera.frame().different(test::render(fresh.root, given.view)), 20) << "at edges: maps lie otherwise";
    }
}

/// Where most triangles are, vertices are fine: of a ground alone, the far box has more.
TEST(Scales, VolumeSaysWhereCastersAreTooFarApart) {
    const auto causes = [](Case given) {
        const osg::ref_ptr<gnomon::ShadowTechnique> technique = volume();
        test::Scene scene = given.build();
        scene.addShadow(technique);
        test::render(scene.root, given.view);
        return technique->diagnose();
    };
    Case ground = withStray(4.2e6, 1.0);
    EXPECT_TRUE(causes(ground).empty()) << causes(ground).front();
    ground.casters.clear();
    ASSERT_EQ(causes(ground).size(), 1u);
    EXPECT_NE(causes(ground).front().find("so far from one another"), std::string::npos) << causes(ground).front();
    for (const double distance : {0.0, 1e3, 1e4}) {
        ground.stray = strayAt({distance, 0.0, 0.0});
        EXPECT_TRUE(causes(ground).empty()) << distance << ": " << causes(ground).front();
    }
}

/// A box, and another far away in the same drawable, whose vertices are rounded as its own.
TEST(Scales, MapSaysWhereACasterIsSoLargeThatOthersLoseTheirShadow) {
    for (const double away : {1e4, 1e6}) {
        Case given = withStray(0.0, 1.0);
        const Mesh far = test::box({away, away, 0.0}, {away + 2.0, away + 2.0, 2.0});
        given.casters = {test::joined({given.casters[0], far})};
        const std::vector<std::string> said = saidOf(given.build(), map(), given.view);
        if (away < 1e5) {
            EXPECT_EQ(said, std::vector<std::string>());
            EXPECT_EQ(wrong(given, map, 2), 0);
        } else {
            ASSERT_EQ(said.size(), 1u);
            EXPECT_NE(said[0].find("one of the casters is so large"), std::string::npos) << said[0];
        }
    }
}

/// A sky, which casts nothing and receives as all that is seen does, takes no depth from the map of what is before it.
TEST(Scales, MapKeepsItsShadowsUnderASkyHoweverVast) {
    for (const double radius : {1e4, 1e5, 1e6, 1e7}) {
        Case given = withStray(0.0, 1.0);
        given.light = osg::Vec4d(-1.0, -0.7, 0.8, 0.0); // one sees down what the boxes darken, as far as the sky is
        given.view = test::perspective({-6.0, -10.0, 7.0}, {0.0, 0.0, 0.0}, 320, 240, 40.0, 1.0, 2.0 * radius);
        given.stray = test::node(test::insideOut(test::sphere({0.0, 0.0, 0.0}, radius, 16)), "sky");
        given.stray->setNodeMask(1);
        EXPECT_EQ(wrong(given, map, 2), 0) << radius;
    }
}

TEST(Scales, MapKeepsShadowsOfCentimetresOnALevelGroundOfKilometres) {
    for (const double half : {1e3, 1e4, 3e4, 1e5}) {
        Case given = withStray(0.0, 0.02);
        given.ground = test::square(half);
        EXPECT_EQ(wrong(given, map, 2), 0) << half;
    }
}

/// Nothing between them but 2 cm: by what floats make of numbers as large as the ground, they would lie in it.
TEST(Scales, SheetsOfCentimetresCastOnAGroundOfKilometres) {
    const Technique automatic = [] { return new gnomon::AutoShadowTechnique; };
    for (const double half : {10.0, 2e4}) {
        Case given = boxOnAQuad(2.0 * half, 4.0, 0.1, 1e4);
        given.casters = {test::quad({-0.06, -0.05, 0.02}, {0.09, 0.0, 0.0}, {0.0, 0.1, 0.0})};
        given.view = test::perspective({-0.12, -0.2, 0.16}, {0.0, 0.0, 0.0}, 320, 240, 40.0, 0.005, 5.0);
        for (const Technique& technique : {Technique(map), automatic}) EXPECT_EQ(wrong(given, technique, 2), 0) << half;
    }
}

/// What lies under a ground puts that into the map. A low sun makes much of it if the ground is drawn off its place.
TEST(Scales, MapDarkensNoVastGroundOverWhatIsBuriedInIt) {
    for (const double half : {1e4, 2e4, 29346.0, 4e4, 1e5})
        for (const int width : {128, 160, 256}) {
            const Case given{test::square(half),
                             {test::box({-2.95, -3.32, -0.6}, {-0.18, -0.97, -0.087})},
                             osg::Vec4d(-0.94313, -0.285606, 0.170103, 0.0),
                             test::perspective({0.552249, 22.6447, 17.3084}, {0.214287, -0.711781, 0.5}, width,
                                               3 * width / 4, 27.8368, 1.0, 3.0 * half)};
            test::Scene shadowed = given.build();
            shadowed.addShadow("map");
            const test::Picture lit = test::render(given.build().root, given.view),
                                drawn = test::render(shadowed.root, given.view);
            int darkened = 0;
            for (int y = 0; y < drawn.height; ++y)
                for (int x = 0; x < drawn.width; ++x) darkened += drawn.at(x, y) != lit.at(x, y);
            EXPECT_EQ(darkened, 0) << half << ", " << width;
        }
}

TEST(Scales, TracedShadowsOfCentimetresAreRightOnAGroundOfKilometres) {
    for (const double place : {0.0, 1e3, 4e3})
        for (const double size : {0.01, 0.05, 1.0}) {
            Case given = withStray(0.0, size);
            const glm::dvec3 by(place, 0.4 * place, 0.0);
            given.ground = asFloats(test::moved(test::square(5e3), -by)); // so that vertices of the small ones are fine
            EXPECT_EQ(wrong(given, traced), 0) << size << " m, from the middle " << place;
        }
}

/// A room of 8 × 8 × 4 m with a box in it, its walls single sheets that are seen from inside; lit by a lamp at a place.
Case roomWith(const osg::Vec4d& lamp, const glm::dvec3& offset) {
    const auto at = [&offset](const Mesh& mesh) { return asFloats(test::moved(mesh, offset)); };
    const osg::Vec3d by(offset.x, offset.y, offset.z);
    Case result;
    result.ground = at(test::square(4.0));
    const Mesh room = test::insideOut(test::box({-4.0, -4.0, 0.0}, {4.0, 4.0, 4.0}));
    result.casters = {at(room), at(test::box({0.5, 0.0, 0.5}, {1.5, 1.0, 1.5}))};
    result.light = osg::Vec4d(osg::Vec4(osg::Vec3(osg::Vec3d(lamp.x(), lamp.y(), lamp.z()) + by), 1.0f));
    result.view =
        test::perspective(osg::Vec3d(-3.0, -3.5, 3.0) + by, osg::Vec3d(1.0, 1.0, 0.0) + by, 320, 240, 60.0, 0.1, 30.0);
    return result;
}

/// By rays against the box alone, which walls that the lamp lies in do not change.
int wrongInRoom(const osg::Vec4d& lamp, const Technique& technique, const glm::dvec3& offset) {
    const Case given = roomWith(lamp, offset);
    test::Scene shadowed = given.build(), dark = given.build(), lit = given.build();
    shadowed.addShadow(technique());
    dark.takeLightAway();
    const test::Mask mask = test::castRays(given.ground, {given.casters[1]}, given.light, given.view);
    const test::Mask hidden = test::castRays(given.ground, given.casters, given.light, given.view);
    const test::Picture actual = test::render(shadowed.root, given.view), unlit = test::render(dark.root, given.view),
                        all = test::render(lit.root, given.view);
    EXPECT_GT(mask.count(test::Seen::ShadowedReceiver), 100) << "or this shows nothing";
    int result = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const test::Seen seen = mask.at(x, y);
            const bool floor = hidden.at(x, y) != test::Seen::Caster && hidden.at(x, y) != test::Seen::Nothing;
            if (!floor || mask.atEdge(x, y)) continue;
            result += actual.at(x, y) != (seen == test::Seen::ShadowedReceiver ? unlit : all).at(x, y);
        }
    return result;
}

TEST(Scales, ALampOnASurfaceIsNotBlockedByIt) {
    for (const Technique& technique : {Technique(traced), Technique(map)})
        for (const glm::dvec3& offset : {glm::dvec3(0.0), glm::dvec3(3.3, 700.7, 12.1)})
            for (const osg::Vec4d& lamp : {osg::Vec4d(0.3, -1.0, 4.0, 1.0), osg::Vec4d(4.0, 0.3, 2.5, 1.0),
                                           osg::Vec4d(4.0, 0.3, 4.0, 1.0), osg::Vec4d(0.3, -1.0, 4.0 - 1e-6, 1.0)})
                EXPECT_EQ(wrongInRoom(lamp, technique, offset), 0)
                    << technique()->className() << " " << offset.x << ": " << lamp.x() << " " << lamp.z();
}

} // namespace
