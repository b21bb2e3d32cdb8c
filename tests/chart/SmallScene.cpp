// SPDX-License-Identifier: MIT
#include "SmallScene.h"

#include <support/Mesh.h>
#include <support/Picture.h>

#include <stdexcept>

namespace test {
namespace {

using namespace gnomon::examples;

SceneCamera cameraOf(const View& view) { return {view.view, view.projection, view.width, view.height}; }

} // namespace

ChartScene smallScene() {
    ChartScene scene;
    scene.name = "small";
    scene.title = "House and sphere";
    scene.content = new osg::Group;
    scene.content->addChild(node(square(8.0), "ground"));
    scene.light = {1.0, 0.3, 1.2, 0.0};
    scene.camera = cameraOf(perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 1.0}, 320, 240, 40.0, 5.0, 40.0));
    scene.receiver = scene.terrain = "ground";
    scene.radius = 3.0;
    scene.content->addChild(node(house({2.0, 0.0}, {2.0, 2.0, 3.0}, 30.0)));
    scene.content->addChild(node(sphere({-2.0, 0.0, 2.5}, 1.0)));
    scene.bounds.set(-8.0, -8.0, 0.0, 8.0, 8.0, 3.5);
    scene.center.set(0.0, 0.0, 1.0);
    return scene;
}

const Yardstick& smallYardstick() {
    static const Yardstick yardstick(smallScene(), false);
    return yardstick;
}

const Peer& peerNamed(const std::string& name) {
    for (const Peer& peer : peers())
        if (peer.name == name) return peer;
    throw std::logic_error("no peer " + name);
}

gnomon::metrics::ShadowMetrics errorsOf(const Contender& contender, const ChartScene& drawn,
                                        const Yardstick& yardstick) {
    Sight sight(contender, drawn);
    return gnomon::metrics::shadowMetrics(sight.visibility(), yardstick.maps(), yardstick.limits());
}

} // namespace test
