// SPDX-License-Identifier: MIT
// What a technique leaves lit although its casters' shadow falls there is named. What no shadow reaches is not, nor what another
// technique shadows.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gtest/gtest.h>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/MatrixTransform>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

using namespace test;

namespace {

using Causes = std::vector<std::string>;

/// From the side of the light; the tower's shadow falls towards the far left.
const osg::Vec4d sun(1.0, 0.0, 1.0, 0.0);
const osg::Vec4d groundPlane(0.0, 0.0, 1.0, 0.0), wallPlane(1.0, 0.0, 0.0, 3.0);
const Mesh tower = box({-0.5, -0.5, 0.0}, {0.5, 0.5, 5.0});
/// Three metres behind the tower: its shadow climbs two metres up there.
const Mesh wall = box({-4.0, -3.0, 0.0}, {-3.0, 3.0, 4.0});
const View fromTheSide = perspective({9.0, -12.0, 9.0}, {-1.0, 0.0, 1.0}, 160, 120);

osg::ref_ptr<gnomon::ShadowTechnique> onTerrain(gnomon::TerrainShadowOptions::Method method) {
    const osg::ref_ptr<gnomon::TerrainShadowGeode> technique = new gnomon::TerrainShadowGeode;
    technique->setMethod(method);
    return technique;
}

/// The tower on its ground, and what else a test puts there.
struct Trial {
    explicit Trial(const osg::ref_ptr<osg::Node>& more, osg::ref_ptr<gnomon::ShadowTechnique> with = planar(),
                   const osg::Vec4d& light = sun)
        : scene(groundScene({tower}, 8.0, light)), technique(std::move(with)) {
        if (more) scene.content->addChild(more);
        technique->setName("floor");
        scene.addShadow(technique);
    }
    Trial& named() {
        technique->setReceiver({find(*scene.root, "ground")});
        return *this;
    }
    Causes said() {
        if (!camera) camera = std::make_unique<Camera>(scene.root, fromTheSide);
        camera->frame();
        return technique->diagnose();
    }

    Scene scene;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    std::unique_ptr<Camera> camera;
};

bool namesNone(const Causes& causes) {
    for (const std::string& cause : causes)
        if (cause.find("leaves lit") != std::string::npos) return false;
    return true;
}

Causes leavesLit(const Trial& trial, const std::string& surface) {
    return {trial.technique->describe() + ": the casters' shadow can fall on '" + surface +
            "', which this technique leaves lit. Use map, volume or traced, or add a technique that receives there."};
}

osg::ref_ptr<osg::Node> placed(const Mesh& mesh, const char* name, const osg::Matrixd& place) {
    const osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(place);
    transform->addChild(node(mesh, name));
    return transform;
}

const Causes nothing;

} // namespace

TEST(UnshadowedSurfaces, AWallBehindATowerIsNamed) {
    const auto expectNamed = [](osg::ref_ptr<gnomon::ShadowTechnique> technique, bool named, const char* what) {
        Trial trial(node(wall, "wall"), technique);
        if (named) trial.named();
        EXPECT_EQ(trial.said(), leavesLit(trial, "wall")) << what;
        EXPECT_EQ(trial.said(), leavesLit(trial, "wall")) << what << ", in a frame in which nothing changed, too";
    };
    expectNamed(planar(), false, "planar");
    expectNamed(planar(), true, "planar with a receiver");
    expectNamed(onTerrain(gnomon::TerrainShadowOptions::BOX), true, "box");
    expectNamed(onTerrain(gnomon::TerrainShadowOptions::HULL), true, "hull");
}

// (6, 0, 9), which OpenGL takes for the same lamp.
TEST(UnshadowedSurfaces, AWallIsNamedIfTheLampIsGivenWithANegativeW) {
    Trial trial(node(wall, "wall"), planar(), {-6.0, 0.0, -9.0, -1.0});
    EXPECT_EQ(trial.said(), leavesLit(trial, "wall"));
}

