// SPDX-License-Identifier: MIT
// Mirrors against lines of sight that are mirrored one by one, and against scenes that are mirrored by a transform.
#include "EffectPromises.h"

#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <support/Panels.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/MatrixTransform>

using namespace test;
using gnomon::PlanarReflectionNode;
using gnomon::ShadowCasterGroup;

namespace {

/// A mirror: the panel that one sees it in, and its share of each channel.
struct Mirror {
    std::string panel;
    glm::dvec4 plane;
    glm::dvec3 share{0.75};
};

/// llvmpipe blends 8-bit pixels in steps of 1/255, factors too: each of the two products may be off by one.
constexpr double rounding = 1.01;

/// In the floor z = 0: a wall that stands on it, one before that, one that hangs through it, one below it, one behind the
/// camera.
const std::vector<Panel> panels = {
    {{-4.0, -3.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 7.0, 0.0}, {200, 120, 40}, "floor"},
    {{-3.0, 3.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, 2.5}, {40, 200, 80}, "wall"},
    {{-1.0, 1.0, 0.4}, {1.5, 0.5, 0.0}, {0.0, 0.3, 1.2}, {80, 40, 240}, "board"},
    {{1.0, 2.0, -1.5}, {1.0, 0.5, 0.0}, {0.0, 0.0, 3.0}, {240, 240, 0}, "post"},
    {{-3.0, -1.0, -2.0}, {3.0, 0.0, 0.0}, {0.0, 2.0, 0.5}, {255, 0, 0}, "cellar"},
    {{-9.0, -10.0, 5.5}, {18.0, 0.0, 0.0}, {0.0, 0.0, 6.0}, {0, 160, 160}, "behind"},
};
const Mirror floorMirror = {"floor", {0.0, 0.0, 1.0, 0.0}};
const View view = perspective({0.5, -7.0, 4.0}, {0.0, 1.0, 0.0}, 240, 180);

glm::dvec3 mixed(const glm::dvec3& own, const glm::dvec3& image, const glm::dvec3& share) {
    return (1.0 - share) * own + share * image;
}

/// What one sees of panels, some of which are mirrors; an image shows no mirrors.
Shown seenIn(const std::vector<Panel>& all, const std::vector<Mirror>& mirrors) {
    return [=](const Sight& sight) {
        const auto met = meet(sight, all, [](const Panel&) { return true; });
        if (!met) return background;
        const glm::dvec3 own(met->panel->color);
        for (const Mirror& mirror : mirrors) {
            const glm::dvec3 normal(mirror.plane);
            const double along = glm::dot(normal, sight.way);
            if (mirror.panel != met->panel->name || along > 0.0) continue;
            const auto image = meet({met->where, sight.way - 2.0 * along * normal}, all,
                                    [&](const Panel& panel) { return panel.name != mirror.panel; });
            return mixed(own, image ? glm::dvec3(image->panel->color) : background, mirror.share);
        }
        return own;
    };
}

osg::ref_ptr<PlanarReflectionNode> mirrorOf(osg::Node& scene, const Mirror& mirror) {
    osg::ref_ptr<PlanarReflectionNode> node = new PlanarReflectionNode;
    node->addChild(&scene);
    node->setSurface({find(scene, mirror.panel)});
    node->setPlane({mirror.plane.x, mirror.plane.y, mirror.plane.z, mirror.plane.w});
    node->setReflectance(osg::Vec3f(osg::Vec3d(mirror.share.x, mirror.share.y, mirror.share.z)));
    return node;
}

void expectSeen(const Picture& picture, const View& from, const Shown& seen, int edges = 1500) {
    const Judgement found = judge(picture, from, seen, rounding);
    EXPECT_EQ(found.wrong, 0) << "worst by " << found.worst;
    EXPECT_LT(found.edges, edges);
}

} // namespace

TEST(Reflection, ShowsInTheSurfaceWhatMirroredSightsMeetAndNothingElsewhere) {
    const auto node = mirrorOf(*group(panels), floorMirror);
    const Picture picture = render(node, view);
    expectSeen(picture, view, seenIn(panels, {floorMirror}));
    EXPECT_TRUE(node->diagnose().empty());
    int images = 0; // none of the pictures' parts is empty
    for (const auto& color : {glm::dvec3(40, 200, 80), glm::dvec3(80, 40, 240), glm::dvec3(240, 240, 0), background})
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const int x = int(i) % picture.width, y = int(i) / picture.width;
            images += glm::distance(colorAt(picture, x, y), mixed({200, 120, 40}, color, floorMirror.share)) < 2.0;
        }
    EXPECT_GT(images, 5000);
}

