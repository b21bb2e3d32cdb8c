// SPDX-License-Identifier: MIT
// Shadow volumes against the truth image: hard scenes, views and lights.
// Shadow volumes where they break: lamps on casters and in them, eyes in shadow, bad meshes, many layers.
// Shadow volumes with what a scene brings along: cones of spots, samples, blending, more lights, other techniques.
#include "IntoTexture.h"
#include "TracedCases.h"

#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>

#include <gtest/gtest.h>
#include <osg/ConvexPlanarOccluder>
#include <osg/MatrixTransform>
#include <osg/OccluderNode>
#include <osg/Program>

#include <algorithm>
#include <array>
#include <iostream>

using namespace test;

using gnomon::ShadowVolumeTechnique;

namespace {

CaseTrial drawVolume(const TracedCase& given) { return {new ShadowVolumeTechnique, given}; }

/// As good as one ray a pixel can be, but for a few pixels that the rasteriser decides; and nothing is complained of.
/// @param least  pixels that are in shadow, or this shows nothing.
void expectFloor(const TracedCase& given, int least = 300) {
    const CaseTrial trial = drawVolume(given);
    const TruthComparison& found = trial.comparison;
    std::cout << given.name << ": " << found << "\n";
    EXPECT_LE(found.wrong, 1.10 * found.floor + 5) << given.name << ": " << found;
    EXPECT_EQ(found.certain, 0) << given.name << ": " << found;
    EXPECT_EQ(found.neither, 0) << given.name << ": " << found;
    EXPECT_GT(found.shadowed, least) << given.name;
    EXPECT_GT(found.edges, least / 5) << given.name;
    EXPECT_EQ(trial.causes, std::vector<std::string>()) << given.name;
}

/// The same case in a picture of this size.
TracedCase sized(TracedCase given, int width, int height) {
    given.view.width = width;
    given.view.height = height;
    return given;
}

TracedCase small(TracedCase given) { return sized(std::move(given), 320, 240); }

TEST(Volume, IsAsGoodAsOneRayAPixelCanBe) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) expectFloor(small(given));
}

TEST(Volume, IsSoInTiltedScenesAndUnderLowSuns) {
    TracedCase low = small(townOfHouses());
    low.name = "town, low sun";
    low.light = sunAt(17.0, 15.0);
    for (const TracedCase& given : {small(tilted(labEight())), small(tilted(room())), low}) expectFloor(given);
}

TEST(Volume, CountsFromBehindWhereTheEyeIsInShadow) {
    TracedCase given = small(townOfHouses());
    given.name = "in a street";
    given.light = sunAt(-100.0, 25.0);
    given.view = perspective({1.0, -20.0, 1.7}, {4.0, 20.0, 1.5}, 320, 240, 60.0, 0.1, 300.0);
    expectFloor(given);
}

namespace {

struct DrawsNothing : osg::Drawable::DrawCallback {
    void drawImplementation(osg::RenderInfo&, const osg::Drawable*) const override {}
};
struct CullsNothing : osg::NodeCallback {
    void operator()(osg::Node*, osg::NodeVisitor*) override {}
};

void setProgram(osg::Node& node, osg::Shader::Type type, const char* text) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(type, text));
    node.getOrCreateStateSet()->setAttributeAndModes(program);
}

/// Keeps all behind a square above the caster from being drawn.
osg::ref_ptr<osg::Node> occluderAbove() {
    osg::ref_ptr<osg::ConvexPlanarOccluder> square = new osg::ConvexPlanarOccluder;
    for (const osg::Vec3& corner : {osg::Vec3(-1.2f, -1.2f, 3.0f), osg::Vec3(1.2f, -1.2f, 3.0f),
                                    osg::Vec3(1.2f, 1.2f, 3.0f), osg::Vec3(-1.2f, 1.2f, 3.0f)})
        square->getOccluder().add(corner);
    osg::ref_ptr<osg::OccluderNode> node = new osg::OccluderNode;
    node->setOccluder(square);
    return node;
}

} // namespace

