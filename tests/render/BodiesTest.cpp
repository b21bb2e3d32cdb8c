// SPDX-License-Identifier: MIT
// Bodies that move as a whole: pictures against the truth of their triangles where they are, in every technique.
#include "TracedCases.h"

#include <gnomon/Convert.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>

#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <functional>
#include <memory>

using test::Mesh;
using test::Picture;

namespace {

using Technique = std::function<osg::ref_ptr<gnomon::ShadowTechnique>()>;

osg::ref_ptr<gnomon::ShadowTechnique> traced() { return new gnomon::TracedShadowTechnique; }
osg::ref_ptr<gnomon::ShadowTechnique> mapped() { return new gnomon::ShadowMapTechnique; }
osg::ref_ptr<gnomon::ShadowTechnique> flattened() { return test::planar(); }

osg::Matrixd at(double turn, const osg::Vec3d& place, const osg::Vec3d& scale = {1.0, 1.0, 1.0}) {
    return osg::Matrixd::scale(scale) * osg::Matrixd::rotate(turn, osg::Vec3d(1.0, 2.0, 3.0)) *
           osg::Matrixd::translate(place);
}

/// Turned, mirrored, small, and stretched; one cuts the ground.
std::vector<osg::Matrixd> places(double step) {
    return {at(0.3 + step, {-4.0 + step, 3.0, 1.6}), at(1.1, {0.0, 3.0 - step, 2.5}, {-1.0, 1.0, 1.0}),
            at(2.0 - step, {4.0, 3.0, 1.0}, {0.5, 0.5, 0.5}), at(0.8, {-4.0, -2.0 + step, 2.2}, {0.6, 1.5, 1.0}),
            at(0.0, {0.0, -2.0, 0.2 + step})};
}

/// A sphere with a box in its side, both closed: 288 + 12 triangles.
Mesh body() {
    return test::joined({test::sphere({0.0, 0.0, 0.0}, 1.0, 12), test::box({0.4, -0.3, -0.3}, {1.8, 0.3, 0.3})});
}

Mesh moved(Mesh mesh, const osg::Matrixd& matrix) {
    for (glm::dvec3& corner : mesh) corner = glm::dvec3(gnomon::toGlm(matrix) * glm::dvec4(corner, 1.0));
    const bool mirrors = glm::determinant(glm::dmat3(gnomon::toGlm(matrix))) < 0.0;
    return mirrors ? test::insideOut(mesh) : mesh; // so that its outside stays outside
}

/// One geometry at all places, above a ground.
struct Bodies {
    explicit Bodies(const osg::Vec4d& light) : scene(test::scene(light)), sun(light) {
        scene.content->addChild(test::node(test::square(9.0), "ground"));
        const osg::ref_ptr<osg::Node> one = test::node(body(), "body");
        for (const osg::Matrixd& place : places(0.0)) {
            transforms.push_back(new osg::MatrixTransform(place));
            transforms.back()->addChild(one);
            scene.content->addChild(transforms.back());
        }
    }
    void move(double step) {
        for (std::size_t i = 0; i < transforms.size(); ++i) transforms[i]->setMatrix(places(step)[i]);
    }
    gnomon::TruthImage truth(double step) const {
        std::vector<Mesh> meshes{test::square(9.0)};
        for (const osg::Matrixd& place : places(step)) meshes.push_back(moved(body(), place));
        return test::truthOf(meshes, sun, view);
    }