TEST(Reflection, TakesAShareOfEachChannel) {
    for (const glm::dvec3& share : {glm::dvec3(0.0), glm::dvec3(1.0), glm::dvec3(0.8, 0.4, 0.2)}) {
        Mirror mirror = floorMirror;
        mirror.share = share;
        expectSeen(render(mirrorOf(*group(panels), mirror), view), view, seenIn(panels, {mirror}));
    }
}

TEST(Reflection, SeesOneSidedPanelsFromTheirFrontAlone) {
    std::vector<Panel> oneSided = panels;
    for (Panel& panel : oneSided) panel.oneSided = true;
    oneSided.push_back({{-2.5, 0.5, 1.5}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {250, 250, 250}, "up", true});
    oneSided.push_back({{2.0, 1.5, 1.5}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {10, 250, 250}, "down", true});
    expectSeen(render(mirrorOf(*group(oneSided), floorMirror), view), view, seenIn(oneSided, {floorMirror}));
}

TEST(Reflection, FromBehindTheSurfaceIsAsItIsWithoutAMirror) {
    const View below = perspective({0.5, -7.0, -4.0}, {0.0, 1.0, 0.0}, 240, 180);
    EXPECT_EQ(render(mirrorOf(*group(panels), floorMirror), below).different(render(group(panels), below)), 0);
}

TEST(Reflection, OfALevelViewFromAboveIsOrthographicToo) {
    View ortho = view;
    ortho.projection.makeOrtho(-5.0, 5.0, -4.0, 4.0, 0.1, 40.0);
    expectSeen(render(mirrorOf(*group(panels), floorMirror), ortho), ortho, seenIn(panels, {floorMirror}));
}

TEST(Reflection, WorksInSeveralMirrorsAtOnce) {
    const Mirror wall = {"wall", {0.0, -1.0, 0.0, 3.0}, glm::dvec3(0.5)};
    const Mirror slanted = {"board", glm::dvec4(glm::normalize(glm::cross(panels[2].side, panels[2].up)), 0.0)};
    Mirror board = slanted;
    board.plane.w = -glm::dot(glm::dvec3(board.plane), panels[2].corner);
    auto scene = group(panels);
    const auto node = mirrorOf(*mirrorOf(*mirrorOf(*scene, floorMirror), wall), board);
    expectSeen(render(node, view), view, seenIn(panels, {floorMirror, wall, board}), 2500);
}

// Lit by a lamp, with normals, two-sided lighting and face culling: a transform mirrors the scene and its lamp instead.
TEST(Reflection, LightsTheImageAsIfLampAndScenesWereMirroredByATransform) {
    Scene lit = scene({2.0, -3.0, 4.0, 1.0});
    lit.light->getLight()->setSpecular({0.5f, 0.5f, 0.5f, 1.0f});
    osg::ref_ptr<osg::Group> things = new osg::Group;
    things->addChild(test::node(sphere({-1.0, 1.0, 1.5}, 1.0), "sphere"));
    things->addChild(test::node(box({0.5, 1.0, 0.2}, {1.5, 2.0, 1.7}), "box"));
    things->getOrCreateStateSet()->setAttributeAndModes(new osg::CullFace);
    osg::ref_ptr<osg::Group> all = new osg::Group;
    all->addChild(things);
    all->addChild(test::node(square(4.0), "floor"));
    const auto mirror = mirrorOf(*all, {"floor", floorMirror.plane, glm::dvec3(1.0)});
    lit.content->addChild(mirror);
    const Picture picture = render(lit.root, view);

    Scene turned = scene({2.0, -3.0, -4.0, 1.0}); // OSG does not turn front faces under a mirroring transform
    turned.light->getLight()->setSpecular({0.5f, 0.5f, 0.5f, 1.0f});
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(osg::Matrixd::scale(1.0, 1.0, -1.0));
    transform->addChild(things);
    things->getStateSet()->setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT));
    turned.content->addChild(transform);
    const Picture image = render(turned.root, view);

    // Where nothing stands before the floor every pixel is the image's.
    things->getStateSet()->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    Scene bare = scene({2.0, -3.0, 4.0, 1.0});
    bare.content->addChild(things);
    const Picture alone = render(bare.root, view);
    int compared = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const Sight line = sight(view, x + 0.5, y + 0.5);
            const glm::dvec3 ground = line.from - line.way * (line.from.z / line.way.z);
            if (std::abs(ground.x) > 3.9 || std::abs(ground.y) > 3.9 || alone.at(x, y) != 0xff400000u) continue;
            ++compared;
            ASSERT_LE(glm::distance(colorAt(picture, x, y), colorAt(image, x, y)), 1.8) << x << " " << y;
        }
    EXPECT_GT(compared, 5000);
}