/// Its shadow is [-3, 0] × [-1, 1] m, at 32 pixels a metre, and nothing hides a part of it.
TEST(Volume, OfACasterThatTheViewDoesNotDrawLiesWhereItsShadowIsAlone) {
    const char* ways[] = {
        "cull callback", "draw callback", "discarded",      "moved",
        "small feature", "occluder",      "behind the eye", "behind the eye and before the near plane"};
    for (int way = 0; way < 8; ++way)
        for (const bool open : {false, true}) {
            const Mesh body = box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0}), sheet = square(1.0, 2.0);
            Scene scene = groundScene({open ? sheet : body});
            osg::Node& caster = *find(*scene.root, "caster");
            View view = fromAbove(4.0);
            if (way == 0) caster.setCullCallback(new CullsNothing);
            if (way == 1) caster.asGeode()->getDrawable(0)->setDrawCallback(new DrawsNothing);
            if (way == 2) setProgram(caster, osg::Shader::FRAGMENT, "void main() { discard; }");
            if (way == 3)
                setProgram(caster, osg::Shader::VERTEX,
                           "void main() { vec4 v = gl_Vertex; v.y += 50.0; "
                           "gl_Position = gl_ModelViewProjectionMatrix * v; gl_FrontColor = vec4(0.8); }");
            if (way == 5) scene.root->addChild(occluderAbove());
            if (way >= 6) {
                view.view = osg::Matrixd::lookAt(osg::Vec3d(0.0, 0.0, 0.5), osg::Vec3d(), osg::Vec3d(0.0, 1.0, 0.0));
                view.projection = osg::Matrixd::ortho(-4.0, 4.0, -4.0, 4.0, 0.1, 10.0);
            }
            // A pole that reaches behind the eye: the near plane is moved there.
            if (way == 7) scene.content->addChild(node(box({3.5, 3.5, 0.1}, {3.6, 3.6, 3.0}), "pole"));
            scene.addShadow(new ShadowVolumeTechnique);
            scene.group->setCasters({find(*scene.root, "caster")});
            Camera camera(scene.root, view);
            osg::Camera& settings = *camera.viewer().getCamera();
            if (way == 4) {
                settings.setCullingMode(settings.getCullingMode() | osg::CullSettings::SMALL_FEATURE_CULLING);
                settings.setSmallFeatureCullingPixelSize(200.0f);
            }
            if (way == 7) settings.setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
            const Picture picture = camera.frame();
            EXPECT_EQ(picture.count(shadowedGround), (open ? 64 : 96) * 64) << ways[way] << (open ? ", open" : "");
        }
}

/// In a still view, beside a named receiver that stays as it is: each frame is as the first of a scene that is so from the start.
TEST(Volume, OfACasterThatComesAndGoesInAStillViewFollowsIt) {
    const View aslant = perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.3}, 160, 120);
    const auto build = [] {
        Scene scene = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})});
        const osg::ref_ptr<ShadowVolumeTechnique> technique = new ShadowVolumeTechnique;
        technique->setReceiver({find(*scene.root, "ground")});
        scene.addShadow(technique);
        return scene;
    };
    const auto show = [](const Scene& scene, bool shown) {
        find(*scene.root, "caster")->setCullCallback(shown ? nullptr : new CullsNothing);
    };
    const Scene without = build(), scene = build();
    show(without, false);
    const Picture expected[] = {render(without.root, aslant), render(build().root, aslant)};
    EXPECT_GT(expected[0].different(expected[1]), 300);
    Camera camera(scene.root, aslant);
    for (const bool shown : {true, false, true, false}) {
        show(scene, shown);
        for (int frame = 0; frame < 2; ++frame) EXPECT_EQ(camera.frame().different(expected[shown]), 0) << shown;
    }
}

