// SPDX-License-Identifier: MIT
// Maps while casters move: the picture is that of maps which never saw them elsewhere, and what stands still is drawn once.
#include "GlComplaints.h"
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

using gnomon::ShadowMapTechnique;
using test::Camera;
using test::Mesh;
using test::Picture;
using test::Scene;
using test::TracedCase;
using test::View;

namespace {

/// Where each thing that moves is; nullopt where it is not in the scene.
using Moment = std::vector<std::optional<osg::Vec3d>>;

/// What stands still, what moves, and how it is lit.
struct Play {
    std::string name;
    TracedCase given;
    std::vector<osg::ref_ptr<osg::Node>> movers;
    std::function<void(ShadowMapTechnique&)> change{}; ///< may be none, as the next.
    std::function<void(Scene&)> light{};
    bool first = false; ///< what moves comes before what stands still.
};

struct Stage {
    explicit Stage(const Play& play) : scene(play.given.build()), first(play.first) {
        for (const auto& mover : play.movers) {
            places.push_back(new osg::MatrixTransform);
            places.back()->addChild(mover);
        }
        technique->setSize(512);
        if (play.change) play.change(*technique);
        scene.addShadow(technique);
        if (play.light) play.light(scene);
    }

    void set(const Moment& moment) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            scene.content->removeChild(places[i]);
            if (!moment[i]) continue;
            places[i]->setMatrix(osg::Matrixd::translate(*moment[i]));
            scene.content->insertChild(first ? 0 : scene.content->getNumChildren(), places[i]);
        }
    }

    Scene scene;
    std::vector<osg::ref_ptr<osg::MatrixTransform>> places;
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    bool first;
};

const View view = test::perspective({-9.0, -13.0, 11.0}, {0.0, 0.0, 0.0}, 320, 240);

/// All that can cast lies between posts, so that where it moves changes no map's place.
std::vector<Mesh> betweenPosts() {
    std::vector<Mesh> meshes{test::square(12.0), test::house({-2.0, 1.0}, {1.0, 1.5, 1.2}, -20.0),
                             test::sphere({2.5, 2.0, 1.0}, 0.8, 24)};
    for (const double x : {-6.0, 6.0})
        for (const double y : {-6.0, 6.0}) meshes.push_back(test::box({x, y, 0.0}, {x + 0.2, y + 0.2, 4.0}));
    return meshes;
}

TracedCase inSun() { return {"sun", betweenPosts(), {0.9, 0.4, 1.2, 0.0}, view}; }

/// The same about a lamp: a carpet under all, and in each of its maps something nearer to it than what moves.
TracedCase byLamp() {
    const osg::Vec3d lamp(0.3, 0.2, 2.6);
    std::vector<Mesh> meshes = betweenPosts();
    meshes.push_back(test::box({-11.0, -11.0, 0.0}, {11.0, 11.0, 0.05}));
    for (const osg::Vec3d& way : {osg::Vec3d(0.2, 0, 0), {-0.2, 0, 0}, {0, 0.2, 0}, {0, -0.2, 0}, {0, 0, -0.2}}) {
        const glm::dvec3 middle(lamp.x() + way.x(), lamp.y() + way.y(), lamp.z() + way.z());
        meshes.push_back(test::box(middle - 0.01, middle + 0.01));
    }
    return {"lamp", meshes, osg::Vec4d(lamp, 1.0), view};
}

osg::ref_ptr<osg::Node> aBox() { return test::node(test::box({-0.5, -0.4, 0.3}, {0.5, 0.6, 1.1})); }
osg::ref_ptr<osg::Node> aBall() { return test::node(test::sphere({0.0, 0.0, 0.6}, 0.5, 24)); }
osg::ref_ptr<osg::Node> aBoard() { return test::node(test::quad({-1.0, -0.8, 1.5}, {2.0, 0.0, 0.0}, {0.0, 1.6, 0.0})); }

/// A chequered pane: of every second square there is nothing.
osg::ref_ptr<osg::Node> aFence() {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned y = 0; y < 8; ++y)
        for (unsigned x = 0; x < 8; ++x) image->setColor({1.0f, 1.0f, 1.0f, (x + y) % 2 ? 1.0f : 0.0f}, x, y);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(which, osg::Texture::NEAREST);
    osg::ref_ptr<osg::Geometry> fence =
        osg::createTexturedQuadGeometry({-1.0f, 0.2f, 0.3f}, {2.0f, 0.3f, 0.0f}, {0.1f, 0.2f, 2.0f});
    fence->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    fence->getStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
    return fence;
}