// A mast, 6 m high, belongs to the ground's drawable. The ground does not hide what is above the mast from a lamp below.
TEST(UnshadowedSurfaces, AWallIsNamedIfTheGroundRisesAboveTheLamp) {
    const Mesh high = box({-4.0, -3.0, 6.5}, {-3.0, 3.0, 9.0}), mast = box({7.0, 7.0, 0.0}, {7.2, 7.2, 6.0});
    Trial trial(node(high, "wall"), onTerrain(gnomon::TerrainShadowOptions::HULL), {2.0, 0.0, 3.0, 1.0});
    trial.scene.content->replaceChild(find(*trial.scene.root, "ground"), node(joined({square(8.0), mast}), "ground"));
    const Causes causes = trial.named().said();
    EXPECT_EQ(std::count(causes.begin(), causes.end(), leavesLit(trial, "wall").front()), 1)
        << testing::PrintToString(causes);
}

TEST(UnshadowedSurfaces, ASecondFloorIsNamed) {
    // Under a low sun the tower's shadow goes on over the ground's edge, 8 m away, and down 2.5 m.
    Trial trial(node(box({-30.0, -7.0, -3.0}, {8.0, 7.0, -2.5}), "lower floor"), planar(), {3.0, 0.0, 1.0, 0.0});
    EXPECT_EQ(trial.said(), leavesLit(trial, "lower floor"));
}

TEST(UnshadowedSurfaces, ARoomOfOneMeshIsNamed) {
    const Mesh room = joined({quad({-4.0, -4.0, 0.0}, {0.0, 8.0, 0.0}, {0.0, 0.0, 4.0}),
                              quad({-4.0, 4.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, 4.0})});
    Trial trial(node(room, "room"), planar(), {2.0, -2.0, 7.0, 1.0});
    EXPECT_EQ(trial.said(), leavesLit(trial, "room"));
}

TEST(UnshadowedSurfaces, WhatNoShadowReachesIsNot) {
    const auto expectSilent = [](const char* what, const osg::ref_ptr<osg::Node>& more, const osg::Vec4d& light = sun) {
        Trial trial(more, planar(), light);
        EXPECT_TRUE(namesNone(trial.said())) << what;
        Trial onGround(more, onTerrain(gnomon::TerrainShadowOptions::HULL), light);
        EXPECT_TRUE(namesNone(onGround.named().said())) << what << ", hull";
    };
    expectSilent("a tower alone", nullptr);
    expectSilent("a wall beside the shadow", placed(wall, "wall", osg::Matrixd::translate(0.0, 5.0, 0.0)));
    expectSilent("a wall behind the end of the shadow", node(box({-8.0, -3.0, 0.0}, {-7.0, 3.0, 1.0}), "wall"));
    // Along the shadow and 1.2 m beside its middle, of which the shadow takes 0.7; the box along the axes reaches over it.
    expectSilent("a wall askew",
                 placed(box({-1.6, -0.1, 0.0}, {1.6, 0.1, 4.0}), "wall",
                        osg::Matrixd::rotate(osg::PI_4, osg::Z_AXIS) * osg::Matrixd::translate(-3.35, -1.65, 0.0)),
                 {1.0, 1.0, 1.0, 0.0});
    expectSilent("a roof above the lamp", node(box({-5.0, -5.0, 7.0}, {5.0, 5.0, 7.5}), "roof"), {0.0, 0.0, 6.0, 1.0});
    const osg::ref_ptr<osg::Node> unlit = node(wall, "picture");
    unlit->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    expectSilent("what is not lit", unlit);
}

/// As in data/lab8.osgt: the shadow of the cube meets the ball where it turns away from the sun, and in the floor.
TEST(UnshadowedSurfaces, ABallThatIsSunkInTheFloorIsNotNamedForItsLowerHalf) {
    Scene scene = groundScene({box({0.25, -0.25, 0.0}, {0.75, 0.25, 0.5}), sphere({-0.5, 0.0, 0.25}, 0.5, 24)}, 2.0,
                              {0.5, -0.5, 0.707, 0.0});
    const auto technique = planar();
    scene.addShadow(technique);
    render(scene.root, fromTheSide);
    EXPECT_EQ(technique->diagnose(), nothing);
}

