// SPDX-License-Identifier: MIT
// A node that keeps a light from nearly all that is seen is named. Long shadows, tables, mountains and lamps indoors are not.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/Geode>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace test;

namespace {

const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0), lowSun(1.0, 0.3, 0.12, 0.0), lamp(1.0, 1.0, 4.0, 1.0);
const Mesh tower = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
const View fromTheSide = perspective({-6.0, -9.0, 6.0}, {0.0, 0.0, 0.0}, 160, 120);

/// As a Geode of several drawables.
osg::ref_ptr<osg::Node> inParts(const std::vector<Mesh>& meshes, const std::string& name) {
    const osg::ref_ptr<osg::Geode> all = new osg::Geode;
    all->setName(name);
    for (const Mesh& mesh : meshes) {
        const osg::ref_ptr<osg::Node> one = node(mesh);
        all->addDrawable(one->asGroup()->getChild(0)->asDrawable());
    }
    return all;
}

Mesh dome() { return insideOut(sphere({0.0, 0.0, 0.0}, 40.0, 16)); }

std::vector<Mesh> skyBox() {
    const double a = 50.0;
    return {box({-a, -a, a}, {a, a, a + 1.0}), box({-a, -a, -a - 1.0}, {a, a, -a}),
            box({a, -a, -a}, {a + 1.0, a, a}), box({-a - 1.0, -a, -a}, {-a, a, a}),
            box({-a, a, -a}, {a, a + 1.0, a}), box({-a, -a - 1.0, -a}, {a, -a, a})};
}

/// A bowl of hills around the ground, 30 high, and open above.
Mesh valley() {
    Mesh mesh;
    constexpr int sides = 48;
    const auto at = [](int i, double radius, double height) {
        const double angle = 2.0 * osg::PI * i / sides;
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), height);
    };
    for (int i = 0; i < sides; ++i) {
        const glm::dvec3 a = at(i, 20.0, -1.0), b = at(i + 1, 20.0, -1.0), c = at(i + 1, 60.0, 30.0),
                         d = at(i, 60.0, 30.0);
        for (const glm::dvec3& corner : {a, b, c, a, c, d}) mesh.push_back(corner);
    }
    return mesh;
}

struct Trial {
    Trial(const osg::ref_ptr<osg::Node>& added, gnomon::ShadowTechnique* with, const osg::Vec4d& light = sun)
        : scene(groundScene({tower}, 8.0, light)), technique(with) {
        if (added) scene.content->addChild(added);
        scene.addShadow(technique);
    }
    /// What it says, after a frame.
    std::vector<std::string> said() {
        if (!camera) camera = std::make_unique<Camera>(scene.root, fromTheSide);
        camera->frame();
        return technique->diagnose();
    }
    bool names(const std::string& name) {
        for (const std::string& cause : said())
            if (cause.find("nearly all that light 0 could reach in this view is in the shadow of '" + name + "'") !=
                std::string::npos)
                return true;
        return false;
    }

    Scene scene;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    std::unique_ptr<Camera> camera;
};

const std::vector<std::string> nothing;

} // namespace

TEST(EnclosingCasters, ADomeOverEverythingIsNamed) {
    for (const auto& technique : std::vector<osg::ref_ptr<gnomon::ShadowTechnique>>{
             planar(), new gnomon::ShadowMapTechnique, new gnomon::TracedShadowTechnique}) {
        Trial trial(node(dome(), "dome"), technique);
        EXPECT_TRUE(trial.names("dome")) << technique->className();
        EXPECT_TRUE(trial.names("dome")) << "in a frame in which nothing changed, too";
    }
}

TEST(EnclosingCasters, SixSidesOfASkyAreOneNode) {
    Trial trial(inParts(skyBox(), "sky"), new gnomon::TracedShadowTechnique);
    EXPECT_TRUE(trial.names("sky"));
}

TEST(EnclosingCasters, IsForgottenOnceTheNodeIsTakenOut) {
    const osg::ref_ptr<osg::Node> sky = node(dome(), "dome");
    Trial trial(sky, new gnomon::TracedShadowTechnique);
    EXPECT_TRUE(trial.names("dome"));
    sky->setNodeMask(0x2);
    trial.scene.group->setCasters({nullptr, ~0x2u});
    EXPECT_EQ(trial.said(), nothing);
    EXPECT_GT(trial.camera->frame().count(shadowedGround), 100) << "the tower's shadow";
}

TEST(EnclosingCasters, OthersAreNot) {
    const auto expectSilent = [](const char* what, const osg::ref_ptr<osg::Node>& added, const osg::Vec4d& light) {
        Trial trial(added, new gnomon::TracedShadowTechnique, light);
        EXPECT_EQ(trial.said(), nothing) << what;
    };
    expectSilent("a tower", nullptr, sun);
    expectSilent("long shadows", nullptr, lowSun);
    expectSilent("mountains at dusk", node(valley(), "hills"), lowSun);
    expectSilent("a lamp under a dome", node(dome(), "dome"), lamp);
    expectSilent("a roof", node(box({-9.0, -9.0, 5.0}, {9.0, 9.0, 5.5}), "roof"), sun);
    expectSilent("a wall", node(box({9.0, -30.0, -1.0}, {10.0, 30.0, 40.0}), "wall"), sun);
    expectSilent("a pavilion",
                 inParts({box({-9.0, -9.0, 5.0}, {9.0, 9.0, 5.5}), box({-9.0, -9.0, -1.0}, {-8.5, -8.5, 5.0}),
                          box({8.5, 8.5, -1.0}, {9.0, 9.0, 5.0})},
                         "pavilion"),
                 {0.0, 0.0, 1.0, 0.0});
}