TEST(Reflection, StandsUnderTransformsFarFromTheOriginAsItDoesAtIt) {
    const Picture here = render(mirrorOf(*group(panels), floorMirror), view);
    const osg::Matrixd away =
        osg::Matrixd::rotate(0.7, osg::Vec3d(0.3, -0.5, 0.8)) * osg::Matrixd::translate(4.5e6, -5.4e6, 3.3e2);
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(away);
    place->addChild(mirrorOf(*group(panels), floorMirror));
    View there = view;
    there.view = osg::Matrixd::inverse(away) * view.view;
    EXPECT_LT(render(place, there).different(here), 60) << "roundings of a nanometre, at edges";
    expectSeen(render(place, there), view, seenIn(panels, {floorMirror}));
}

TEST(Reflection, IsRightUnderAMirroringTransform) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::scale(-1.0, 1.0, 1.0));
    place->addChild(mirrorOf(*group(panels), floorMirror));
    View there = view;
    there.view = osg::Matrixd::scale(-1.0, 1.0, 1.0) * view.view;
    expectSeen(render(place, there), view, seenIn(panels, {floorMirror}));
}

TEST(Reflection, ShowsWhatIsOutOfSightAndBeyondTheFarPlaneThatTheRestNeeds) {
    const auto node = mirrorOf(*group(panels), floorMirror);
    Camera camera(node, view);
    camera.viewer().getCamera()->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
    expectSeen(camera.frame(), view, seenIn(panels, {floorMirror}));
    expectSeen(camera.frame(), view, seenIn(panels, {floorMirror}));
}

TEST(Reflection, IsItsOwnInEachOfTwoViews) {
    const auto node = mirrorOf(*group(panels), floorMirror);
    View two = view;
    two.width *= 2;
    Camera camera(node, two);
    const View other = perspective({-3.0, -6.0, 3.0}, {0.0, 1.0, 0.0}, view.width, view.height);
    for (const bool second : {false, true}) {
        osg::ref_ptr<osg::Camera> slave = new osg::Camera;
        slave->setGraphicsContext(camera.context().graphicsContext());
        slave->setViewport(second ? view.width : 0, 0, view.width, view.height);
        slave->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        slave->setClearColor({0.0f, 0.0f, 0.25f, 1.0f});
        slave->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
        slave->setViewMatrix(second ? other.view : view.view);
        slave->setProjectionMatrix(view.projection);
        camera.viewer().addSlave(slave, osg::Matrixd(), osg::Matrixd());
    }
    camera.viewer().getCamera()->setGraphicsContext(nullptr);
    camera.viewer().getCamera()->setViewport(nullptr);
    for (int frame = 0; frame < 2; ++frame) {
        const Picture both = camera.frame();
        for (const bool second : {false, true}) {
            Picture half;
            half.width = view.width, half.height = view.height;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) half.pixels.push_back(both.at(x + (second ? view.width : 0), y));
            expectSeen(half, second ? other : view, seenIn(panels, {floorMirror}), 2500);
        }
    }
}

TEST(Reflection, BlendsWhatIsTransparentInTheImageOnce) {
    std::vector<Panel> glass = panels;
    glass.push_back({{-4.0, 2.0, 0.1}, {7.0, 0.0, 0.0}, {0.0, 0.0, 0.8}, {255, 255, 255}, "glass"});
    auto scene = group(glass);
    osg::StateSet& set = *find(*scene, "glass")->getOrCreateStateSet();
    set.setAttributeAndModes(new osg::BlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA)); // alpha 0: nothing
    set.setAttributeAndModes(new osg::BlendFunc(GL_DST_COLOR, GL_ZERO));                          // times white
    set.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    expectSeen(render(mirrorOf(*scene, floorMirror), view), view, seenIn(panels, {floorMirror}));
}