// The box of its vertices is a metre high.
TEST(UnshadowedSurfaces, ASlantedFloorGetsItsShadow) {
    for (const bool named : {false, true}) {
        Scene slanted = scene(sun);
        slanted.content->addChild(node(quad({-4.0, -3.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 6.0, 1.0}), "ground"));
        slanted.content->addChild(node(box({-0.5, -0.5, 1.5}, {0.5, 0.5, 2.5}), "box"));
        const osg::ref_ptr<gnomon::PlanarShadowNode> technique =
            new gnomon::PlanarShadowNode(osg::Vec4d(0.0, -1.0, 6.0, -3.0));
        if (named) technique->setReceiver({find(*slanted.content, "ground")});
        slanted.addShadow(technique);
        render(slanted.root, fromTheSide);
        EXPECT_EQ(technique->diagnose(), nothing) << "receiver named: " << named;
    }
}

/// The same under a ceiling, and a lamp below it that is given with w = -1.
TEST(UnshadowedSurfaces, ABallThatIsSunkInTheCeilingIsNotNamedForItsUpperHalf) {
    Scene scene = test::scene({-0.5, 0.5, 0.707, -1.0});
    for (const Mesh& mesh : {quad({-2.0, -2.0, 0.0}, {0.0, 4.0, 0.0}, {4.0, 0.0, 0.0}),
                             box({0.25, -0.25, -0.5}, {0.4, -0.1, 0.0}), sphere({-0.5, 0.0, -0.25}, 0.5, 24)})
        scene.content->addChild(node(mesh));
    const auto technique = planar();
    technique->setPlanes({{0.0, 0.0, -1.0, 0.0}});
    scene.addShadow(technique);
    render(scene.root, perspective({3.0, -4.0, -3.0}, {-0.3, 0.0, 0.0}, 160, 120));
    EXPECT_EQ(technique->diagnose(), nothing);
}

/// Down there, beside the tower's shadow, only the ground's own falls, which is another cause.
TEST(UnshadowedSurfaces, WhatLiesUnderTheTerrainIsNotNamed) {
    Trial trial(node(box({-20.0, 4.0, -1.5}, {7.0, 7.5, -1.0}), "cellar"),
                onTerrain(gnomon::TerrainShadowOptions::HULL));
    EXPECT_TRUE(namesNone(trial.named().said()));
}

TEST(UnshadowedSurfaces, AFloorMayBeTheTopOfASlab) {
    Trial trial(nullptr);
    trial.scene.content->replaceChild(find(*trial.scene.root, "ground"),
                                      node(box({-8.0, -8.0, -1.0}, {8.0, 8.0, 0.0}), "ground"));
    EXPECT_EQ(trial.said(), nothing);
}

/// 12 m wide: what is 2 cm out of the plane may be taken for a part of it by depths, and then casts on itself; what is 10 cm out
/// of it is not.
TEST(UnshadowedSurfaces, ACarpetThatStandsOutOfThePlaneIsNamed) {
    const auto carpet = [](double height) { return node(box({-9.0, -6.0, -0.3}, {3.0, 6.0, height}), "carpet"); };
    Trial thick(carpet(0.1)), thin(carpet(0.02));
    EXPECT_EQ(thick.said(), leavesLit(thick, "carpet"));
    ASSERT_EQ(thin.said().size(), 1u);
    EXPECT_NE(thin.said()[0].find("'carpet' is 0.02 above the plane (0 0 1 0)"), std::string::npos) << thin.said()[0];
}

