// SPDX-License-Identifier: MIT
#include "ChartScene.h"
#include "SceneSetup.h"

#include <gnomon/NamedNode.h>

#include <osg/LightSource>
#include <osg/NodeVisitor>
#include <osgUtil/UpdateVisitor>

namespace gnomon::examples {
namespace {

osg::Matrixd turnAbout(const osg::Vec3d& centre, double degrees) {
    return osg::Matrixd::translate(-centre) * osg::Matrixd::rotate(osg::DegreesToRadians(degrees), 0.0, 0.0, 1.0) *
           osg::Matrixd::translate(centre);
}

/// OSG's cull visitor passes over light sources without a light.
class LightsOut : public osg::NodeVisitor {
public:
    LightsOut() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::LightSource& source) override {
        source.setLight(nullptr);
        traverse(source);
    }
};

/// Leaves nothing that moves nodes or changes state from one frame to the next.
class CallbacksOut : public osg::NodeVisitor {
public:
    CallbacksOut() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
    void apply(osg::Node& node) override {
        node.setUpdateCallback(nullptr);
        node.setEventCallback(nullptr);
        if (osg::StateSet* state = node.getStateSet()) {
            state->setUpdateCallback(nullptr);
            state->setEventCallback(nullptr);
        }
        traverse(node);
    }
};

/// Gives what animates its pose of the clock's zero, and keeps it there: rays and all contenders are to see one scene. The first
/// frame may start a motion that the second one sets.
void standStill(osg::Node& files) {
    const osg::ref_ptr<osg::FrameStamp> start = new osg::FrameStamp;
    osgUtil::UpdateVisitor update;
    update.setFrameStamp(start);
    for (const unsigned frame : {1, 2}) {
        start->setFrameNumber(frame);
        update.setTraversalNumber(frame);
        files.accept(update);
    }
    CallbacksOut callbacksOut;
    files.accept(callbacksOut);
}

osg::ref_ptr<osg::Group> contentOf(const SceneSetup& setup) {
    osg::ref_ptr<osg::Group> content = new osg::Group;
    for (unsigned i = 0; i < setup.group->getNumChildren(); ++i) content->addChild(setup.group->getChild(i));
    LightsOut lightsOut;
    content->accept(lightsOut);
    return content;
}

/// The name if a node has it.
std::string nameIn(osg::Group& content, const std::string& name) { return findNamed(content, name) ? name : ""; }

} // namespace

SceneCamera movedCamera(const ChartScene& scene, double step) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewMatrix(turnAbout(scene.center, -step) * scene.camera.view);
    camera->setProjectionMatrix(scene.camera.projection);
    return sceneCamera(*camera, scene.camera.width, scene.camera.height, scene.bounds);
}

osg::Vec4d movedLight(const ChartScene& scene, double step) {
    return scene.light * turnAbout(scene.light.w() == 0.0 ? osg::Vec3d() : scene.center, step);
}

ChartScene chartSceneOf(osg::Node& files, const ViewOptions& options) {
    ViewOptions plain = options;
    plain.shadows.clear();
    standStill(files);
    SceneSetup setup = setUpScene(plain, files);
    setup.framed.clear(); // charts stay comparable: all of the scene is in their pictures
    ChartScene scene;
    scene.name = scene.title = "scene";
    scene.light = setup.lights->places().front();
    scene.content = contentOf(setup);
    scene.bounds = sceneBounds(*scene.content);
    scene.center = lookout(plain, setup).center;
    scene.radius = setup.bounds.radius();
    scene.receiver = nameIn(*scene.content, options.receiver.empty() ? "ground" : options.receiver);
    scene.terrain = nameIn(*scene.content, "terrain");
    if (scene.terrain.empty()) scene.terrain = scene.receiver;
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    placeCamera(*camera, plain, setup);
    scene.camera = sceneCamera(*camera, options.width, options.height, scene.bounds);
    return scene;
}

} // namespace gnomon::examples
