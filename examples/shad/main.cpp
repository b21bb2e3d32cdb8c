// SPDX-License-Identifier: MIT
// shad: CS-4470's two-pass z-buffer shadows, one additive pass a light, and Gnomon's compositor beside them.
#include "AddedLamps.h"
#include "Example.h"
#include "InputFile.h"

#include <gnomon/SceneProps.h>
#include <gnomon/ShadowMapTechnique.h>

#include <osg/Math>
#include <osg/Matrixd>

#include <cmath>
#include <iostream>
#include <sstream>
#include <vector>

namespace {

using namespace gnomon::examples;

/// Where something that looks at the origin stands, y up. Degrees; at azimuth 0 it stands on the z axis.
struct Orbit {
    double elevation = 0.0, azimuth = 0.0, distance = 1.0;

    osg::Matrixd view() const {
        return osg::Matrixd::rotate(osg::DegreesToRadians(azimuth), osg::Y_AXIS) *
               osg::Matrixd::rotate(osg::DegreesToRadians(elevation), osg::X_AXIS) *
               osg::Matrixd::translate(0.0, 0.0, -distance);
    }
    osg::Vec3d place() const { return osg::Vec3d() * osg::Matrixd::inverse(view()); }
};

/// Where a light is, what disco adds to that, and how it then turns from the middle. Degrees.
struct DiscoPlace {
    Orbit orbit;
    double raise = 0.0, turn = 0.0, wiggle = 0.0;

    osg::Matrixd view() const {
        return Orbit{orbit.elevation + raise, orbit.azimuth + turn, orbit.distance}.view() *
               osg::Matrixd::rotate(osg::DegreesToRadians(wiggle), osg::Y_AXIS);
    }
};

/// Lights that move one after the other, a unit of disco time each, 0.03 a frame: the first swings by 25 degrees to both
/// sides, the second goes a third of the way round, the third tips over and, the next time, back.
/// @param frame  0 is the first. @return which of the lights has moved.
/// Source: CS-4470, part 2, discotimestep() of shad.c.
inline std::size_t discoStep(std::vector<DiscoPlace>& lights, int frame) {
    constexpr double step = 0.03;
    const double time = step * frame, t = (time - std::floor(time)) / (1.0 - step);
    const std::size_t unit = std::size_t(time), light = unit % lights.size(), round = unit / lights.size();
    DiscoPlace& p = lights[light];
    if (light == 0) p.wiggle = 25.0 * std::sin(2.0 * osg::PI * t);
    if (light == 1) p.turn = 120.0 * (t + double(round % 3));
    if (light == 2) p.raise = (180.0 - 2.0 * p.orbit.elevation) * (round % 2 ? 1.0 - t : t);
    return light;
}

/// A subgraph moved and scaled so that the box about it has its middle at the origin and its corners this far away.
osg::ref_ptr<osg::MatrixTransform> fitted(osg::Node& root, double radius) {
    const osg::BoundingBoxd box = gnomon::sceneBounds(root);
    const double scale = box.valid() && box.radius() > 0.0 ? radius / box.radius() : 1.0;
    const osg::Vec3d middle = box.valid() ? box.center() : osg::Vec3d();
    osg::ref_ptr<osg::MatrixTransform> result =
        new osg::MatrixTransform(osg::Matrixd::translate(-middle) * osg::Matrixd::scale(scale, scale, scale));
    result->addChild(&root);
    return result;
}

constexpr double thingsRadius = 0.85; // what the objects are scaled to
constexpr int width = 640, height = 512;
const double eyeTurn = osg::DegreesToRadians(0.5); // a frame of disco
constexpr DiscoPlace places[] = {{{30, 0, 1.5}}, {{40, 120, 1.5}}, {{50, 240, 1.5}}, {{60, 270, 1.5}}};
const osg::Vec3 white[] = {{1, 1, 0.6f}, {1, 0.6f, 1}, {0.6f, 1, 1}, {1, 1, 1}};
const osg::Vec3 coloured[] = {{1, 0, 0}, {0, 0.6f, 0}, {0, 0, 1}, {1, 0.5f, 0}};

struct Switches {
    bool compositor = false, disco = false, colours = false, bicubic = false;
    bool fast = true, displaced = true, boxes = true;
    float bias = -0.0015f; // of depth, -1 … 1
};

class Shad {
public:
    Shad(const std::vector<std::string>& files, int lights)
        : _things(fitted(*readScene(files, "shad"), thingsRadius)),
          _lamps(*_things, lights),
          _places(places, places + lights) {
        _setup.root = _turn;
        _setup.bounds = {-1.0, -1.0, -1.0, 1.0, 1.0, 1.0};
        _setup.group = new gnomon::ShadowCasterGroup;
        _setup.group->addChild(_things);
        const osg::ref_ptr<gnomon::ShadowMapTechnique> map = new gnomon::ShadowMapTechnique;
        map->setSize(DepthPass::size);
        _setup.group->addChild(map);
        _setup.techniques = {map};
        for (std::size_t i = 0; i < _places.size(); ++i) _lamps[i].place(_places[i].view());
        _lamps.shineOn(*_setup.group);
        _lamps.node()->addChild(_setup.group);
        _turn->addChild(_lamps.node());
        _turn->setUpdateCallback(new EveryFrame([this](double) { step(); }));
        apply();
    }

