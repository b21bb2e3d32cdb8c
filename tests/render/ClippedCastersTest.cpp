// SPDX-License-Identifier: MIT
// What clip planes leave of a caster casts; those of a view cut what is seen alone.
#include "IntoTexture.h"
#include "Tower.h"

#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowCasterGroup.h>
#include <gtest/gtest.h>
#include <osg/ClipNode>
#include <osg/ClipPlane>
#include <osg/MatrixTransform>

#include <functional>
#include <string>
#include <vector>

using gnomon::ShadowCasterGroup;
using test::fromTheSide;
using test::Picture;
using test::Scene;
using test::sun;
using test::tower;

namespace {

/// The tower, cut off by z <= 1.
const osg::Vec4d lowHalf(0.0, 0.0, -1.0, 1.0);
test::Mesh cutTower() {
    const glm::dvec3 x(2.0, 0.0, 0.0), y(0.0, 2.0, 0.0), up(0.0, 0.0, 1.0);
    return test::joined({test::quad({-1.0, -1.0, 0.0}, x, up), test::quad({1.0, -1.0, 0.0}, y, up),
                         test::quad({1.0, 1.0, 0.0}, -x, up), test::quad({-1.0, 1.0, 0.0}, -y, up),
                         test::quad({-1.0, -1.0, 0.0}, y, x)});
}

const osg::Matrixd askew = osg::Matrixd::rotate(0.7, 1.0, 0.4, 0.2) * osg::Matrixd::translate(3.0, -5.0, 2.0);

/// The plane as it is in a frame that stands askew.
osg::ref_ptr<osg::ClipPlane> planeAskew() { return new osg::ClipPlane(3, askew * lowHalf); }

osg::ref_ptr<osg::MatrixTransform> under(const osg::Matrixd& matrix, osg::Node* below) {
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(matrix);
    if (below) place->addChild(below);
    return place;
}

/// Ways to clip the tower, which is the last child of the content.
struct Clip {
    const char* name;
    std::function<void(Scene&)> set;
};

const Clip clips[] = {
    {"by a ClipNode under a transform",
     [](Scene& scene) {
         const osg::ref_ptr<osg::Node> node = scene.content->getChild(1);
         const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
         clip->addClipPlane(planeAskew());
         clip->addChild(under(osg::Matrixd::inverse(askew), node));
         scene.content->setChild(1, under(askew, clip));
     }},
    {"by a ClipNode above the group",
     [](Scene& scene) {
         const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
         clip->addClipPlane(new osg::ClipPlane(0, lowHalf));
         scene.root->replaceChild(scene.group, clip);
         clip->addChild(scene.group);
     }},
    {"by a ClipNode elsewhere",
     [](Scene& scene) {
         const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
         clip->addClipPlane(planeAskew());
         scene.root->addChild(under(askew, clip));
         clip->setStateSetModes(*scene.content->getChild(1)->getOrCreateStateSet(), osg::StateAttribute::ON);
     }},
    {"by its own state, in its own frame",
     [](Scene& scene) {
         const osg::ref_ptr<osg::Node> node = scene.content->getChild(1);
         const osg::ref_ptr<osg::MatrixTransform> inner = under(osg::Matrixd::inverse(askew), node);
         scene.content->setChild(1, under(askew, inner));
         node->getOrCreateStateSet()->setAttributeAndModes(new osg::ClipPlane(2, lowHalf));
     }},
    {"by two planes, one of which lets it be",
     [](Scene& scene) {
         const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
         clip->addClipPlane(new osg::ClipPlane(0, osg::Vec4d(0.0, 0.0, 1.0, 0.0)));
         clip->addClipPlane(new osg::ClipPlane(1, lowHalf));
         clip->addChild(scene.content->getChild(1));
         scene.content->setChild(1, clip);
     }},
};

const char* const specs[] = {"map", "volume", "traced", "planar:receiver=ground", "hull:receiver=ground"};

Picture clipped(const std::string& spec, const test::Mesh& mesh, const std::function<void(Scene&)>& clip) {
    Scene scene = test::groundScene({mesh}, 8.0, sun);
    scene.addShadow(spec);
    if (clip) clip(scene);
    return test::render(scene.root, fromTheSide());
}

TEST(ClippedCasters, CastWhatIsLeftOfThem) {
    for (const std::string spec : specs) {
        const Picture expected = clipped(spec, cutTower(), {});
        EXPECT_GT(expected.different(clipped(spec, tower, {})), 300) << spec;
        for (const Clip& clip : clips) // OpenGL's own cut is no edge of a mesh, to a pixel here and there
            EXPECT_LE(clipped(spec, tower, clip.set).different(expected), 8) << spec << " " << clip.name;
    }
}

/// Where a plane stands that cuts a roof off a ground in a nested camera's picture, or in that of the main one.
struct ViewClip {
    const char* name;
    bool nested, ofGraph;
    std::function<osg::ref_ptr<osg::Group>(Scene&, osg::ClipNode&)>
        set; ///< the scene, and a plane in the world's frame.
};

osg::ref_ptr<osg::Group> below(osg::ClipNode& clip, osg::Node* node) {
    clip.addChild(node);
    return &clip;
}

const test::View overhead = test::fromAbove(4.0, 96);

/// In the frame of the eye.
void belongToEye(osg::ClipNode& clip) {
    clip.setReferenceFrame(osg::ClipNode::ABSOLUTE_RF);
    osg::ClipPlane& plane = *clip.getClipPlane(0);
    plane.setClipPlane(osg::Matrixd::inverse(overhead.view) * plane.getClipPlane());
}

const ViewClip viewClips[] = {
    {"by a ClipNode between a nested camera and the group", true, false,
     [](Scene& scene, osg::ClipNode& clip) { return below(clip, scene.root); }},
    {"by one of the eye's frame there", true, false,
     [](Scene& scene, osg::ClipNode& clip) {
         belongToEye(clip);
         return below(clip, scene.root);
     }},
    {"by one of the eye's frame in the main graph", false, false,
     [](Scene& scene, osg::ClipNode& clip) {
         belongToEye(clip);
         return below(clip, scene.root);
     }},
    {"by one of the eye's frame in the group", false, false,
     [](Scene& scene, osg::ClipNode& clip) {
         belongToEye(clip);
         clip.addChild(scene.content->getChild(1));
         scene.content->setChild(1, &clip);
         return osg::ref_ptr<osg::Group>(scene.root);
     }},
    {"by one beside it, with the modes in the group", true, false,
     [](Scene& scene, osg::ClipNode& clip) {
         scene.root->addChild(&clip);
         clip.setStateSetModes(*scene.content->getChild(1)->getOrCreateStateSet(), osg::StateAttribute::ON);
         return osg::ref_ptr<osg::Group>(scene.root);
     }},
    {"by one in the group", true, true,
     [](Scene& scene, osg::ClipNode& clip) {
         clip.addChild(scene.content->getChild(1));
         scene.content->setChild(1, &clip);
         return osg::ref_ptr<osg::Group>(scene.root);
     }},
    {"by one of the main graph", false, true,
     [](Scene& scene, osg::ClipNode& clip) { return below(clip, scene.root); }},
};

/// What casts is a roof. A plane leaves the ground alone to be seen, with or without the roof's shadow.
TEST(ClippedCasters, CastWholeWhereThePlaneIsAViewsUnlessThatIsAsked) {
    const test::Mesh ground = test::square(8.0), roof = test::square(1.0, 2.0);
    const test::Target target;
    const auto drawn = [&](osg::Node* root, bool nested) {
        return nested ? test::IntoTexture(root, overhead, target).camera->frame() : test::render(root, overhead);
    };
    for (const ViewClip& each : viewClips)
        for (const auto clipping : {ShadowCasterGroup::GRAPH, ShadowCasterGroup::ALL, ShadowCasterGroup::NONE})
            for (const std::string spec : {"map", "volume", "planar:receiver=ground"}) {
                const bool casts =
                    clipping == ShadowCasterGroup::NONE || (clipping == ShadowCasterGroup::GRAPH && !each.ofGraph);
                const test::Mask truth =
                    test::castRays(ground, {}, sun, overhead, std::vector<test::Mesh>(casts ? 1 : 0, roof));
                Scene lit = test::groundScene({}, 8.0, sun), dark = test::groundScene({}, 8.0, sun),
                      scene = test::groundScene({roof}, 8.0, sun);
                dark.takeLightAway();
                scene.addShadow(spec);
                scene.group->setClipping(clipping);
                const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
                clip->addClipPlane(new osg::ClipPlane(0, lowHalf));
                const osg::ref_ptr<osg::Group> root = each.set(scene, *clip);
                const test::Comparison found = test::compare(drawn(root, each.nested), drawn(lit.root, each.nested),
                                                             drawn(dark.root, each.nested), truth);
                EXPECT_EQ(found.wrongInside, 0) << spec << " " << each.name << " " << clipping;
            }
}

TEST(ClippedCasters, CastWholeWhereANestedCamerasStateClips) {
    const test::Mesh roof = test::square(1.0, 2.0);
    Scene scene = test::groundScene({roof}, 8.0, sun), bare = test::groundScene({}, 8.0, sun);
    scene.addShadow("map");
    const test::Target target;
    test::IntoTexture into(scene.root, overhead, target);
    into.into->getOrCreateStateSet()->setAttributeAndModes(new osg::ClipPlane(0, lowHalf));
    const Picture lit = test::IntoTexture(bare.root, overhead, target).camera->frame();
    bare.takeLightAway();
    const Picture dark = test::IntoTexture(bare.root, overhead, target).camera->frame();
    const test::Mask truth = test::castRays(test::square(8.0), {}, sun, overhead, {roof});
    EXPECT_EQ(test::compare(into.camera->frame(), lit, dark, truth).wrongInside, 0);
}

TEST(ClippedCasters, CastNothingBeyondAPlane) {
    for (const std::string spec : specs) {
        const auto clipAll = [](Scene& scene) {
            const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
            clip->addClipPlane(new osg::ClipPlane(0, osg::Vec4d(0.0, 0.0, 1.0, -10.0)));
            clip->addChild(scene.content->getChild(1));
            scene.content->setChild(1, clip);
        };
        const auto remove = [](Scene& scene) { scene.content->removeChild(1); };
        EXPECT_EQ(clipped(spec, tower, clipAll).different(clipped(spec, tower, remove)), 0) << spec;
    }
}

/// A plane is known by its place in the eye's frame, and yet rests.
TEST(ClippedCasters, AreReadOnceWhileTheCameraMoves) {
    for (const Clip& clip : {clips[0], clips[1], clips[2]}) {
        Scene scene = test::groundScene({tower}, 8.0, sun);
        scene.addShadow("traced");
        clip.set(scene);
        test::Camera camera(scene.root, fromTheSide());
        camera.frame();
        for (int i = 0; i < 30; ++i) {
            camera.setView(test::perspective({-6.0 + 0.137 * i, -9.0, 6.0 + 0.071 * i}, {0.0, 0.0, 0.0}, 160, 120));
            camera.frame();
        }
        EXPECT_EQ(scene.group->revision(), 1u) << clip.name;
    }
}

} // namespace