/// The same in a sun, where something flat is in the maps at all times.
TracedCase underABoard() {
    TracedCase given = inSun();
    given.meshes.push_back(test::quad({-4.0, 3.0, 3.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}));
    return given;
}

/// A play of the scene in sun, or another, with a box and a ball that move; what else is special is said after.
Play play(const std::string& name, const TracedCase& given = inSun()) { return {name, given, {aBox(), aBall()}}; }

/// Each kind of light, edges, composite and mover.
std::vector<Play> plays() {
    const auto soft = [](ShadowMapTechnique& technique) {
        technique.setEdges(ShadowMapTechnique::SOFT);
        technique.setSunAngle(4.0);
    };
    const auto smooth = [](ShadowMapTechnique& technique) { technique.setEdges(ShadowMapTechnique::SMOOTH); };
    const auto twoSuns = [](Scene& scene) {
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        scene.group->setLights({{0, {0.9, 0.4, 1.2, 0.0}}, {1, {-0.6, 0.8, 1.0, 0.0}}});
    };
    const auto blend = [](Scene& scene) { scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND); };
    const auto spot = [](Scene& scene) {
        scene.group->addLight(gnomon::ShadowLight{0, {0.3, 0.2, 2.6, 1.0}, {0.1, -0.5, -1.0}, 55.0});
    };
    Play moversFirst = play("MoversFirst"), blended = play("Blend"), inTwoSuns = play("TwoSuns"),
         smoothBlended = play("SmoothBlend"), softly = play("Soft"), softBlended = play("SoftBlend"),
         fence = play("Fence"), fences = play("TwoFences"), board = play("Board", underABoard()),
         lampFence = play("LampFence", byLamp()), inSpot = play("Spot", byLamp()),
         street = play("Street", test::longStreet(45.0));
    moversFirst.first = true;
    blended.light = smoothBlended.light = softBlended.light = blend;
    inTwoSuns.light = twoSuns;
    smoothBlended.change = smooth;
    softly.change = softBlended.change = soft;
    fence.movers = {aFence(), aBall()};
    fences.movers = {aFence(), aFence()};
    board.movers = {aBoard(), aBox()};
    lampFence.movers = {aFence(), aBox()};
    inSpot.light = spot;
    street.movers = {test::node(test::box({20.0, -2.0, 0.0}, {22.0, 0.0, 2.0})),
                     test::node(test::box({60.0, -2.0, 0.0}, {64.0, 1.0, 7.0}))};
    street.given.view = test::perspective({-10.0, 0.0, 2.5}, {100.0, 0.0, 0.0}, 320, 240, 40.0, 0.2, 3000.0);
    street.change = [](ShadowMapTechnique& technique) { technique.setCascades(3); };
    return {play("Sun"), moversFirst, play("TiltedGround", test::tilted(inSun())),
            blended,     inTwoSuns,   smoothBlended,
            softly,      softBlended, fence,
            fences,      board,       play("Lamp", byLamp()),
            lampFence,   inSpot,      street};
}

void PrintTo(const Play& play, std::ostream* out) { *out << play.name; }

/// By maps that never saw another moment, in a context of its own.
Picture freshPicture(const Play& play, const Moment& moment, const View& from) {
    Stage stage(play);
    stage.set(moment);
    return test::render(stage.scene.root, from);
}

/// The same, all in one context, which is sooner done.
class FreshPictures {
public:
    explicit FreshPictures(const View& from) : _camera(new osg::Group, from) {}

    Picture of(const Play& play, const Moment& moment) {
        Stage stage(play);
        stage.set(moment);
        _camera.viewer().setSceneData(stage.scene.root);
        const Picture picture = _camera.frame();
        _camera.viewer().setSceneData(new osg::Group);
        return picture;
    }

private:
    Camera _camera;
};