/// A program lowers the ground by 3 m in a still view: what ended below the ground goes on.
TEST(Volume, ReachesAGroundThatAProgramBeginsToLower) {
    const auto build = [] {
        Scene scene = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})});
        scene.addShadow("volume:composite=blend");
        return scene;
    };
    const auto lower = [](const Scene& scene) {
        setProgram(*find(*scene.root, "ground"), osg::Shader::VERTEX,
                   "void main() { vec4 v = gl_Vertex; v.z -= 3.0; gl_Position = gl_ModelViewProjectionMatrix * v; "
                   "gl_FrontColor = vec4(0.8); }");
    };
    const Scene fresh = build(), scene = build();
    lower(fresh);
    Camera camera(scene.root, fromAbove(8.0));
    for (int frame = 0; frame < 3; ++frame) camera.frame();
    lower(scene);
    const Picture now = camera.frame(), expected = render(fresh.root, fromAbove(8.0));
    EXPECT_EQ(now.different(expected), 0);
    EXPECT_GT(expected.different(render(build().root, fromAbove(8.0))), 500) << "the shadow falls elsewhere";
}

/// Nine of one drawable at a third of the size; the one in the middle is left out.
TEST(Volume, OfOneOfManyPlacesOfADrawableThatIsLeftOutHidesNothing) {
    Scene scene = groundScene({});
    const osg::ref_ptr<osg::Geode> body = node(box({-0.25, -0.25, 0.5}, {0.25, 0.25, 1.0}), "caster");
    for (int i = 0; i < 9; ++i) {
        const osg::ref_ptr<osg::MatrixTransform> place =
            new osg::MatrixTransform(osg::Matrixd::translate(-2.0 + 2.0 * (i % 3), -2.0 + 2.0 * (i / 3), 0.0));
        place->addChild(body);
        if (i == 4) place->setCullCallback(new CullsNothing);
        scene.content->addChild(place);
    }
    scene.addShadow(new ShadowVolumeTechnique);
    const Picture picture = render(scene.root, fromAbove(4.0));
    // Shadows are [-1.25, -0.25] × [-0.25, 0.25] m about each place: 32 × 16 pixels, of which no body hides any.
    EXPECT_EQ(picture.count(shadowedGround), 9 * 32 * 16);
}

// What a light's place by the eye is rounded to changes with each view.
TEST(Volume, OfALightAtRestIsFoundOnceWhileTheCameraMoves) {
    for (const osg::Vec4d& light : {osg::Vec4d(1.0, 0.4, 1.2, 0.0), osg::Vec4d(2.3, 1.7, 6.1, 1.0)}) {
        Scene scene = groundScene({box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})}, 8.0, light);
        const osg::ref_ptr<ShadowVolumeTechnique> technique = new ShadowVolumeTechnique;
        scene.addShadow(technique);
        const auto from = [](int step) {
            return perspective({-7.0 + 0.013 * step, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 96, 72);
        };
        Camera camera(scene.root, from(0));
        camera.frame();
        const unsigned before = technique->passes();
        EXPECT_GT(before, 0u);
        for (int step = 1; step <= 60; ++step) {
            camera.setView(from(step));
            camera.frame();
        }
        EXPECT_LE(technique->passes(), before + 1) << "once more, where it is known that what receives stands still";
    }
}

const View slanted = perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.3}, 160, 120);

TracedCase onGround(const char* name, const std::vector<Mesh>& casters, const osg::Vec4d& light,
                    const View& view = slanted) {
    TracedCase given{name, {square(6.0)}, light, view};
    given.meshes.insert(given.meshes.end(), casters.begin(), casters.end());
    return given;
}

Mesh without(Mesh mesh, std::size_t first, std::size_t triangles) {
    mesh.erase(mesh.begin() + std::ptrdiff_t(3 * first), mesh.begin() + std::ptrdiff_t(3 * (first + triangles)));
    return mesh;
}