    SceneSetup& setup() { return _setup; }
    void drag(double right, double up) { moveLight(up / 5.0, right / 2.0, 0.0); }
    /// Of the light last looked from, degrees; not in its own view while disco moves it.
    void moveLight(double raise, double turn, double away) {
        if (switches.disco && _view > 0) return;
        Orbit& o = _places[_last].orbit;
        o = {o.elevation + raise, o.azimuth + turn, std::clamp(o.distance + away, 0.2, 8.0)};
        place(_last);
    }
    bool looksFromLight() const { return _view > 0; }
    void nextView() {
        _view = (_view + 1) % (_places.size() + 1);
        if (_view > 0) _last = _view - 1;
        apply();
    }
    void toggleDisco() {
        switches.disco = !switches.disco;
        _frames = 0;
        for (std::size_t i = 0; i < _places.size(); ++i) _places[i] = {_places[i].orbit}, place(i);
    }
    void drawMapsAnew() { _lamps.setMaps(switches.fast, switches.displaced); }
    std::string mapsDrawn() const { return _lamps.mapsDrawn(); }

    /// Puts the scene as the switches are.
    void apply() {
        const Switches& s = switches;
        for (std::size_t i = 0; i < _places.size(); ++i)
            _lamps[i].setColor((s.colours ? coloured : white)[i], s.colours ? 0.75f : 0.25f);
        _lamps.showPasses(!s.compositor && _view == 0);
        _setup.group->setNodeMask(s.compositor && _view == 0 ? ~0u : 0u);
        _lamps.showBoxes(s.boxes);
        _lamps.setBias(s.bias);
        _lamps.setBicubic(s.bicubic);
        _lamps.lookFrom(_places[_last].view(), double(width) / height);
        _lamps.showView(_view > 0);
    }

    std::vector<std::string> describe() const {
        const Switches& s = switches;
        const auto is = [](bool on) { return on ? "on" : "OFF"; };
        std::ostringstream view, map, lamps;
        view << "view (v) from " << (_view > 0 ? "light " + std::to_string(_view) : "the eye") << "; light "
             << _last + 1 << " moves (a, z, shift and drag)";
        map << "bias (q, e) " << s.bias << ", displacement (d) " << is(s.displaced) << ", filter (x) "
            << (s.bicubic ? "bicubic" : "bilinear") << ", copy (u) " << (s.fast ? "fast" : "SLOW");
        lamps << (s.compositor ? "Gnomon's compositor" : "a pass a light, added") << " (n), "
              << (s.colours ? "coloured" : "white") << " lights (k), boxes (o) " << is(s.boxes) << ", disco (j) "
              << is(s.disco);
        std::vector<std::string> lines = {view.str(), map.str(), lamps.str(), mapsDrawn()};
        for (const std::string& cause : _setup.causes()) lines.push_back(cause);
        return lines;
    }

    Switches switches;

private:
    void place(std::size_t light) {
        _lamps[light].place(_places[light].view());
        if (light == _last) apply();
    }

    /// A frame of disco.
    void step() {
        if (!switches.disco) return;
        place(discoStep(_places, _frames++));
        _turn->postMult(osg::Matrixd::rotate(eyeTurn, osg::Y_AXIS));
    }