/// One stands at first and moves, stops, goes and comes back; another comes later, before it or behind it.
const std::vector<Moment> toAndFro{
    {osg::Vec3d(-3.0, -3.0, 0.0), std::nullopt},
    {osg::Vec3d(-3.0, -3.0, 0.0), std::nullopt},
    {osg::Vec3d(-2.0, -2.5, 0.2), std::nullopt},
    {osg::Vec3d(-0.7, -2.0, 0.4), osg::Vec3d(3.0, -2.0, 0.0)},
    {osg::Vec3d(-0.7, -2.0, 0.4), osg::Vec3d(3.0, -1.0, 0.0)},
    {osg::Vec3d(-0.7, -2.0, 0.4), osg::Vec3d(3.0, -1.0, 0.0)},
    {std::nullopt, osg::Vec3d(1.5, 0.0, 0.5)},
    {std::nullopt, std::nullopt},
    {osg::Vec3d(2.0, -3.0, 0.0), osg::Vec3d(1.0, 0.2, 0.5)},
    {osg::Vec3d(2.2, -3.0, 0.0), std::nullopt},
};

class MapLayersOf : public testing::TestWithParam<Play> {};
INSTANTIATE_TEST_SUITE_P(Plays, MapLayersOf, testing::ValuesIn(plays()),
                         [](const auto& one) { return one.param.name; });

TEST_P(MapLayersOf, ShowEachFrameAsMapsDoThatSawNoOther) {
    const Play& play = GetParam();
    Stage stage(play);
    Camera camera(stage.scene.root, play.given.view);
    FreshPictures fresh(play.given.view);
    Picture before;
    for (std::size_t i = 0; i < toAndFro.size(); ++i) {
        stage.set(toAndFro[i]);
        const Picture picture = camera.frame();
        // Balls are drawn without the faces that are turned away, once these are known. At an outline both are as near, and
        // rounding tells which is nearer.
        EXPECT_LE(picture.different(fresh.of(play, toAndFro[i])), 5) << i;
        const bool changes = i > 0 && toAndFro[i] != toAndFro[i - 1];
        EXPECT_TRUE(!changes || picture.different(before) > 20) << i << ": a change shows";
        before = picture;
    }
    EXPECT_EQ(stage.technique->diagnose(), std::vector<std::string>());
}

TEST(MapLayers, ShowEachOfTwoViewsWhatIsTrueThere) {
    const Play play{"sun", inSun(), {aBox(), aFence()}};
    const View other = test::perspective({9.0, -10.0, 5.0}, {0.0, 0.0, 1.0}, 320, 240);
    Stage stage(play);
    Camera first(stage.scene.root, view), second(stage.scene.root, other);
    FreshPictures firstFresh(view), secondFresh(other);
    for (std::size_t i = 0; i < toAndFro.size(); ++i) {
        stage.set(toAndFro[i]);
        EXPECT_EQ(first.frame().different(firstFresh.of(play, toAndFro[i])), 0) << i;
        if (i % 3 == 1) continue; // one that is looked at now and then
        EXPECT_EQ(second.frame().different(secondFresh.of(play, toAndFro[i])), 0) << i;
    }
}

/// Calls with a camera's context made current.
template <class Call>
auto inContext(Camera& camera, const Call& call) {
    osg::GraphicsContext& context = *camera.context().graphicsContext();
    context.makeCurrent();
    const auto result = call(*context.getState());
    context.releaseContext();
    return result;
}

TEST(MapLayers, AreMadeAnewWhereOpenGLLostThem) {
    const Play play{"sun", inSun(), {aBox(), aFence()}};
    Stage stage(play);
    for (int again = 0; again < 2; ++again) { // in a context of its own each time
        Camera camera(stage.scene.root, view);
        const auto expectRight = [&](std::size_t i) {
            const Picture picture = camera.frame(), fresh = freshPicture(play, toAndFro[i], view);
            EXPECT_TRUE(again > 0 || picture.different(fresh) == 0) << i;
            EXPECT_EQ(test::differingBlocks(picture, fresh), 0) << "laid while something moved, see below; " << i;
        };
        for (std::size_t i = 0; i < toAndFro.size(); ++i) {
            stage.set(toAndFro[i]);
            expectRight(i);
            if (i % 2 == 0) continue;
            inContext(camera, [&](osg::State& state) {
                stage.scene.root->releaseGLObjects(&state);
                return 0;
            });
            expectRight(i);
        }
    }
}