    test::Scene scene;
    osg::Vec4d sun;
    std::vector<osg::ref_ptr<osg::MatrixTransform>> transforms;
    test::View view = test::perspective({-7.0, -14.0, 12.0}, {0.0, 0.5, 0.0}, 320, 240);
};

const std::vector<osg::Vec4d> lights{{1.0, 0.3, 1.2, 0.0}, {1.0, -1.0, 9.0, 1.0}};

/// A picture with shadows beside the same without, and without the light.
struct Trial {
    Trial(const osg::Vec4d& light, const Technique& technique) : shadowed(light), lit(light), dark(light) {
        dark.scene.takeLightAway();
        shadowed.scene.addShadow(technique());
        camera = std::make_unique<test::Camera>(shadowed.scene.root, shadowed.view);
    }
    test::TruthComparison step(double step) {
        for (Bodies* each : {&shadowed, &lit, &dark}) each->move(step);
        const Picture picture = camera->frame();
        return test::compare(picture, test::render(lit.scene.root, lit.view), test::render(dark.scene.root, dark.view),
                             lit.truth(step));
    }
    Bodies shadowed, lit, dark;
    std::unique_ptr<test::Camera> camera;
};

TEST(Bodies, AreTracedWhereTheyAre) {
    for (const osg::Vec4d& light : lights) {
        Trial trial(light, traced);
        for (const double step : {0.0, 0.25, 0.5}) {
            const test::TruthComparison found = trial.step(step);
            EXPECT_TRUE(found.good()) << step << ": " << found;
            EXPECT_GT(found.shadowed, 2000) << step;
        }
    }
}

// A map's edge is a texel beside the true one: no pixel away from edges may be wrong.
TEST(Bodies, AreInMapsWhereTheyAre) {
    for (const osg::Vec4d& light : lights) {
        Trial trial(light, mapped);
        for (const double step : {0.0, 0.25, 0.5}) {
            const test::TruthComparison found = trial.step(step);
            EXPECT_LE(found.certain, 2) << step << ": " << found;
            EXPECT_EQ(found.neither, 0) << step;
            EXPECT_GT(found.shadowed, 2000) << step;
        }
    }
}

/// Pixels of the ground alone, seen from above through the bodies' gaps: what the plane's shadow and a ray say differently.
int differentOnGround(const Picture& a, const Picture& b, const gnomon::TruthImage& truth) {
    int different = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        different += truth.pixels[i].receiver < 2 && !truth.pixels[i].isEdge() && a.pixels[i] != b.pixels[i];
    return different;
}

TEST(Bodies, AreFlattenedWhereTheyAre) {
    for (const osg::Vec4d& light : lights) {
        Trial trial(light, flattened), exact(light, traced);
        for (const double step : {0.0, 0.25, 0.5}) {
            trial.step(step);
            exact.step(step);
            EXPECT_EQ(differentOnGround(trial.camera->frame(), exact.camera->frame(), trial.lit.truth(step)), 0)
                << step;
        }
    }
}

TEST(Bodies, LookAsWhenTheyHadAlwaysBeenThere) {
    for (const Technique& technique : {Technique(traced), Technique(flattened)}) {
        Trial moving(lights[0], technique), fresh(lights[0], technique);
        for (const double step : {0.0, 0.2, 0.4}) moving.step(step);
        fresh.shadowed.move(0.4);
        EXPECT_EQ(moving.camera->frame().different(fresh.camera->frame()), 0);
    }
}

TEST(Bodies, ThatLieInThePlaneDoNotDarkenIt) {
    for (const bool moving : {false, true}) {
        test::Scene scene = test::scene(lights[0]), lit = test::scene(lights[0]);
        Mesh tiles;
        for (int i = 0; i < 256; ++i) {
            const Mesh tile = test::quad({i % 16 - 8.0, i / 16 - 8.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
            tiles.insert(tiles.end(), tile.begin(), tile.end());
        }
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
        place->addChild(test::node(tiles, "ground"));
        scene.content->addChild(place);
        scene.content->addChild(test::node(test::box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})));
        lit.content->addChild(test::node(tiles, "ground"));
        scene.addShadow(flattened());
        test::Camera camera(scene.root, test::fromAbove(7.0, 128));
        camera.frame();
        if (moving) place->setMatrix(osg::Matrixd::translate(0.5, 0.0, 0.0));
        const Picture picture = camera.frame();
        EXPECT_EQ(picture.at(20, 64), test::render(lit.root, test::fromAbove(7.0, 128)).at(20, 64)) << moving;
    }
}

} // namespace
