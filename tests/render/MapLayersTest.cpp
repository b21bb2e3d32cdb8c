// SPDX-License-Identifier: MIT
// Maps while casters move: the picture is that of maps which never saw them elsewhere, and what stands still is drawn once.
#include "GlComplaints.h"
#include "MapPlays.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/GLExtensions>

#include <optional>

using gnomon::ShadowMapTechnique;
using test::Camera;
using test::Picture;
using test::Scene;
using test::View;

namespace {

using namespace test::layers;

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

/// Pixels about which pictures differ in a block of 3 × 3.
int differingBlocks(const Picture& a, const Picture& b) {
    int blocks = 0;
    for (int y = 1; y + 1 < a.height; ++y)
        for (int x = 1; x + 1 < a.width; ++x) {
            bool all = true;
            for (int i = 0; i < 9; ++i) {
                const int u = x + i % 3 - 1, v = y + i / 3 - 1;
                all = all && a.at(u, v) != b.at(u, v);
            }
            blocks += all;
        }
    return blocks;
}

TEST(MapLayers, AreMadeAnewWhereOpenGLLostThem) {
    const Play play{"sun", inSun(), {aBox(), aFence()}};
    Stage stage(play);
    for (int again = 0; again < 2; ++again) { // in a context of its own each time
        Camera camera(stage.scene.root, view);
        const auto expectRight = [&](std::size_t i) {
            const Picture picture = camera.frame(), fresh = freshPicture(play, toAndFro[i], view);
            EXPECT_TRUE(again > 0 || picture.different(fresh) == 0) << i;
            EXPECT_EQ(differingBlocks(picture, fresh), 0) << "laid while something moved, see below; " << i;
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
            EXPECT_EQ(differingBlocks(picture, fresh), 0) << play.name << ", " << step;
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
