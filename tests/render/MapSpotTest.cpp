// SPDX-License-Identifier: MIT
// Lamps with a cutoff: what is outside the cone, or in a caster's shadow, gets none of their light.
// Lamps among casters, below their tops and under them, against the truth image.
#include "TracedCases.h"

#include <gnomon/Convert.h>
#include <gnomon/ShadowMapTechnique.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <support/Oracle.h>
#include <support/Panels.h>
#include <support/Scene.h>

#include <cmath>
#include <iostream>

using gnomon::ShadowLight;
using gnomon::ShadowMapTechnique;
using namespace test;

namespace {

/// On a ground of half side 8, at z = 0.
struct Spot {
    osg::Vec3d place, direction;
    double cutoff; ///< degrees.

    osg::Vec4d light() const { return {place, 1.0}; }
    ShadowLight asGiven() const { return {0, light(), direction, cutoff}; }
    /// By the angle between the axis and the way there, as OpenGL has it.
    bool lights(const glm::dvec3& point) const {
        const glm::dvec3 way = glm::normalize(point - gnomon::toGlm(place));
        return glm::dot(way, glm::normalize(gnomon::toGlm(direction))) >= std::cos(osg::DegreesToRadians(cutoff));
    }
};

const Spot down{{0.5, 0.3, 6.0}, {0.0, 0.0, -1.0}, 30.0};
const Spot slanting{{-3.0, -2.0, 5.0}, {1.4, 1.0, -1.6}, 24.0}; // of a direction that is not of length 1
const Spot wide{{0.0, 0.0, 1.6}, {0.1, 0.0, -1.0}, 72.0};
const Spot nearlyFlat{{0.0, 0.5, 2.5}, {0.0, -1.0, -0.12}, 85.0}; // wider than one map can be

const View view = perspective({-2.0, -12.0, 11.0}, {0.0, 0.0, 0.0});

/// One in the middle, one that reaches out of `down`'s cone, one that is all outside of it.
std::vector<Mesh> casters() {
    return {box({-0.5, -0.6, 0.0}, {0.6, 0.3, 1.0}), box({2.0, 1.0, 0.0}, {4.2, 1.8, 0.7}),
            box({-4.5, 3.0, 0.3}, {-3.0, 4.5, 0.9})};
}

Scene build(const Spot& spot) { return groundScene(casters(), 8.0, spot.light()); }

/// What is expected of each pixel that shows the ground.
Mask expected(const Spot& spot) {
    Mask mask = castRays(square(8.0), casters(), spot.light(), view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            Seen& seen = mask.pixels[std::size_t(y * view.width + x)];
            const Sight sight = test::sight(view, x + 0.5, y + 0.5);
            if (seen == Seen::LitReceiver && !spot.lights(sight.from - sight.way * (sight.from.z / sight.way.z)))
                seen = Seen::ShadowedReceiver;
        }
    return mask;
}

struct Judged {
    int lit = 0, dark = 0, wrong = 0;
    int told = 0; ///< of `dark`, those that the ground alone shows otherwise.
};

/// Of the ground's pixels but those at edges; a map's texel is less than a pixel here.
/// @param plain  builds the same without shadows.
Judged judge(const Spot& spot, const Scene& shadowed, Scene (*plain)(const Spot&)) {
    Scene lit = plain(spot), unlit = plain(spot);
    unlit.takeLightAway();
    const Mask mask = expected(spot);
    const Picture picture = render(shadowed.root, view), asLit = render(lit.root, view),
                  asDark = render(unlit.root, view);
    Judged result;
    for (int y = 1; y + 1 < view.height; ++y)
        for (int x = 1; x + 1 < view.width; ++x) {
            const Seen seen = mask.at(x, y);
            if (seen == Seen::Nothing || seen == Seen::Caster || mask.atEdge(x, y)) continue;
            const bool dark = seen == Seen::ShadowedReceiver;
            ++(dark ? result.dark : result.lit);
            result.told += dark && asLit.at(x, y) != asDark.at(x, y);
            result.wrong += picture.at(x, y) != (dark ? asDark : asLit).at(x, y);
        }
    return result;
}

osg::ref_ptr<ShadowMapTechnique> sharpMap() {
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(2048);
    return technique;
}

TEST(MapSpot, OfALightThatShinesAllAroundLeavesTheConeLessItsShadowsToThePixel) {
    for (const Spot& spot : {down, slanting, wide, nearlyFlat})
        for (const bool named : {false, true}) {
            Scene scene = build(spot);
            const osg::ref_ptr<ShadowMapTechnique> technique = sharpMap();
            if (named) technique->setReceiver({find(*scene.root, "ground")});
            scene.addShadow(technique);
            scene.group->addLight(spot.asGiven());
            const Judged result = judge(spot, scene, build);
            EXPECT_EQ(result.wrong, 0) << spot.cutoff;
            EXPECT_GT(result.lit, 3000) << spot.cutoff;
            EXPECT_GT(result.told, 3000) << spot.cutoff;
            EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
        }
}

/// Where relighting cannot be, for something uses stencil itself, shadows are blended: not what is outside the cone.
TEST(MapSpot, ThatCannotBeRelitDarkensNothingOutsideItsCone) {
    Scene scene = build(down), other = build(down);
    const Mesh stencilled = box({-1.5, -1.8, 0.0}, {-1.2, -1.5, 0.3});
    for (Scene* each : {&scene, &other}) {
        each->content->addChild(node(stencilled));
        each->content->getChild(each->content->getNumChildren() - 1)
            ->getOrCreateStateSet()
            ->setMode(GL_STENCIL_TEST, osg::StateAttribute::ON);
    }
    const osg::ref_ptr<ShadowMapTechnique> technique = sharpMap();
    scene.addShadow(technique);
    scene.group->addLight(down.asGiven());
    const Picture picture = render(scene.root, view), plain = render(other.root, view);
    EXPECT_FALSE(technique->diagnose().empty());
    int inCone = 0, outside = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const Sight sight = test::sight(view, x + 0.5, y + 0.5);
            const glm::dvec3 onGround = sight.from - sight.way * (sight.from.z / sight.way.z);
            const bool isFar = glm::distance(glm::dvec2(onGround), glm::dvec2(0.5, 0.3)) > 5.0; // the cone's is 3.5
            if (picture.at(x, y) != plain.at(x, y)) ++(isFar ? outside : inCone);
        }
    EXPECT_EQ(outside, 0);
    EXPECT_GT(inCone, 50);
}

