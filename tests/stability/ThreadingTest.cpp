// SPDX-License-Identifier: MIT
// Every threading model of osgViewer draws the same frames as one thread does, in two windows, while the update traversal
// changes casters, light and settings.
#include "Trial.h"

#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TerrainShadowGeode.h>

#include <osg/MatrixTransform>
#include <osgViewer/CompositeViewer>

#include <array>
#include <set>

using namespace test;

namespace {

using Models = osgViewer::ViewerBase;
using gnomon::ShadowCasterGroup;

constexpr int size = 64;
constexpr unsigned frames = 300;

/// Two boxes that move, a third that comes and goes, and one light, with shadows on z = 0.
class MovingScene {
public:
    /// @param lightMoves  and so the state is DYNAMIC: OpenSceneGraph applies lights while it draws.
    explicit MovingScene(bool lightMoves);
    osg::Group* root() const { return _scene.root; }
    /// Makes it what it is in that frame, whatever it was before.
    void change(unsigned frame);

private:
    void changeCasters(unsigned frame);
    void changeSettings(unsigned frame);
    void changeTechnique(unsigned frame);

    const bool _lightMoves;
    Scene _scene;
    osg::ref_ptr<gnomon::ShadowTechnique> _technique;
    std::array<osg::ref_ptr<osg::MatrixTransform>, 2> _places;
    osg::ref_ptr<osg::Node> _guest = node(box({-0.25, -2.5, 0.0}, {0.25, -2.0, 1.5}), "guest");
};

MovingScene::MovingScene(bool lightMoves) : _lightMoves(lightMoves), _scene(groundScene({})) {
    if (lightMoves) _scene.root->getOrCreateStateSet()->setDataVariance(osg::Object::DYNAMIC);
    const Mesh boxes[] = {box({-0.5, -0.5, 0.0}, {0.5, 0.5, 1.0}), box({-0.3, -0.3, 0.2}, {0.3, 0.3, 0.8})};
    for (std::size_t i = 0; i < _places.size(); ++i) {
        _places[i] = new osg::MatrixTransform;
        _places[i]->setName("place");
        _places[i]->addChild(node(boxes[i], "caster"));
        _scene.content->addChild(_places[i]);
    }
    _technique = castingTechnique(find(*_scene.root, "ground"));
    _scene.addShadow(_technique);
}

void MovingScene::changeCasters(unsigned frame) {
    const double t = 0.05 * (frame % 40);
    _places[0]->setMatrix(osg::Matrixd::translate(-2.0 + t, 1.0, 0.0));
    _places[1]->setMatrix(osg::Matrixd::translate(1.0, 1.0 - 0.5 * (frame / 60), 0.5)); // rests for 60 frames
    const bool wanted = frame % 20 >= 10;
    if (wanted != _scene.content->containsNode(_guest)) {
        if (wanted)
            _scene.content->addChild(_guest);
        else
            _scene.content->removeChild(_guest);
    }
    _places[1]->setNodeMask(frame % 17 < 14 ? ~0u : 0u);
}

void MovingScene::changeSettings(unsigned frame) {
    const double side = 0.25 * (frame % 5);
    if (_lightMoves) _scene.light->getLight()->setPosition(osg::Vec4d(1.0, side, 1.0, 0.0));
    _scene.group->setComposite(frame % 7 < 4 ? ShadowCasterGroup::RELIGHT : ShadowCasterGroup::BLEND);
    _scene.group->setDark(0.25f * static_cast<float>(frame % 3));
    if (frame % 29 == 0) _scene.group->setCasters({nullptr, ~0u});
    if (frame % 29 == 20) _scene.group->setCasters({_places[0]});
    _technique->setNodeMask(frame % 31 < 28 ? ~0u : 0u);
}

void MovingScene::changeTechnique(unsigned frame) {
    if (auto* planar = dynamic_cast<gnomon::PlanarShadowNode*>(_technique.get()))
        planar->setPlanes({osg::Vec4d(0.0, 0.0, 1.0, frame % 13 < 10 ? 0.0 : -0.25)});
    if (auto* map = dynamic_cast<gnomon::ShadowMapTechnique*>(_technique.get())) {
        map->setSize(frame % 13 < 7 ? 256 : 128);
        map->setFilter(frame % 11 < 6 ? gnomon::ShadowMapOptions::BICUBIC : gnomon::ShadowMapOptions::NEAREST);
    }
    if (auto* terrain = dynamic_cast<gnomon::TerrainShadowGeode*>(_technique.get()))
        terrain->setMethod(frame % 13 < 7 ? gnomon::TerrainShadowGeode::HULL : gnomon::TerrainShadowGeode::BOX);
}

void MovingScene::change(unsigned frame) {
    changeCasters(frame);
    changeSettings(frame);
    changeTechnique(frame);
}

/// Calls change() in each update traversal.
class Changing : public osg::NodeCallback {
public:
    explicit Changing(MovingScene& scene) : _scene(scene) {}
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        _scene.change(visitor->getFrameStamp()->getFrameNumber());
        traverse(node, visitor);
    }

private:
    MovingScene& _scene;
};