TEST(Reflection, LeavesDepthStencilAndOpenGlAsTheyWere) {
    const auto node = mirrorOf(*group(panels), floorMirror);
    const gnomon::Selection floor = node->getSurface();
    expectNothingIsLeft(node, view, [&](bool on) { node->setSurface(on ? floor : gnomon::Selection()); });
}

TEST(Reflection, NeedsOneStencilBitAndSaysSoWhereThereIsNone) {
    const auto node = mirrorOf(*group(panels), floorMirror);
    expectOneBitIsEnough(node, *node, view, render(group(panels), view));
}

// The sun at 45°: a square at 1 m throws its shadow at x = -1.5 … -0.5.
TEST(Reflection, KeepsShadowsOnItsSurface) {
    const View down = perspective({0.0, -9.0, 9.0}, {0.0, 0.0, 0.0}, 240, 180);
    const auto build = [&](bool mirrors, bool shadows, ShadowCasterGroup::Composite composite) {
        Scene lit = groundScene({square(0.5, 1.0)});
        osg::Node* floor = find(*lit.root, "ground");
        if (mirrors) {
            const auto mirror = mirrorOf(*lit.content, {"ground", floorMirror.plane, glm::dvec3(0.5)});
            lit.root->replaceChild(lit.content, mirror);
            lit.content = mirror;
        }
        if (shadows) {
            lit.addShadow(planar(floor));
            lit.group->setComposite(composite);
        }
        return render(lit.root, down);
    };
    const Picture plain = build(false, false, ShadowCasterGroup::RELIGHT);
    const Picture mirrored = build(true, false, ShadowCasterGroup::RELIGHT);
    for (const auto composite : {ShadowCasterGroup::RELIGHT, ShadowCasterGroup::BLEND}) {
        const Picture shadow = build(false, true, composite), both = build(true, true, composite);
        int inShadow = 0;
        for (int y = 0; y < down.height; ++y)
            for (int x = 0; x < down.width; ++x) {
                const glm::dvec3 lit = colorAt(plain, x, y), dark = colorAt(shadow, x, y), now = colorAt(both, x, y);
                const glm::dvec3 image = 2.0 * colorAt(mirrored, x, y) - lit; // of reflectance 0.5
                const bool shadowed = lit != dark;
                inShadow += shadowed;
                const glm::dvec3 expected = !shadowed                               ? colorAt(mirrored, x, y)
                                            : composite == ShadowCasterGroup::BLEND ? 0.5 * colorAt(mirrored, x, y)
                                                                                    : 0.5 * dark + 0.5 * image;
                ASSERT_LE(glm::distance(now, expected), 3.0) << x << " " << y << " " << composite;
            }
        EXPECT_GT(inShadow, 200);
    }
}

TEST(Reflection, CopiesFollowTheirOwnSurface) {
    auto scene = group(panels);
    const auto node = mirrorOf(*scene, floorMirror);
    const osg::ref_ptr<PlanarReflectionNode> copy =
        static_cast<PlanarReflectionNode*>(node->clone(osg::CopyOp::DEEP_COPY_NODES));
    EXPECT_EQ(copy->getSurface().node, find(*copy, "floor"));
    EXPECT_NE(copy->getSurface().node, node->getSurface().node);
    EXPECT_EQ(copy->getPlane(), node->getPlane());
    EXPECT_EQ(copy->getReflectance(), node->getReflectance());
}

TEST(Reflection, BoundHoldsTheImage) {
    const osg::ref_ptr<PlanarReflectionNode> node = new PlanarReflectionNode;
    node->addChild(test::node(box({9.0, 0.0, 4.0}, {10.0, 1.0, 5.0})));
    node->setPlane({0.0, 0.0, 2.0, -2.0}); // z = 1
    const osg::BoundingSphere bound = node->getBound();
    for (const double z : {-3.0, -2.0, 4.0, 5.0})
        EXPECT_LE((osg::Vec3(9.5f, 0.5f, float(z)) - bound.center()).length(), bound.radius()) << z;
}