/// A ground of squares of side 1, for OpenGL lights vertices.
Mesh tiled() {
    Mesh ground;
    for (int i = 0; i < 256; ++i)
        for (const glm::dvec3& corner : quad({i % 16 - 8.0, i / 16 - 8.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}))
            ground.push_back(corner);
    return ground;
}

/// An OpenGL spot under a transform that turns and moves it to where it is to be.
Scene buildTurned(const Spot& spot) {
    Scene scene = build(spot);
    auto* old = find(*scene.root, "ground")->asGeode();
    old->removeDrawables(0, old->getNumDrawables());
    old->addDrawable(node(tiled())->getDrawable(0));
    const osg::Matrixd turn =
        osg::Matrixd::rotate(osg::Vec3d(0.0, 1.0, 0.0), spot.direction) * osg::Matrixd::translate(spot.place);
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(turn);
    scene.root->replaceChild(scene.light, transform);
    transform->addChild(scene.light);
    osg::Light& light = *scene.light->getLight();
    light.setPosition({0.0f, 0.0f, 0.0f, 1.0f});
    light.setDirection({0.0f, 1.0f, 0.0f});
    light.setSpotCutoff(float(spot.cutoff));
    return scene;
}

TEST(MapSpot, OfOpenGLUnderATransformIsFoundWithItsConeOrNamed) {
    for (const Spot& spot : {down, slanting})
        for (const bool named : {false, true}) {
            Scene scene = buildTurned(spot);
            scene.addShadow(sharpMap());
            if (named) scene.group->addLight(scene.light);
            const Judged result = judge(spot, scene, buildTurned);
            EXPECT_EQ(result.wrong, 0) << spot.cutoff;
            EXPECT_GT(result.lit, 3000) << spot.cutoff;
            EXPECT_GT(result.told, 300) << spot.cutoff << ": what OpenGL lights of squares that reach out of the cone";
        }
}