// Maps are laid with some room about what moves, so that their texels are not those of maps laid anew: edges may be off by a
// part of a texel, which is 1.5 pixels wide where it is widest.
TEST(MapLayers, FollowWhatLeavesAllOthersBehind) {
    for (Play play : {Play{"sun", inSun(), {aBox(), aBall()}}, Play{"lamp", byLamp(), {aBox(), aBall()}},
                      Play{"board", inSun(), {aBoard(), aBall()}}}) {
        play.given.meshes[0] = test::square(40.0);
        play.given.view = test::perspective({-20.0, -30.0, 22.0}, {0.0, 0.0, 0.0}, 320, 240);
        play.change = [](ShadowMapTechnique& technique) { technique.setSize(2048); };
        Stage stage(play);
        Camera camera(stage.scene.root, play.given.view);
        FreshPictures freshPictures(play.given.view);
        for (int step = 0; step <= 40; ++step) {
            const double x = 0.7 * (step <= 20 ? step : 40 - step);
            const Moment moment{osg::Vec3d(-2.0 - x, 0.3 * x, 0.1 * x), osg::Vec3d(2.0 + 0.3 * x, -2.0, 0.0)};
            stage.set(moment);
            const Picture picture = camera.frame();
            if (step % 5 > 0) continue;
            const Picture fresh = freshPictures.of(play, moment);
            EXPECT_EQ(test::differingBlocks(picture, fresh), 0) << play.name << ", " << step;
            EXPECT_LE(picture.different(fresh), 400) << play.name << ", " << step;
        }
        EXPECT_EQ(stage.technique->diagnose(), std::vector<std::string>()) << play.name;
    }
}

/// Of a frame, by OpenGL's own count.
int trianglesDrawn(Camera& camera) {
    GLuint query = 0, count = 0;
    inContext(camera, [&](osg::State& state) {
        const auto& gl = *state.get<osg::GLExtensions>();
        gl.glGenQueries(1, &query);
        gl.glBeginQuery(GL_PRIMITIVES_GENERATED, query);
        return 0;
    });
    camera.frame();
    inContext(camera, [&](osg::State& state) {
        const auto& gl = *state.get<osg::GLExtensions>();
        gl.glEndQuery(GL_PRIMITIVES_GENERATED);
        gl.glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
        gl.glDeleteQueries(1, &query);
        return 0;
    });
    return int(count);
}

/// Drawn in the next frame.
struct Drawn {
    Drawn(Stage& stage, Camera& camera) {
        const unsigned before = stage.technique->passes();
        triangles = trianglesDrawn(camera);
        maps = stage.technique->passes() - before;
    }
    int triangles;
    unsigned maps;
};

TEST(MapLayers, DrawWhatMovesAlone) {
    constexpr int boxTriangles = 12;
    Play play{"sun", inSun(), {aBox()}};
    play.given.meshes.push_back(test::sphere({0.0, 4.0, 1.0}, 0.5, 64));
    play.light = [](Scene& scene) { scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND); };
    int all = boxTriangles;
    for (std::size_t i = 1; i < play.given.meshes.size(); ++i) all += int(play.given.meshes[i].size() / 3);
    Stage stage(play);
    Camera camera(stage.scene.root, view);
    stage.set({osg::Vec3d(-3.0, -3.0, 0.0)});
    camera.frame();
    const Drawn still(stage, camera);
    EXPECT_EQ(still.maps, 0u);
    stage.set({osg::Vec3d(-3.0, -2.9, 0.0)});
    const Drawn started(stage, camera);
    EXPECT_EQ(started.maps, 1u);
    EXPECT_EQ(started.triangles, still.triangles + all) << "what stood still until now has begun to move";
    for (int step = 0; step < 100; ++step) {
        stage.set({osg::Vec3d(-3.0, -2.8 + 0.05 * step, 0.0)});
        const Drawn moved(stage, camera);
        EXPECT_EQ(moved.maps, 1u) << step;
        EXPECT_EQ(moved.triangles, still.triangles + boxTriangles) << step;
    }
    EXPECT_EQ(Drawn(stage, camera).triangles, still.triangles + all) << "it comes to rest";
    EXPECT_EQ(Drawn(stage, camera).triangles, still.triangles) << "and stands still";
}