    SceneSetup _setup;
    osg::ref_ptr<osg::MatrixTransform> _turn = new osg::MatrixTransform, _things;
    AddedLamps _lamps;
    std::vector<DiscoPlace> _places;
    std::size_t _view = 0, _last = 0; // view: 0 is the eye's, else a light's
    int _frames = 0;                  // of disco
};

/// The camera's drags move the light while shift is held, or while it is what one looks from.
void addHands(SceneWindow& window, Shad& shad) {
    const auto inLightView = [&] { return shad.looksFromLight(); };
    window.add(*new DragHandler([&](double right, double up) { shad.drag(right, up); }));
    window.add(*new DragHandler([&](double right, double up) { shad.drag(right, up); },
                                shiftAnd(osgGA::GUIEventAdapter::LEFT_MOUSE_BUTTON, inLightView)));
    window.add(*new DragHandler([&](double, double up) { shad.moveLight(0.0, 0.0, -up / 150.0); },
                                shiftAnd(osgGA::GUIEventAdapter::RIGHT_MOUSE_BUTTON, inLightView)));
}

template <auto member>
void flip(Shad& c, Hud&) {
    c.switches.*member = !(c.switches.*member);
    c.apply();
}

template <auto member>
void flipMaps(Shad& c, Hud& hud) {
    flip<member>(c, hud), c.drawMapsAnew();
}

template <int steps>
void bias(Shad& c, Hud&) {
    c.switches.bias += 0.0001f * steps;
    c.apply();
}

const std::vector<Key<Shad>> keys = {
    {'v', "View from the eye, then from each light, where drags move it.", [](Shad& c, Hud&) { c.nextView(); }},
    {'n', "Shadows by one added pass for each light, or by Gnomon's compositor.", flip<&Switches::compositor>},
    {'a', "Turn the light of the last light view (at first light 1) by 10 degrees.",
     [](Shad& c, Hud&) { c.moveLight(0.0, 10.0, 0.0); }},
    {'z', "Raise that light by 5 degrees.", [](Shad& c, Hud&) { c.moveLight(5.0, 0.0, 0.0); }},
    {'j', "Disco: the lights move in turn, and the eye turns.", [](Shad& c, Hud&) { c.toggleDisco(); }},
    {'k', "Coloured or white lights.", flip<&Switches::colours>},
    {'o', "Boxes at the lights.", flip<&Switches::boxes>},
    {'x', "Filter 2 x 2 texels, or 4 x 4.", flip<&Switches::bicubic>},
    {'q', "Decrease the bias by 0.0001: surfaces shadow themselves less.", bias<-1>},
    {'e', "Increase the bias by 0.0001.", bias<1>},
    {'d', "Displace the depths in the maps by their slope.", flipMaps<&Switches::displaced>},
    {'u', "Copy the maps fast, or slowly through the CPU.", flipMaps<&Switches::fast>},
    {'g', "Hide or show the text.", [](Shad&, Hud& hud) { hud.toggle(); }},
};

int run(osg::ArgumentParser& arguments) {
    const ExampleText text = {
        "shad", "shows two-pass z-buffer shadows.",
        "Shows objects, y up, and their shadows from several spotlights, after CS-4470's shad.c.\n\nShift and the left "
        "button turn the light of the last light view. Shift and the right button move it in and out.\n",
        "shad data/shad.osgt --keys k --out shad.png", "FILE..."};
    int lights = 3;
    bool count = false;
    const Options own = {
        {"--lights", "N", "number of lights, 1 to 4", "3", [&](const auto& t) { lights = readWhole(t, 1, 4); }},
        {"--count", "", "print at the end how often each map was drawn", "", [&](const auto&) { count = true; }}};
    ExampleOptions usual;
    usual.view.width = width, usual.view.height = height;
    usual.view.eye = Orbit{25.0, 30.0, 2.3}.place(), usual.view.center = osg::Vec3d();
    usual.view.viewUp = osg::Vec3d(0.0, 1.0, 0.0);
    usual.view.zNear = AddedLamp::zNear, usual.view.zFar = AddedLamp::zFar;
    usual.view.background = {0.0, 0.125, 0.125}; // 0x002020
    const auto options = readExample(arguments, text, own, usual, keysHelp(keys));
    if (!options) return 0;
    Shad shad(options->view.files, lights);
    const int status = showExample(text, *options, keys, shad);
    if (count) std::cout << shad.mapsDrawn() << std::endl;
    return status;
}

} // namespace

int main(int argc, char** argv) { return runProgram("shad", argc, argv, run); }
