// SPDX-License-Identifier: MIT
#include <support/Causes.h>
#include <support/TwoReceivers.h>

#include <osg/NodeVisitor>
#include <osg/PolygonOffset>

#include <algorithm>
#include <ostream>

namespace test {
namespace {

const Mesh caster = box({-1.5, -1.0, 1.5}, {3.5, 1.0, 2.5});
const Mesh standing = quad({1.0, -3.0, 0.3}, {1.5, 0.0, 0.0}, {0.0, 1.4, 1.0});
/// Two: over the box's shadow, and away from all shadows but its own.
const Mesh standingLate = joined({quad({-3.2, -2.5, 0.3}, {1.4, 0.0, 0.0}, {0.0, 1.2, 0.8}),
                                  quad({-6.2, 1.0, 0.3}, {1.4, 0.0, 0.0}, {0.0, 1.2, 0.8})});
const Mesh leftHalf = quad({-8.0, -8.0, 0.0}, {8.0, 0.0, 0.0}, {0.0, 16.0, 0.0});
const std::vector<Mesh> castersAndScreens = {caster, standing, standingLate};

/// Half of the ground, from x = `start`, of squares of side 2: lights that are computed at corners vary over it.
Mesh tiles(double start) {
    std::vector<Mesh> all;
    for (double x = start; x < start + 8.0; x += 2.0)
        for (double y = -8.0; y < 8.0; y += 2.0) all.push_back(quad({x, y, 0.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}));
    return joined(all);
}

osg::ref_ptr<osg::LightSource> fillLight() {
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    osg::Light& light = *source->getLight();
    light.setLightNum(1);
    light.setPosition({-0.3f, -0.8f, 1.0f, 0.0f});
    light.setAmbient({0.0f, 0.02f, 0.0f, 1.0f});
    light.setDiffuse({0.03f, 0.06f, 0.09f, 1.0f});
    light.setSpecular({0.1f, 0.1f, 0.0f, 1.0f});
    return source;
}

void blacken(osg::StateAttribute* attribute, int number) {
    auto* light = dynamic_cast<osg::Light*>(attribute);
    if (!light || light->getLightNum() != number) return;
    light->setDiffuse({0.0f, 0.0f, 0.0f, 1.0f});
    light->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
}

struct PutOut : osg::NodeVisitor {
    explicit PutOut(int light) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), number(light) {}
    void apply(osg::Node& node) override {
        if (node.getStateSet())
            blacken(node.getStateSet()->getAttribute(osg::StateAttribute::LIGHT, static_cast<unsigned>(number)),
                    number);
        traverse(node);
    }
    void apply(osg::LightSource& node) override {
        blacken(node.getLight(), number);
        apply(static_cast<osg::Node&>(node));
    }
    int number;
};

osg::Vec4d lightAt(bool lamp, int angle) {
    if (lamp) return angle == 0 ? osg::Vec4d(3.0, 2.0, 9.0, 1.0) : osg::Vec4d(-1.0, 4.0, 8.0, 1.0);
    return angle == 0 ? osg::Vec4d(1.0, 0.4, 1.2, 0.0) : osg::Vec4d(-0.5, 1.1, 1.0, 0.0);
}

/// Draws as ever, but can no longer be told to be the plainest of leaves.
void makeUnplain(osg::Node& node) {
    node.getOrCreateStateSet()->setAttributeAndModes(new osg::PolygonOffset(0.0f, 0.0f));
}

void add(ReceiverVerdict& verdict, const Picture& actual, const Picture& lit, const Picture& dark, const Mask& mask) {
    const Comparison found = compare(actual, lit, dark, mask);
    int wrongLit = 0, wrongAny = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const bool same = actual.at(x, y) == lit.at(x, y);
            wrongAny += !same && actual.at(x, y) != dark.at(x, y);
            wrongLit += !same && mask.at(x, y) != Seen::ShadowedReceiver && !mask.atEdge(x, y);
        }
    verdict.wrongInside = std::max(verdict.wrongInside, found.wrongInside);
    verdict.wrongAtEdge = std::max(verdict.wrongAtEdge, found.wrongAtEdge);
    verdict.wrongLit = std::max(verdict.wrongLit, wrongLit);
    verdict.wrongAny = std::max(verdict.wrongAny, wrongAny);
    verdict.flipped = std::max(verdict.flipped, found.flipped);
    verdict.edges = found.edges;
}

} // namespace

const View& viewOfTwoReceivers() {
    static const View view = perspective({-5.0, -13.0, 10.0}, {0.0, -1.0, 0.0}, 200, 150);
    return view;
}