Mesh turned(Mesh mesh, std::size_t every) {
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3 * every) std::swap(mesh[i + 1], mesh[i + 2]);
    return mesh;
}

Mesh twice(const Mesh& mesh) { return joined({mesh, mesh}); }

/// Triangles without an area, at corners and along edges.
Mesh withNeedles(Mesh mesh) {
    const std::size_t count = mesh.size();
    for (std::size_t i = 0; i < count; i += 3) {
        mesh.insert(mesh.end(), {mesh[i], mesh[i], mesh[i + 1]});
        mesh.insert(mesh.end(), {mesh[i], mesh[i + 1], (mesh[i] + mesh[i + 1]) / 2.0});
    }
    return mesh;
}

/// Each triangle in two, by the middle of its longest side: the neighbours' long sides pass new vertices by.
Mesh withJunctions(const Mesh& mesh, std::size_t every) {
    Mesh result;
    for (std::size_t i = 0; i < mesh.size(); i += 3) {
        std::array<glm::dvec3, 3> t{mesh[i], mesh[i + 1], mesh[i + 2]};
        if (i / 3 % every) {
            result.insert(result.end(), t.begin(), t.end());
            continue;
        }
        while (glm::distance(t[0], t[1]) < std::max(glm::distance(t[1], t[2]), glm::distance(t[2], t[0])))
            std::rotate(t.begin(), t.begin() + 1, t.end());
        const glm::dvec3 middle = 0.37 * t[0] + 0.63 * t[1];
        result.insert(result.end(), {t[0], middle, t[2], middle, t[1], t[2]});
    }
    return result;
}

/// Three sheets on one edge, as no surface has them.
Mesh fins() {
    const glm::dvec3 low(0.0), up(0.0, 0.0, 1.2);
    return joined({quad(low, {0.8, 0.2, 0.0}, up), quad(low, {-0.6, 0.5, 0.0}, up), quad(low, {-0.1, -0.8, 0.0}, up)});
}

/// One of each fault, on a ground.
std::vector<Mesh> badMeshes() {
    const Mesh house = test::house({0.0, 0.0}, {1.1, 0.9, 1.0}, 25.0), ball = sphere({0.0, 0.0, 0.7}, 0.6, 12);
    const std::vector<Mesh> all{
        without(ball, 20, 30),   turned(house, 3),       turned(ball, 2), twice(house), withNeedles(house), fins(),
        withJunctions(house, 2), withJunctions(ball, 3), insideOut(ball)};
    std::vector<Mesh> placed;
    for (std::size_t i = 0; i < all.size(); ++i)
        placed.push_back(moved(all[i], {3.0 * double(i % 3) - 3.0, 3.0 * double(i / 3) - 3.0, 0.01}));
    return placed;
}

TEST(VolumeMeshes, OfAnyFaultCastTheirShadow) {
    const View view = perspective({-6.0, -11.0, 10.0}, {0.3, 0.3, 0.0}, 320, 240);
    expectFloor(onGround("bad meshes, sun", badMeshes(), {0.8, 0.5, 1.0, 0.0}, view));
    expectFloor(onGround("bad meshes, low sun", badMeshes(), sunAt(200.0, 20.0), view));
    expectFloor(onGround("bad meshes, lamp", badMeshes(), {0.4, -0.3, 3.0, 1.0}, view));
}

TEST(VolumeMeshes, OfThreeHundredShellsAreCountedWithoutOverflow) {
    std::vector<Mesh> shells;
    for (int i = 1; i <= 300; ++i) {
        const double half = 0.7 + 0.002 * i;
        shells.push_back(box({-half, -half, 1.4 - half}, {half, half, 1.4 + half}));
    }
    expectFloor(onGround("shells", shells, {0.8, 0.5, 1.0, 0.0}));
}