/// The far side of a screen that is drawn from one side alone, as that of a mirror's floor is.
TEST(UnshadowedSurfaces, WhatFaceCullingLeavesOutIsNot) {
    const Mesh towardsTheEye = quad({-3.0, -3.0, 0.0}, {0.0, 6.0, 0.0}, {0.0, 0.0, 4.0}),
               away = quad({-3.0, 3.0, 0.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 4.0});
    const auto said = [](const Mesh& mesh, osg::CullFace::Mode culled, osg::FrontFace::Mode front, bool isOn = true) {
        const osg::ref_ptr<osg::Node> screen = node(mesh, "screen");
        screen->getOrCreateStateSet()->setAttribute(new osg::CullFace(culled));
        screen->getOrCreateStateSet()->setAttribute(new osg::FrontFace(front));
        screen->getOrCreateStateSet()->setMode(GL_CULL_FACE, isOn);
        Trial trial(screen);
        const bool isNamed = !namesNone(trial.said());
        trial.technique->setNodeMask(0u); // without shadows, a screen that is culled changes no pixel
        const Picture with = render(trial.scene.root, fromTheSide);
        screen->setNodeMask(0u);
        EXPECT_EQ(isNamed, render(trial.scene.root, fromTheSide).different(with) > 0);
        return isNamed;
    };
    EXPECT_TRUE(said(towardsTheEye, osg::CullFace::BACK, osg::FrontFace::COUNTER_CLOCKWISE));
    EXPECT_FALSE(said(away, osg::CullFace::BACK, osg::FrontFace::COUNTER_CLOCKWISE));
    EXPECT_TRUE(said(away, osg::CullFace::FRONT, osg::FrontFace::COUNTER_CLOCKWISE));
    EXPECT_FALSE(said(towardsTheEye, osg::CullFace::FRONT, osg::FrontFace::COUNTER_CLOCKWISE));
    EXPECT_TRUE(said(away, osg::CullFace::BACK, osg::FrontFace::CLOCKWISE));
    EXPECT_FALSE(said(away, osg::CullFace::FRONT, osg::FrontFace::CLOCKWISE));
    EXPECT_FALSE(said(towardsTheEye, osg::CullFace::FRONT_AND_BACK, osg::FrontFace::COUNTER_CLOCKWISE));
    EXPECT_TRUE(said(away, osg::CullFace::BACK, osg::FrontFace::COUNTER_CLOCKWISE, false)) << "nothing is culled";
}

TEST(UnshadowedSurfaces, APlaneForTheWallIsTheRemedy) {
    const osg::ref_ptr<gnomon::PlanarShadowNode> technique = planar();
    const Mesh flat = quad({-3.0, -3.0, 0.0}, {0.0, 6.0, 0.0}, {0.0, 0.0, 4.0});
    Trial trial(node(flat, "wall"), technique);
    EXPECT_EQ(trial.said(), leavesLit(trial, "wall"));
    technique->addPlane(wallPlane);
    EXPECT_EQ(trial.said(), nothing) << "in the very next frame";
    technique->setPlanes({groundPlane});
    EXPECT_EQ(trial.said(), leavesLit(trial, "wall"));
}

/// z = 0 of a frame that is turned and moved: the wall's plane.
TEST(UnshadowedSurfaces, APlaneIsWhereTransformsAboveTheTechniquePutIt) {
    const Mesh flat = quad({-3.0, -3.0, 0.0}, {0.0, 6.0, 0.0}, {0.0, 0.0, 4.0});
    Trial trial(node(flat, "wall"));
    EXPECT_EQ(trial.said(), leavesLit(trial, "wall"));
    const osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::rotate(osg::Vec3d(0.0, 0.0, 1.0), osg::Vec3d(1.0, 0.0, 0.0)) *
                                 osg::Matrixd::translate(-3.0, 0.0, 0.0));
    place->addChild(planar());
    trial.scene.group->addChild(place);
    EXPECT_EQ(trial.said(), nothing);
}

TEST(UnshadowedSurfaces, AnotherTechniqueIsTheRemedy) {
    Trial trial(node(wall, "wall"));
    EXPECT_EQ(trial.named().said(), leavesLit(trial, "wall"));
    const osg::ref_ptr<gnomon::ShadowMapTechnique> map = new gnomon::ShadowMapTechnique;
    trial.scene.group->addChild(map);
    EXPECT_EQ(trial.said(), nothing);
    EXPECT_EQ(map->diagnose(), nothing);
    map->setReceiver({find(*trial.scene.root, "ground")});
    EXPECT_EQ(trial.said(), leavesLit(trial, "wall")) << "on the same ground";
    map->setReceiver({find(*trial.scene.root, "wall")});
    EXPECT_EQ(trial.said(), nothing);
}

TEST(UnshadowedSurfaces, IsForgottenOnceTheLightIsElsewhere) {
    Trial trial(node(wall, "wall"));
    EXPECT_EQ(trial.said(), leavesLit(trial, "wall"));
    trial.scene.light->getLight()->setPosition({0.0f, 1.0f, 1.0f, 0.0f});
    EXPECT_EQ(trial.said(), nothing);
}
