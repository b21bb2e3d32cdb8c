// SPDX-License-Identifier: MIT
// cs4470_fakeshadow: the fake shadows of CS-4470, a turning cube over a checkerboard, the light at infinity.
#include "Example.h"
#include "Mesh.h"

#include <gnomon/Convert.h>
#include <gnomon/PlanarShadow.h>
#include <gnomon/PlanarShadowNode.h>

#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>

#include <cmath>
#include <sstream>

namespace {

using namespace gnomon::examples;

// The notes' numbers, y up.
constexpr double floorHeight = -200.0, floorSide = 500.0, cubeSide = 100.0;
const osg::Vec3d middle(0.0, 0.0, -511.0), viewer(0.0, 0.0, 200.0);
const osg::Vec4d floorPlane(0.0, 1.0, 0.0, -floorHeight);
constexpr float shadowOpacity = 0.4f;
constexpr int squares = 10;           // of the checkerboard, a side
constexpr double degreesAFrame = 1.0; // about x, y and z, as the notes' three rotations go

class FakeShadow {
public:
    FakeShadow() {
        _setup.root = new osg::Group;
        _setup.group = new gnomon::ShadowCasterGroup;
        _setup.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        _setup.group->setDark(1.0f - shadowOpacity);
        _setup.root->addChild(_setup.group);
        const osg::ref_ptr<osg::Node> floor = makeFloor();
        _setup.group->addChild(floor);
        const double half = cubeSide / 2.0;
        const float shades[6][3] = {{1, 0, 0}, {0, 0.7f, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {1, 0.5f, 0}};
        const Mesh faces = box(glm::dvec3(-half), glm::dvec3(half));
        for (std::size_t i = 0; i < 6; ++i) {
            const auto first = faces.begin() + std::ptrdiff_t(6 * i);
            _cube->addChild(paintedUnlit(node(Mesh(first, first + 6)), {shades[i][0], shades[i][1], shades[i][2], 1}));
            _faces->addChild(_cube->getChild(unsigned(i)));
        }
        _setup.group->addChild(_cube);
        darkenByEach(*_faces->getOrCreateStateSet());
        _faces->setNodeMask(0);
        _setup.root->addChild(_faces);
        _shadow->setReceiver({floor});
        _setup.group->addChild(_shadow);
        _setup.techniques = {_shadow};
        _setup.bounds = {-250.0, floorHeight, -761.0, 250.0, 50.0, -261.0};
        _source = addLight(*_setup.root, {0.0, 1.0, 0.0, 0.0});
        _cube->setUpdateCallback(new EveryFrame([this](double) { turn(_turns ? degreesAFrame : 0.0); }));
        turn(30.0);
        drag(0.0, 0.0);
    }

    SceneSetup& setup() { return _setup; }
    /// The light at infinity goes round the cube and up and down; half a degree a pixel.
    void drag(double right, double up) {
        _azimuth += right / 2.0;
        _elevation = std::clamp(_elevation + up / 2.0, 1.0, 89.0);
        const double a = osg::DegreesToRadians(_azimuth), e = osg::DegreesToRadians(_elevation);
        _source->getLight()->setPosition(
            _overhead ? osg::Vec4(0, 1, 0, 0)
                      : osg::Vec4(osg::Vec3d(std::cos(a) * std::cos(e), std::sin(e), std::sin(a) * std::cos(e)), 0.0));
        flatten();
    }
    /// The notes' code scales y by zero, whatever the light: that is a light overhead.
    void toggleOverhead() {
        _overhead = !_overhead;
        drag(0.0, 0.0);
    }
    void toggleMotion() { _turns = !_turns; }
    /// The notes' blending darkens a pixel once for each face that falls on it.
    void toggleFaces() {
        const bool once = !darkensOnce();
        _shadow->setNodeMask(once ? ~0u : 0u);
        _faces->setNodeMask(once ? 0u : ~0u);
    }

    std::vector<std::string> describe() const {
        std::ostringstream light;
        light << "light at infinity: azimuth " << _azimuth << ", elevation " << _elevation << " degrees (drag)";
        std::vector<std::string> lines = {
            (_overhead ? "light overhead: y scaled by zero" : light.str()) + " (k: the other)",
            std::string("each pixel is darkened ") +
                (darkensOnce() ? "once" : "for EACH FACE over it, as in the notes") + " (x: the other)",
            std::string("the cube ") + (_turns ? "turns" : "stands") + " (j: the other)"};
        for (const std::string& cause : _setup.causes()) lines.push_back(cause);
        return lines;
    }

private:
    bool darkensOnce() const { return _faces->getNodeMask() == 0; }

    /// Whatever colour is drawn, what stands there keeps 60 %.
    static void darkenByEach(osg::StateSet& states) {
        const float left = 1.0f - shadowOpacity;
        states.setAttributeAndModes(new osg::BlendFunc(GL_ZERO, GL_CONSTANT_COLOR));
        states.setAttribute(new osg::BlendColor(osg::Vec4(left, left, left, left)));
        states.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
        states.setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f)); // over the floor, in which they lie
        states.setRenderBinDetails(1, "RenderBin");
    }