TEST(VolumeLights, OnAVertexInAFacesPlaneAndInACasterAreRight) {
    const Mesh block = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}), post = box({2.0, -0.5, 0.0}, {2.5, 0.5, 1.0});
    expectFloor(onGround("above a vertex", {block, post}, {1.0, 1.0, 2.0 + 1e-4, 1.0}));
    expectFloor(onGround("in a face's plane", {block, post}, {3.5, 1.0, 3.0, 1.0}));
    expectFloor(onGround("in an edge's line", {block, post}, {1.0, 1.0, 3.5, 1.0}));
    expectFloor(onGround("sun along a face", {block, post}, {1.0, 0.0, 1.0, 0.0}));
    const Mesh cage = box({-3.0, -3.0, -0.5}, {3.0, 3.0, 3.5});
    expectFloor(onGround("in a closed caster", {cage, box({0.8, -0.4, 0.0}, {1.2, 0.4, 1.5})}, {0.0, 0.0, 3.0, 1.0},
                         perspective({0.5, -2.8, 2.8}, {1.5, 0.3, 0.0}, 160, 120, 60.0, 0.1, 20.0)));
}

TEST(VolumeViews, FromShadowAndThroughCutCastersAreRight) {
    const Mesh block = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}), post = box({2.0, -0.5, 0.0}, {2.5, 0.5, 1.0});
    const osg::Vec4d sun(-1.0, 0.2, 1.0, 0.0);
    expectFloor(onGround("eye in the shadow", {block, post}, sun,
                         perspective({1.3, 0.0, 0.8}, {3.0, 1.0, 0.0}, 160, 120, 70.0, 0.05, 40.0)));
    expectFloor(onGround("eye in a caster", {insideOut(box({-4.0, -4.0, -1.0}, {4.0, 4.0, 5.0})), block, post},
                         {-2.0, 0.5, 4.0, 1.0},
                         perspective({-3.0, -3.0, 3.0}, {1.0, 0.0, 0.0}, 160, 120, 70.0, 0.05, 40.0)));
    expectFloor(onGround("near plane through a caster", {block, post}, sun,
                         perspective({0.0, -3.0, 1.6}, {0.4, 0.0, 0.8}, 160, 120, 80.0, 2.6, 40.0)),
                200);
    View orthographic = slanted;
    orthographic.projection = osg::Matrixd::ortho(-5.0, 5.0, -3.75, 3.75, 1.0, 40.0);
    expectFloor(onGround("orthographic", {block, post}, sun, orthographic));
}

const std::vector<Mesh> casters{box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}), sphere({2.5, 1.0, 1.0}, 0.8, 16)};
const View view = perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.3}, 160, 120);

TracedCase given(const osg::Vec4d& light) {
    TracedCase all{"a box and a ball", {square(6.0)}, light, view};
    all.meshes.insert(all.meshes.end(), casters.begin(), casters.end());
    return all;
}

/// A ground of small squares, for OpenGL lights vertices.
Scene underSpot(bool lit) {
    TracedCase all = given({-2.0, -1.0, 6.0, 1.0});
    Mesh ground;
    for (int i = 0; i < 48 * 48; ++i) {
        const Mesh tile = quad({i % 48 * 0.25 - 6.0, i / 48 * 0.25 - 6.0, 0.0}, {0.25, 0.0, 0.0}, {0.0, 0.25, 0.0});
        ground.insert(ground.end(), tile.begin(), tile.end());
    }
    all.meshes.front() = ground;
    Scene scene = all.build();
    scene.light->getLight()->setDirection({0.3f, 0.2f, -1.0f});
    scene.light->getLight()->setSpotCutoff(32.0f);
    if (!lit) scene.takeLightAway();
    return scene;
}

