// SPDX-License-Identifier: MIT
// gus_shadow: GusOnGames' box and its shadow on a plane that three points give.
#include "Example.h"
#include "Mesh.h"

#include <gnomon/Convert.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/Plane.h>

#include <osg/MatrixTransform>

#include <sstream>

namespace {

using namespace gnomon::examples;

constexpr double degreesAFrame = 1.0;

/// Three corners of the floor, counter-clockwise from its lit side, and the light: a place, or the way to a sun.
struct Floor {
    osg::Vec3d corner[3] = {{-4.0, -3.0, 0.0}, {4.0, -3.0, 0.0}, {4.0, 3.0, 1.0}};
    osg::Vec4d light{3.0, -2.0, 6.0, 1.0};
};

/// @throws std::invalid_argument, one sentence, for points on one line.
glm::dvec4 planeOf(const Floor& floor) {
    const auto plane = gnomon::planeFromPoints(gnomon::toGlm(floor.corner[0]), gnomon::toGlm(floor.corner[1]),
                                               gnomon::toGlm(floor.corner[2]));
    if (!plane)
        throw std::invalid_argument("--points lie on one line and give no plane. Give three points that do not.");
    return *plane;
}

class GusShadow {
public:
    explicit GusShadow(const Floor& floor) : _floor(floor), _plane(planeOf(floor)) {
        const osg::Vec3d side = floor.corner[1] - floor.corner[0], up = floor.corner[2] - floor.corner[1];
        const double size = std::min(side.length(), up.length());
        const osg::Vec3d normal(_plane.x, _plane.y, _plane.z), middle = floor.corner[0] + (side + up) / 2.0;
        _place = osg::Matrixd::translate(middle + normal * size * 0.3);
        _setup.root = new osg::Group;
        _setup.group = new gnomon::ShadowCasterGroup;
        _setup.root->addChild(_setup.group);
        const osg::ref_ptr<osg::Node> ground =
            painted(texturedQuad(floor.corner[0], side, up, 4.0), {0.9f, 0.9f, 0.9f, 1});
        ground->getStateSet()->setTextureAttributeAndModes(0, drawnTexture(2, [](int column, int row) {
                                                               return column == row ? osg::Vec3(0.75f, 0.72f, 0.6f)
                                                                                    : osg::Vec3(0.95f, 0.93f, 0.85f);
                                                           }));
        _setup.group->addChild(ground);
        const double half = size * 0.1;
        _box->addChild(painted(node(box(glm::dvec3(-half), glm::dvec3(half))), {0.8f, 0.35f, 0.15f, 1}));
        _setup.group->addChild(_box);
        const osg::ref_ptr<gnomon::PlanarShadowNode> shadow =
            new gnomon::PlanarShadowNode(osg::Vec4d(_plane.x, _plane.y, _plane.z, _plane.w));
        shadow->setReceiver({ground});
        _setup.group->addChild(shadow);
        _setup.techniques = {shadow};
        for (const osg::Vec3d& corner : floor.corner) _setup.bounds.expandBy(corner);
        _setup.bounds.expandBy(middle + normal * size * 0.5);
        _source = addLight(*_setup.root, floor.light);
        _box->setUpdateCallback(new EveryFrame([this](double) { turn(_turns ? degreesAFrame : 0.0); }));
        turn(30.0);
    }

    SceneSetup& setup() { return _setup; }
    void toggleMotion() { _turns = !_turns; }
    void toggleComposite() { _setup.toggleComposite(); }
    void drag(double right, double up) {
        _floor.light += osg::Vec4d(right, 0.0, up, 0.0) * (_setup.bounds.radius() / 200.0);
        _source->getLight()->setPosition(osg::Vec4(_floor.light));
    }
    /// The article speaks of the light's position and uses it as the way towards the light.
    void toggleKind() {
        _floor.light.w() = _floor.light.w() == 0.0 ? 1.0 : 0.0;
        drag(0.0, 0.0);
    }

    std::vector<std::string> describe() const {
        std::ostringstream plane, light;
        plane << "plane (" << _plane.x << ", " << _plane.y << ", " << _plane.z << ", " << _plane.w << ")";
        light << (_floor.light.w() == 0.0 ? "direction towards the light (" : "light at (") << _floor.light.x() << ", "
              << _floor.light.y() << ", " << _floor.light.z() << ") (k: position or direction, or drag)";
        const bool blends = _setup.blends();
        std::vector<std::string> lines = {
            plane.str(), light.str(), std::string("composite: ") + (blends ? "blend" : "relight") + " (r: the other)",
            std::string("the box ") + (_turns ? "turns" : "stands") + " (j: the other)"};
        for (const std::string& cause : _setup.causes()) lines.push_back(cause);
        return lines;
    }

private:
    void turn(double degrees) {
        _angle += degrees;
        const double angle = osg::DegreesToRadians(_angle);
        _box->setMatrix(osg::Matrixd::rotate(angle, osg::Vec3d(_plane.x, _plane.y, _plane.z)) * _place);
    }

    Floor _floor;
    glm::dvec4 _plane;
    SceneSetup _setup;
    osg::Matrixd _place;
    osg::ref_ptr<osg::MatrixTransform> _box = new osg::MatrixTransform;
    osg::ref_ptr<osg::LightSource> _source;
    double _angle = 0.0; // degrees
    bool _turns = false;
};

const std::vector<Key<GusShadow>> keys = {
    {'j', "The box turns or stands still.", [](GusShadow& c, Hud&) { c.toggleMotion(); }},
    {'k', "--light is the light's position, or the direction towards it.", [](GusShadow& c, Hud&) { c.toggleKind(); }},
    {'r', "Switch between relight and blend.", [](GusShadow& c, Hud&) { c.toggleComposite(); }},
    {'g', "Hide or show the text.", [](GusShadow&, Hud& hud) { hud.toggle(); }},
};

Options ownOptions(Floor& into) {
    return {{"--points", "x,y,z,x,y,z,x,y,z",
             "three points of the floor, counter-clockwise as seen from its lit side, -1e6 to 1e6 each",
             "-4,-3,0,4,-3,0,4,3,1",
             [&into](const std::string& text) {
                 const std::vector<double> n = readNumbers(text, 9, -1e6, 1e6);
                 for (std::size_t i = 0; i < 3; ++i) into.corner[i] = {n[3 * i], n[3 * i + 1], n[3 * i + 2]};
             }},
            {"--light", "x,y,z,w", "w = 1: position of the light; w = 0: direction towards it; -1e6 to 1e6 each",
             "3,-2,6,1", [&into](const std::string& text) { into.light = readLight(text, 1e6); }}};
}

int run(osg::ArgumentParser& arguments) {
    const ExampleText text = {
        "gus_shadow", "shows GusOnGames' box and its shadow.",
        "Shows a box and its shadow on the plane through three points, after GusOnGames, \"adding the textures\".\n",
        "gus_shadow --points 0,0,0,9,0,0,9,9,2 --out gus.png"};
    Floor floor;
    return runExample(arguments, text, ownOptions(floor), {}, keys, [&](const auto&) { return GusShadow(floor); });
}

} // namespace

int main(int argc, char** argv) { return runProgram("gus_shadow", argc, argv, run); }
