// SPDX-License-Identifier: MIT
// Techniques let go of casters that have left the scene.
#include "Tower.h"

#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/observer_ptr>

#include <algorithm>
#include <string>
#include <vector>

using test::fromTheSide;
using test::Scene;
using test::sun;
using test::tower;

namespace {

/// Tiles that come and go, as paged ones do, and then the last caster of all.
TEST(GoneCasters, AreLetGoByAllTechniques) {
    for (const std::string spec :
         {"map", "volume", "traced", "planar:receiver=ground", "hull:receiver=ground", "auto"}) {
        Scene scene = test::groundScene({tower}, 8.0, sun);
        scene.addShadow(spec);
        test::Camera camera(scene.root, fromTheSide());
        camera.frame();
        std::vector<osg::observer_ptr<osg::Array>> gone;
        const auto add = [&gone](const osg::Geode& geode) {
            gone.emplace_back(const_cast<osg::Array*>(geode.getDrawable(0)->asGeometry()->getVertexArray()));
        };
        for (int i = 0; i < 20; ++i) {
            const osg::ref_ptr<osg::Geode> tile = test::node(test::moved(tower, {0.1 * i, 0.0, 0.0}), "tile");
            add(*tile);
            scene.content->addChild(tile);
            camera.frame();
            scene.content->removeChild(tile);
            camera.frame();
        }
        for (const unsigned child : {1u, 0u}) { // the tower, and then the ground
            add(*scene.content->getChild(child)->asGeode());
            scene.content->removeChild(child);
            for (int i = 0; i < 250; ++i) camera.frame(); // more than anything waits for another use
            const auto lives = [](const auto& array) { return array.valid(); };
            EXPECT_EQ(std::count_if(gone.begin(), gone.end(), lives), 0) << spec << " " << child;
        }
    }
}

TEST(GoneCasters, AreLetGoOnceNoTechniqueIsLeftOrOn) {
    for (const std::string spec : {"map", "volume", "traced", "planar:receiver=ground", "hull:receiver=ground", "auto"})
        for (const bool masked : {false, true}) {
            Scene scene = test::groundScene({tower}, 8.0, sun);
            scene.addShadow(spec);
            test::Camera camera(scene.root, fromTheSide());
            camera.frame();
            if (masked)
                scene.group->getChild(1)->setNodeMask(0);
            else
                scene.group->removeChild(1);
            const osg::observer_ptr<osg::Node> geode = test::find(*scene.root, "caster");
            const osg::observer_ptr<osg::Array> vertices =
                geode->asGeode()->getDrawable(0)->asGeometry()->getVertexArray();
            scene.content->removeChild(geode.get());
            for (int i = 0; i < 250; ++i) camera.viewer().frame(); // more than anything waits for another use
            EXPECT_FALSE(vertices.valid()) << spec << (masked ? ", switched off" : ", removed");
        }
}

} // namespace