    /// The notes' matrix, which lays the faces onto the floor.
    void flatten() {
        const auto flat = gnomon::planarShadowMatrix(gnomon::toGlm(floorPlane),
                                                     gnomon::toGlm(osg::Vec4d(_source->getLight()->getPosition())));
        if (flat) _faces->setMatrix(_cube->getMatrix() * gnomon::toOsg(*flat));
    }

    static osg::ref_ptr<osg::Node> makeFloor() {
        const osg::Vec3d corner(middle.x() - floorSide / 2.0, floorHeight, middle.z() + floorSide / 2.0);
        osg::ref_ptr<osg::Node> floor = paintedUnlit(
            texturedQuad(corner, {floorSide, 0.0, 0.0}, {0.0, 0.0, -floorSide}, squares / 2.0), {1, 1, 1, 1});
        floor->getStateSet()->setTextureAttributeAndModes(0, drawnTexture(2, [](int column, int row) {
                                                              return column == row ? osg::Vec3(0.2f, 0.2f, 0.2f)
                                                                                   : osg::Vec3(1.0f, 1.0f, 1.0f);
                                                          }));
        return floor;
    }

    void turn(double degrees) {
        _angle += degrees;
        const double angle = osg::DegreesToRadians(_angle);
        _cube->setMatrix(osg::Matrixd::rotate(angle, osg::X_AXIS, angle, osg::Y_AXIS, angle, osg::Z_AXIS) *
                         osg::Matrixd::translate(middle));
        flatten();
    }

    SceneSetup _setup;
    osg::ref_ptr<osg::MatrixTransform> _cube = new osg::MatrixTransform;
    osg::ref_ptr<osg::MatrixTransform> _faces = new osg::MatrixTransform; ///< the cube's, flattened as the notes do.
    osg::ref_ptr<gnomon::PlanarShadowNode> _shadow = new gnomon::PlanarShadowNode(floorPlane);
    osg::ref_ptr<osg::LightSource> _source;
    double _angle = 0.0, _azimuth = 35.0, _elevation = 65.0; // degrees
    bool _turns = false, _overhead = false;
};

const std::vector<Key<FakeShadow>> keys = {
    {'j', "The cube turns or stands still.", [](FakeShadow& c, Hud&) { c.toggleMotion(); }},
    {'k', "Light overhead as in the notes' code, or at infinity from the side.",
     [](FakeShadow& c, Hud&) { c.toggleOverhead(); }},
    {'x', "Darken a pixel once, or once for each face over it as in the notes' code.",
     [](FakeShadow& c, Hud&) { c.toggleFaces(); }},
    {'g', "Hide or show the text.", [](FakeShadow&, Hud& hud) { hud.toggle(); }},
};

int run(osg::ArgumentParser& arguments) {
    const ExampleText text = {
        "cs4470_fakeshadow", "shows the fake shadows of CS-4470.",
        "Shows a cube over a checkerboard and its shadow from a light at infinity, after CS-4470, \"Fake Shadows\".\n",
        "cs4470_fakeshadow --keys x --out twice.png"};
    ExampleOptions options;
    options.view.width = 640, options.view.height = 512; // aspect 1.25
    options.view.fovy = 45.0;
    options.view.eye = viewer, options.view.center = middle, options.view.viewUp = osg::Vec3d(0.0, 1.0, 0.0);
    options.view.zNear = 1.0, options.view.zFar = 10000.0;
    options.view.background = {0.0, 1.0, 1.0};
    return runExample(arguments, text, {}, options, keys, [](const auto&) { return FakeShadow(); });
}

} // namespace

int main(int argc, char** argv) { return runProgram("cs4470_fakeshadow", argc, argv, run); }