/// Keeps each picture of a camera, in the thread that draws it.
class Recorder : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo&) const override {
        Picture picture;
        picture.width = picture.height = size;
        picture.pixels.resize(std::size_t(size) * size);
        glReadPixels(0, 0, size, size, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
        pictures.push_back(std::move(picture));
    }
    mutable std::vector<Picture> pictures;
};

osg::ref_ptr<Recorder> addWindow(osgViewer::CompositeViewer& viewer, const gnomon::HeadlessContext& context,
                                 osg::Node* root, const View& view) {
    osg::ref_ptr<osgViewer::View> window = new osgViewer::View;
    osg::ref_ptr<Recorder> recorder = new Recorder;
    osg::Camera& camera = *window->getCamera();
    window->setLightingMode(osg::View::NO_LIGHT);
    context.attach(camera);
    settle(camera, view);
    camera.setFinalDrawCallback(recorder);
    window->setSceneData(root);
    viewer.addView(window);
    return recorder;
}

using Pictures = std::array<std::vector<Picture>, 2>;

/// What two windows show of a scene of its own.
Pictures drawnBy(Models::ThreadingModel model, bool lightMoves) {
    MovingScene scene(lightMoves);
    scene.root()->setUpdateCallback(new Changing(scene));
    const gnomon::HeadlessContext above(size, size), beside(size, size); // outlive the viewer
    osgViewer::CompositeViewer viewer;
    viewer.setUseConfigureAffinity(false); // else threads are pinned to cores
    viewer.setKeyEventSetsDone(0);
    viewer.setThreadingModel(model);
    const osg::ref_ptr<Recorder> recorders[] = {
        addWindow(viewer, above, scene.root(), fromAbove(4.0, size)),
        addWindow(viewer, beside, scene.root(), perspective({-6.0, -7.0, 5.0}, {0.0, 0.0, 0.0}, size, size))};
    for (unsigned frame = 0; frame < frames; ++frame) viewer.frame(0.02 * frame);
    viewer.stopThreading(); // the last frame is drawn before threads end
    return {recorders[0]->pictures, recorders[1]->pictures};
}

constexpr Models::ThreadingModel models[] = {Models::CullDrawThreadPerContext, Models::DrawThreadPerContext,
                                             Models::CullThreadPerCameraDrawThreadPerContext};

GNOMON_BY_TECHNIQUE(Threads);

/// The frames that differ, as "3 7 12".
std::string differing(const std::vector<Picture>& found, const std::vector<Picture>& wanted) {
    std::string list;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (found[i].pixels != wanted[i].pixels)
            list += std::to_string(i) + ":" + std::to_string(found[i].different(wanted[i])) + " ";
    return list;
}

/// How many pictures differ from all others.
std::size_t kinds(const std::vector<Picture>& pictures) {
    std::set<std::vector<std::uint32_t>> different;
    for (const Picture& picture : pictures) different.insert(picture.pixels);
    return different.size();
}

} // namespace

TEST_P(Threads, OfEveryModelDrawWhatOneThreadDraws) {
    for (const bool lightMoves : {true, false}) {
        const Pictures wanted = drawnBy(Models::SingleThreaded, lightMoves);
        for (const std::vector<Picture>& window : wanted)
            EXPECT_GT(kinds(window), 100u); // there is something to be wrong
        for (const Models::ThreadingModel model : models) {
            SCOPED_TRACE(testing::Message() << "threading model " << model << (lightMoves ? ", the light moves" : ""));
            const Pictures found = drawnBy(model, lightMoves);
            for (std::size_t window = 0; window < wanted.size(); ++window) {
                SCOPED_TRACE(testing::Message() << "window " << window);
                ASSERT_EQ(wanted[window].size(), frames);
                ASSERT_EQ(found[window].size(), frames);
                EXPECT_EQ(differing(found[window], wanted[window]), "");
            }
        }
    }
}