// A sixteenth of some 13 m is room for 0.8 m; it goes 5 m beyond all others.
TEST(MapLayers, DrawAllNowAndThenForWhatLeavesThem) {
    Play play{"sun", inSun(), {aBox()}};
    play.given.meshes[0] = test::square(40.0);
    play.light = [](Scene& scene) { scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND); };
    Stage stage(play);
    Camera camera(stage.scene.root, view);
    stage.set({osg::Vec3d(-5.0, 0.0, 0.0)});
    camera.frame();
    const int still = Drawn(stage, camera).triangles;
    int all = 0;
    for (int step = 1; step <= 100; ++step) {
        stage.set({osg::Vec3d(-5.0 - 0.06 * step, 0.0, 0.0)});
        all += Drawn(stage, camera).triangles > still + 300; // of 600; clipping at the window's edge makes a few more
    }
    EXPECT_LE(all, 8);
    EXPECT_GE(all, 2) << "first when it begins to move";
}

// A lamp over the middle has a map down and one to each side; what moves in a corner of the ground is in two at most.
TEST(MapLayers, AreDrawnWhereSomethingMovesAlone) {
    Play play{"lamp", byLamp(), {aBox()}};
    Stage stage(play);
    Camera camera(stage.scene.root, view);
    stage.set({osg::Vec3d(-5.0, 0.0, 0.0)});
    EXPECT_GE(Drawn(stage, camera).maps, 5u);
    stage.set({osg::Vec3d(-5.0, 0.1, 0.0)});
    EXPECT_GE(Drawn(stage, camera).maps, 5u) << "it has begun to move";
    for (int step = 2; step < 10; ++step) {
        stage.set({osg::Vec3d(-5.0, 0.1 * step, 0.0)});
        const unsigned maps = Drawn(stage, camera).maps;
        EXPECT_GE(maps, 1u) << step;
        EXPECT_LE(maps, 2u) << step;
    }
    stage.set({osg::Vec3d(5.0, 0.1, 0.0)});
    const unsigned maps = Drawn(stage, camera).maps;
    EXPECT_GE(maps, 2u) << "from one side to the other";
    EXPECT_LE(maps, 4u);
}

int texturesIn(Camera& camera) {
    return inContext(camera, [](osg::State&) {
        int count = 0;
        for (GLuint name = 1; name < 1000; ++name) count += glIsTexture(name) != 0;
        return count;
    });
}

TEST(MapLayers, OfASceneInWhichNothingMovesTakeNoMoreTextures) {
    Stage stage({"sun", inSun(), {aBox()}});
    Camera camera(stage.scene.root, view);
    stage.set({osg::Vec3d(-3.0, -3.0, 0.0)});
    camera.frame();
    const int textures = texturesIn(camera);
    stage.scene.light->getLight()->setPosition({0.8f, 0.4f, 1.2f, 0.0f});
    camera.frame();
    EXPECT_EQ(texturesIn(camera), textures);
    stage.set({osg::Vec3d(-3.0, -2.0, 0.0)});
    camera.frame();
    EXPECT_EQ(texturesIn(camera), textures + 1);
    inContext(camera, [&](osg::State& state) {
        stage.scene.root->releaseGLObjects(&state);
        osg::flushAllDeletedGLObjects(state.getContextID());
        return 0;
    });
    EXPECT_EQ(texturesIn(camera), 0);
}

TEST(MapLayers, OfALightThatIsGoneAreLetGo) {
    Stage stage({"sun", inSun(), {aBox()}});
    Camera camera(stage.scene.root, view);
    stage.set({osg::Vec3d(-3.0, -3.0, 0.0)});
    const gnomon::ShadowLight one{0, {1.0, 0.4, 1.2, 0.0}}, other{1, {-0.5, 0.4, 1.2, 0.0}};
    const auto texturesWith = [&](const std::vector<gnomon::ShadowLight>& lights, int frames) {
        stage.scene.group->setLights(lights);
        for (int i = 0; i < frames; ++i) camera.viewer().frame();
        inContext(camera, [](osg::State& state) {
            osg::flushAllDeletedGLObjects(state.getContextID());
            return 0;
        });
        return texturesIn(camera);
    };
    const int ofOne = texturesWith({one}, 1);
    EXPECT_GT(texturesWith({one, other}, 1), ofOne);
    EXPECT_EQ(texturesWith({one}, 62), ofOne);
}

TEST(MapLayers, LeaveNoErrorInOpenGL) {
    const Play play{"lamp", byLamp(), {aBox(), aFence()}};
    Stage stage(play);
    Camera camera(stage.scene.root, view);
    const test::GlComplaints complaints(camera);
    for (const Moment& moment : toAndFro) {
        stage.set(moment);
        camera.frame();
    }
    EXPECT_EQ(complaints.all(), std::vector<std::string>());
}

} // namespace