/// The group itself under a transform: cone and casters are told in its frame.
TEST(MapSpot, IsWhereItIsUnderAGroupThatIsTurnedAndScaled) {
    Scene scene = build(slanting);
    scene.addShadow(sharpMap());
    const osg::Matrixd worldFromGroup = osg::Matrixd::scale(2.0, 2.0, 2.0) *
                                        osg::Matrixd::rotate(0.7, osg::Vec3d(0.3, -0.2, 1.0)) *
                                        osg::Matrixd::translate(3.0, -1.0, 2.0);
    const osg::Matrixd groupFromWorld = osg::Matrixd::inverse(worldFromGroup);
    osg::ref_ptr<osg::MatrixTransform> outer = new osg::MatrixTransform(worldFromGroup),
                                       inner = new osg::MatrixTransform(groupFromWorld);
    inner->addChild(scene.content);
    scene.group->replaceChild(scene.content, inner);
    scene.root->replaceChild(scene.group, outer);
    outer->addChild(scene.group);
    ShadowLight spot = slanting.asGiven();
    spot.inGroup = spot.inGroup * groupFromWorld;
    spot.direction = osg::Matrixd::transform3x3(spot.direction, groupFromWorld);
    scene.group->addLight(spot);
    const Judged result = judge(slanting, scene, build);
    // Lighting of vertices under other matrices rounds otherwise: in a few pixels by one step of 255.
    EXPECT_LE(result.wrong, (result.lit + result.dark) / 100);
    EXPECT_GT(result.lit, 3000);
}

TEST(MapSpot, HasOneMapAndDrawsItAgainOnlyWhenItTurns) {
    Scene scene = build(wide);
    const osg::ref_ptr<ShadowMapTechnique> technique = sharpMap();
    scene.addShadow(technique);
    scene.group->addLight(wide.asGiven());
    Camera camera(scene.root, view);
    camera.frame();
    EXPECT_EQ(technique->passes(), 1u) << "a lamp without a cone has several here";
    camera.frame();
    EXPECT_EQ(technique->passes(), 1u);
    ShadowLight turned = wide.asGiven();
    turned.direction = {0.0, 0.1, -1.0};
    scene.group->setLights({turned});
    camera.frame();
    EXPECT_EQ(technique->passes(), 2u);
    turned.cutoff = 75.0;
    scene.group->setLights({turned});
    camera.frame();
    EXPECT_EQ(technique->passes(), 3u) << "a wider cone, another map";
    turned.cutoff = 180.0;
    scene.group->setLights({turned});
    camera.frame();
    EXPECT_GT(technique->passes(), 4u);
}

TEST(MapSpot, WhoseConeMeetsNoCasterIsStillDarkAround) {
    const Spot spot{{4.5, -4.5, 6.0}, {0.0, 0.0, -1.0}, 20.0};
    Scene scene = build(spot);
    scene.addShadow(sharpMap());
    scene.group->addLight(spot.asGiven());
    const Judged result = judge(spot, scene, build);
    EXPECT_EQ(result.wrong, 0);
    EXPECT_GT(result.lit, 1000);
}

/// OpenGL has drawn what is outside without the light: to blend it would darken it twice.
TEST(MapSpot, BlendDarkensShadowsWithinTheConeAlone) {
    std::vector<Mesh> meshes = casters(); // and one in a corner of the map, outside the cone
    meshes.push_back(box({2.9, 2.7, 0.0}, {3.3, 3.1, 0.5}));
    Scene scene = groundScene(meshes, 8.0, down.light()), lit = groundScene(meshes, 8.0, down.light());
    scene.addShadow(sharpMap());
    scene.group->addLight(down.asGiven());
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    const Mask shadows = castRays(square(8.0), meshes, down.light(), view);
    const Picture blended = render(scene.root, view), asLit = render(lit.root, view);
    int within = 0, outside = 0, wrong = 0;
    for (int y = 1; y + 1 < view.height; ++y)
        for (int x = 1; x + 1 < view.width; ++x) {
            if (shadows.at(x, y) != Seen::ShadowedReceiver || shadows.atEdge(x, y)) continue;
            const Sight sight = test::sight(view, x + 0.5, y + 0.5);
            const glm::dvec3 at = sight.from - sight.way * (sight.from.z / sight.way.z);
            const double distance = glm::length(glm::dvec2(at) - glm::dvec2(0.5, 0.3)) * std::sqrt(3.0) / 6.0;
            if (std::abs(distance - 1.0) < 0.02) continue; // at the cone's edge
            ++(distance < 1.0 ? within : outside);
            wrong += (blended.at(x, y) != asLit.at(x, y)) != (distance < 1.0);
        }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(within, 50);
    EXPECT_GT(outside, 300);
}