TEST(VolumeCompany, ASpotCastsWithinItsCone) {
    Scene shadowed = underSpot(true);
    shadowed.addShadow(new ShadowVolumeTechnique);
    const Picture lit = render(underSpot(true).root, view), dark = render(underSpot(false).root, view);
    const TruthComparison found =
        compare(render(shadowed.root, view), lit, dark, given({-2.0, -1.0, 6.0, 1.0}).truth());
    EXPECT_LE(found.wrong, 1.10 * found.floor + 5) << found;
    EXPECT_EQ(found.certain, 0) << found;
    EXPECT_EQ(found.neither, 0) << found;
    EXPECT_GT(found.shadowed, 150) << found;
    EXPECT_LT(found.pixels, 9000) << "beyond the cone nothing is lit: " << found;
}

Picture inSamples(const Scene& scene) {
    IntoTexture into(scene.root, view,
                     {GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, 4});
    into.camera->frame();
    return into.camera->frame();
}

/// Four samples a pixel halve the error of one.
TEST(VolumeCompany, SeveralSamplesSmoothItsEdges) {
    const TracedCase all = given({1.0, 0.4, 1.2, 0.0});
    Scene shadowed = all.build(), dark = all.build();
    shadowed.addShadow(new ShadowVolumeTechnique);
    dark.takeLightAway();
    const Picture lit = inSamples(all.build()), unlit = inSamples(dark), cast = inSamples(shadowed);
    const CaseTrial single = drawVolume(all);
    const double one = single.shareOff(single.cast), four = shareOff(cast, lit, unlit, single.truth());
    EXPECT_LT(four, 0.6 * one);
    EXPECT_GT(one, 0.01) << "there are edges";
}

Scene underThree(const std::vector<osg::ref_ptr<gnomon::ShadowTechnique>>& techniques) {
    Scene scene = given({1.0, 0.4, 1.2, 0.0}).build();
    scene.light->getLight()->setDiffuse({0.3f, 0.2f, 0.1f, 1.0f});
    const osg::Vec4 more[] = {{-1.0f, 0.3f, 1.0f, 0.0f}, {0.5f, -2.0f, 5.0f, 1.0f}};
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
        light->getLight()->setLightNum(i + 1);
        light->getLight()->setPosition(more[i]);
        light->getLight()->setAmbient({0.0f, 0.0f, 0.0f, 1.0f});
        light->getLight()->setDiffuse({0.1f, 0.2f, 0.3f, 1.0f});
        light->getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        scene.root->addChild(light);
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1 + static_cast<unsigned>(i), osg::StateAttribute::ON);
    }
    if (!techniques.empty()) scene.addShadow(techniques.front());
    for (std::size_t i = 1; i < techniques.size(); ++i) scene.group->addChild(techniques[i]);
    return scene;
}

TEST(VolumeCompany, OfThreeLightsAtRestEachIsFoundOnce) {
    const osg::ref_ptr<ShadowVolumeTechnique> technique = new ShadowVolumeTechnique;
    const Scene scene = underThree({technique});
    Camera camera(scene.root, view);
    for (int i = 0; i < 3; ++i) camera.frame();
    const unsigned before = technique->passes();
    EXPECT_GT(before, 0u);
    for (int i = 0; i < 10; ++i) camera.frame();
    EXPECT_EQ(technique->passes(), before);
}

/// Of three lights rays and volumes say the same but for edges, and what stands beside volumes takes nothing away.
TEST(VolumeCompany, ThreeLightsAndOtherTechniquesTakeNothingFromIt) {
    const auto picture = [](const std::vector<osg::ref_ptr<gnomon::ShadowTechnique>>& techniques) {
        return render(underThree(techniques).root, view);
    };
    const Picture plain = picture({}), traced = picture({new gnomon::TracedShadowTechnique}),
                  volume = picture({new ShadowVolumeTechnique});
    EXPECT_GT(traced.different(plain), 1000);
    EXPECT_LE(volume.different(traced), 40) << "of some 400 pixels with edges";
    EXPECT_LE(picture({new ShadowVolumeTechnique, planar()}).different(volume), 10);
    EXPECT_LE(picture({planar(), new ShadowVolumeTechnique, new gnomon::TracedShadowTechnique}).different(traced), 40);
}

} // namespace