TwoReceivers twoReceivers(const osg::Vec4d& light) {
    TwoReceivers result;
    static_cast<Scene&>(result) = scene(light);
    result.lightInWorld = light;
    result.light->getLight()->setDiffuse({0.5f, 0.5f, 0.5f, 1.0f}); // saturates nothing, with the other one
    result.receivers = new osg::Group;
    result.receivers->setName("receivers");
    result.receivers->addChild(result.left = node(tiles(-8.0), "left"));
    result.receivers->addChild(result.right = node(tiles(0.0), "right"));
    for (osg::Node* each : {result.left.get(), result.right.get()}) each->getOrCreateStateSet(); // so drawn first
    result.casters = new osg::Group;
    result.casters->addChild(node(caster, "caster"));
    result.casters->addChild(result.screen = node(standing, "screen"));
    result.casters->addChild(result.late = node(standingLate, "late"));
    result.content->addChild(result.receivers);
    result.content->addChild(result.casters);
    result.late->getOrCreateStateSet()->setRenderBinDetails(11, "RenderBin");
    result.root->addChild(result.fill = fillLight());
    result.root->getStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
    return result;
}

void leaveToDiscovery(TwoReceivers& scene) {
    scene.discovered = true;
    scene.root->removeChild(scene.fill);
    scene.root->getStateSet()->removeMode(GL_LIGHT0 + static_cast<unsigned>(scene.fill->getLight()->getLightNum()));
}

void lightByViewer(TwoReceivers& scene, osg::View::LightingMode mode, const osg::Vec4& position) {
    leaveToDiscovery(scene);
    scene.root->removeChild(scene.light);
    scene.mode = mode;
    scene.viewersLight = new osg::Light(*scene.light->getLight());
    scene.viewersLight->setPosition(position);
    scene.lightInWorld = osg::Vec4d(position);
    if (mode == osg::View::HEADLIGHT)
        scene.lightInWorld = scene.lightInWorld * osg::Matrixd::inverse(viewOfTwoReceivers().view);
}

void renumber(TwoReceivers& scene, int number) {
    osg::StateSet& state = *scene.root->getStateSet();
    for (const unsigned mode : {GL_LIGHT0, GL_LIGHT1}) state.removeMode(mode);
    const auto set = [&state](osg::LightSource& source, int given) {
        source.getLight()->setLightNum(given);
        state.setMode(GL_LIGHT0 + static_cast<unsigned>(given), osg::StateAttribute::ON);
    };
    set(*scene.light, number);
    set(*scene.fill, (number + 1) % 8);
}

void putOut(TwoReceivers& scene) {
    blacken(&scene.caster(), scene.caster().getLightNum());
    PutOut visitor(scene.caster().getLightNum());
    scene.root->accept(visitor);
}

const char* nameOf(Receiving receiving) {
    switch (receiving) {
    case Receiving::Named:
        return "named";
    case Receiving::NamedAmongOthers:
        return "named, among others";
    case Receiving::Unnamed:
        return "unnamed";
    }
    return "";
}

std::ostream& operator<<(std::ostream& out, const ReceiverCase& given) { return out << given.name; }

osg::ref_ptr<gnomon::PlanarShadowNode> castOnReceivers(TwoReceivers& scene, Receiving receiving) {
    const bool named = receiving != Receiving::Unnamed;
    const auto technique = planar(named ? scene.receivers.get() : nullptr);
    if (receiving == Receiving::NamedAmongOthers) makeUnplain(*scene.screen);
    scene.addShadow(technique);
    scene.group->setCasters({scene.casters});
    scene.group->setDark(0.0f);
    if (!scene.discovered) scene.group->addLight(scene.light);
    return technique;
}

std::vector<Picture> threeFrames(const TwoReceivers& scene, const View& view) {
    Camera camera(scene.root, view);
    camera.viewer().setLightingMode(scene.mode);
    if (scene.viewersLight) camera.viewer().setLight(scene.viewersLight);
    return {camera.frame(), camera.frame(), camera.frame()};
}

TwoReceivers ReceiverTruth::build() const {
    TwoReceivers result = twoReceivers(_light);
    _given.change(result);
    return result;
}

ReceiverTruth::ReceiverTruth(const ReceiverCase& given, int angle) : _given(given), _light(lightAt(given.lamp, angle)) {
    const View& view = viewOfTwoReceivers();
    const TwoReceivers lit = build();
    TwoReceivers dark = build();
    putOut(dark);
    given.alsoDark(dark);
    _lit = threeFrames(lit, view);
    _dark = threeFrames(dark, view);
    _mask = castRays(square(8.0), castersAndScreens, lit.lightInWorld, view);
    const Mask left = castRays(leftHalf, castersAndScreens, lit.lightInWorld, view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            if (_mask.at(x, y) != Seen::ShadowedReceiver || _mask.atEdge(x, y)) continue;
            if (_lit.back().at(x, y) == _dark.back().at(x, y)) continue;
            ++(left.at(x, y) == Seen::ShadowedReceiver ? _onLeft : _onRight);
        }
}

ReceiverVerdict ReceiverTruth::judge(Receiving receiving) const {
    TwoReceivers shadowed = build();
    const auto technique = castOnReceivers(shadowed, receiving);
    const std::vector<Picture> frames = threeFrames(shadowed, viewOfTwoReceivers());
    ReceiverVerdict verdict;
    for (std::size_t i = 0; i < frames.size(); ++i) add(verdict, frames[i], _lit[i], _dark[i], _mask);
    verdict.causes = causesButLitSurfaces(*technique); // the screens receive nothing
    return verdict;
}

} // namespace test