TEST(MapSpot, OfNoDirectionOrOfACutoffThatIsNoneIsALampAllAround) {
    const auto picture = [](const osg::Vec3d& direction, double cutoff) {
        Scene scene = build(down);
        scene.addShadow(sharpMap());
        scene.group->addLight(ShadowLight{0, down.light(), direction, cutoff});
        return render(scene.root, view);
    };
    const Picture lamp = picture({0.0, 0.0, -1.0}, 180.0);
    EXPECT_GT(picture({0.0, 0.0, -1.0}, 30.0).different(lamp), 10000);
    for (const double cutoff : {90.5, -1.0, double(NAN), double(INFINITY)})
        EXPECT_EQ(picture({0.0, 0.0, -1.0}, cutoff).different(lamp), 0) << cutoff;
    for (const osg::Vec3d& direction : {osg::Vec3d(), osg::Vec3d(NAN, 0.0, 1.0)})
        EXPECT_EQ(picture(direction, 30.0).different(lamp), 0);
}

/// Things of half a metre to four, a table among them, on a ground, from above.
TracedCase amongThings(const osg::Vec3d& lamp) {
    return {"among things",
            {square(8.0), house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0), house({-2.0, 1.0}, {1.0, 1.5, 1.2}, -20.0),
             house({0.5, -2.5}, {1.2, 0.8, 0.5}, 10.0), box({-0.3, 2.2, 0.0}, {0.1, 2.6, 4.0}),
             sphere({-1.5, -2.0, 1.2}, 0.7, 32), box({3.2, -3.0, 0.7}, {5.0, -1.8, 0.8}),
             box({-5.0, -4.0, 0.0}, {-4.9, 0.0, 3.0})},
            osg::Vec4d(lamp, 1.0),
            perspective({-7.0, -11.0, 13.0}, {0.0, 0.0, 0.0}, 400, 300)};
}

struct Place {
    const char* name;
    osg::Vec3d lamp;
};

const Place places[] = {{"below their tops", {0.0, 0.0, 0.4}}, {"higher, but below the highest", {0.3, 0.2, 1.5}},
                        {"beside a wall", {-4.6, -2.0, 1.0}},  {"near the ground", {-3.2, -1.0, 0.1}},
                        {"under a table", {4.0, -2.4, 0.4}},   {"close to a house", {0.9, -1.0, 1.0}},
                        {"outside", {7.0, 6.0, 1.5}},          {"over them", {0.5, 0.5, 6.0}}};

// The goal.
constexpr double mostWrong = 0.005; // of the pixels away from edges

TEST(MapLamps, AmongCastersAndBelowTheirTopsAreWrongInNoMoreThanAHalfPercentAwayFromEdges) {
    for (const Place& place : places) {
        const TracedCase given = amongThings(place.lamp);
        const Judge judge(given);
        const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
        Scene shadowed = given.build();
        shadowed.addShadow(technique);
        Camera camera(shadowed.root, given.view);
        for (const int size : {512, 1024, 2048}) {
            technique->setSize(size);
            const TruthComparison found = judge.compare(camera.frame());
            std::cout << place.name << ", size " << size << ": " << found << "\n";
            EXPECT_LE(found.certain, mostWrong * (found.pixels - found.edges)) << place.name << ", size " << size;
            EXPECT_EQ(found.neither, 0) << place.name;
            EXPECT_GT(found.shadowed, 300) << place.name; // a lamp near the ground lights little of it
        }
        EXPECT_EQ(technique->diagnose(), std::vector<std::string>()) << place.name;
    }
}

/// A box 6 m from a lamp that hangs 6 m up, and a stick 0.2 m from it, on a ground so long.
TracedCase onALargeGround(double half) {
    return {"large ground",
            {square(half), box({5.0, -1.0, 0.0}, {6.0, 1.0, 2.0}), box({-0.2, -0.05, 4.0}, {-0.1, 0.05, 6.5}),
             box({-2.0, -3.0, 0.0}, {-1.0, -2.0, 5.5})},
            {0.0, 0.0, 6.0, 1.0},
            perspective({-6.0, -12.0, 5.0}, {3.0, 6.0, 2.0}, 400, 300, 50.0, 1.0, 4.0 * half)};
}

// A ground that is seen far away is in the same maps as what is near the lamp.
TEST(MapLamps, KeepTheShadowsOfWhatIsNearThemHoweverLargeTheGroundIs) {
    for (const double half : {10.0, 400.0, 1000.0, 1500.0}) {
        const CaseTrial trial(new ShadowMapTechnique, onALargeGround(half));
        const TruthComparison& found = trial.comparison;
        std::cout << "ground of " << 2.0 * half << " m: " << found << "\n";
        EXPECT_LE(found.certain, mostWrong * found.shadowed) << half;
        EXPECT_GT(found.shadowed, 3000) << half;
        EXPECT_EQ(trial.causes, std::vector<std::string>()) << half;
    }
}

} // namespace
