// SPDX-License-Identifier: MIT
// halomagic: M. Kilgard's shadows, reflections and halos in one scene, by Gnomon's nodes.
#include "Example.h"
#include "Mesh.h"

#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>

#include <osg/MatrixTransform>
#include <osg/Switch>

#include <cmath>

namespace {

using namespace gnomon::examples;
using gnomon::HaloNode;
using gnomon::HaloPulse;
using gnomon::PlanarReflectionNode;
using gnomon::PlanarShadowNode;
using gnomon::ShadowCasterGroup;

struct Switches {
    bool shadows = true, reflection = true, object = true, light = true, directional = true, motion = false;
    bool shownHalo = false, blendedHalo = true, relight = false;
    int model = 0, texture = 1, shape = HaloNode::WHOLE;
};

constexpr float floorOpacity = 0.3f;
constexpr const char* modelNames[] = {"dinosaur", "sphere", "cube", "icosahedron"};
constexpr double mostHalo[] = {0.2, 0.35, 0.3, 0.5};
constexpr const char* textureNames[] = {"none", "nearest", "linear", "mipmap"};
constexpr osg::Texture::FilterMode filters[] = {osg::Texture::NEAREST, osg::Texture::NEAREST, osg::Texture::LINEAR,
                                                osg::Texture::LINEAR_MIPMAP_LINEAR};
constexpr const char* shapeNames[] = {"whole", "parts", "pixels"};

const char* is(bool on) { return on ? "on" : "OFF"; }

class HaloMagic {
public:
    HaloMagic() {
        _setup.root = _root;
        _setup.group = named(*_root, "shadows");
        _setup.techniques = {_shadow};
        _setup.bounds = {-20.0, -16.0, -20.0, 20.0, 16.0, 20.0};
        _model->setUpdateCallback(new EveryFrame([this](double seconds) { move(seconds); }));
        apply();
    }

    SceneSetup& setup() { return _setup; }
    void drag(double right, double up) {
        _angle += right / 40.0;
        _height += up / 20.0;
        apply();
    }
    void pulse() {
        if (switches.shape == HaloNode::PIXELS) switches.shape = HaloNode::WHOLE;
        switches.shownHalo = false;
        apply();
        _pulse->start();
    }

    /// Puts the scene as the switches are.
    void apply() {
        const Switches& s = switches;
        const auto mask = [](bool on) { return on ? ~0u : 0u; };
        _shadow->setNodeMask(mask(s.shadows && s.light && s.object));
        _mirror->setReflectance(osg::Vec3f(1, 1, 1) * (s.reflection ? 1.0f - floorOpacity : 0.0f));
        for (unsigned i = 0; i < _mirror->getNumChildren(); ++i) _mirror->getChild(i)->setNodeMask(mask(s.object));
        _models->setSingleChildOn(static_cast<unsigned>(s.model));
        _pulse->setAmplitude(mostHalo[s.model]);
        _halo->setShape(static_cast<HaloNode::Shape>(s.shownHalo ? s.shape : s.shape % HaloNode::PIXELS));
        _halo->setScale(s.shownHalo ? 1.0 + mostHalo[s.model] : 1.0);
        _halo->setColor(s.blendedHalo ? osg::Vec4f(0.8f, 0.8f, 0.0f, 0.3f) : osg::Vec4f(0.5f, 0.5f, 0.0f, 1.0f));
        _setup.group->setComposite(s.relight ? ShadowCasterGroup::RELIGHT : ShadowCasterGroup::BLEND);
        const float own = s.reflection ? 1.0f : floorOpacity; // without an image it lies over the black background
        (s.relight ? painted : paintedUnlit)(_floor, {own, own, own, 1}); // only what is lit can lose its light
        _scene->getStateSet()->setMode(GL_LIGHT0, s.light);
        placeLight(s.directional);
        if (s.model != 0) _model->setMatrix(osg::Matrixd::translate(0.0, 8.01, 0.0));
        _rings->setFilter(osg::Texture::MIN_FILTER, filters[s.texture]);
        _rings->setFilter(osg::Texture::MAG_FILTER, s.texture == 1 ? osg::Texture::NEAREST : osg::Texture::LINEAR);
        _floor->getStateSet()->setTextureMode(0, GL_TEXTURE_2D, s.texture != 0);
    }

    std::vector<std::string> describe() const {
        const Switches& s = switches;
        using std::string;
        const string halo = _pulse->isRunning() ? "pulsing" : s.shownHalo ? "shown" : "OFF";
        std::vector<string> lines = {
            string("model (n): ") + modelNames[s.model] + ", object (o) " + is(s.object) + ", motion (j) " +
                is(s.motion),
            "halo (p: pulse, k: show) " + halo + ", " + (s.blendedHalo ? "blended" : "opaque") + " (e), " +
                shapeNames[s.shape] + " (v)",
            string("shadows (a) ") + is(s.shadows) + ", " + (s.relight ? "relight" : "blend") + " (r)",
            string("reflection (d) ") + is(s.reflection) + "; floor (x): " + textureNames[s.texture],
            string("light (u) ") + is(s.light) + ", " + (s.directional ? "arrow: directional" : "ball: positional") +
                " (9; drag with the middle button)"};
        for (const auto& causes : {_setup.causes(), _mirror->diagnose(), _halo->diagnose()})
            lines.insert(lines.end(), causes.begin(), causes.end());
        return lines;
    }

    Switches switches;

private:
    void move(double seconds) {
        if (!switches.motion) return;
        drag(0.03 * 40.0, 0.0); // 0.03 a frame
        if (switches.model == 0)
            _model->setMatrix(osg::Matrixd::translate(0.0, 8.01 + 3.2 * std::abs(std::sin(seconds / 0.5)), 0.0));
    }

    void placeLight(bool directional) {
        const osg::Vec3d place(15.0 * std::cos(_angle), _height, 15.0 * std::sin(_angle));
        _light->getLight()->setPosition(osg::Vec4(osg::Vec4d(place, directional ? 0.0 : 1.0)));
        osg::Matrixd turned;
        turned.makeRotate(osg::Vec3d(1.0, 0.0, 0.0), place); // the arrow's shaft lies along x
        _place->setMatrix(turned * osg::Matrixd::translate(place));
        _marker->setSingleChildOn(directional ? 0 : 1);
    }

    osg::ref_ptr<osg::Group> _root = readKitScene(GNOMON_HALOMAGIC, "halomagic");
    osg::ref_ptr<osg::MatrixTransform> _model = named(*_root, "model"), _place = named(*_root, "light's place");
    osg::ref_ptr<osg::Switch> _models = named(*_root, "models"), _marker = named(*_root, "marker");
    osg::ref_ptr<HaloNode> _halo = named(*_root, "halo");
    osg::ref_ptr<HaloPulse> _pulse = dynamic_cast<HaloPulse*>(_halo->getUpdateCallback());
    osg::ref_ptr<PlanarReflectionNode> _mirror = named(*_root, "mirror");
    osg::ref_ptr<PlanarShadowNode> _shadow = named(*_root, "shadow");
    osg::ref_ptr<osg::LightSource> _light = named(*_root, "light");
    osg::ref_ptr<osg::Node> _floor = named(*_root, "floor"), _scene = named(*_root, "halomagic");
    osg::ref_ptr<osg::Texture> _rings =
        dynamic_cast<osg::Texture*>(_floor->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    SceneSetup _setup;
    double _angle = 0.0, _height = 20.0;
};

template <auto member>
void flip(HaloMagic& c, Hud&) {
    c.switches.*member = !(c.switches.*member);
    c.apply();
}

template <auto member, int count>
void next(HaloMagic& c, Hud&) {
    c.switches.*member = (c.switches.*member + 1) % count;
    c.apply();
}

const std::vector<Key<HaloMagic>> keys = {
    {'p', "Pulse: the halo grows and shrinks once.", [](HaloMagic& c, Hud&) { c.pulse(); }},
    {'k', "Show the halo at its largest.", flip<&Switches::shownHalo>},
    {'e', "Blended or opaque halo.", flip<&Switches::blendedHalo>},
    {'v', "Halo around the whole model, around its parts, or by pixels.", next<&Switches::shape, 3>},
    {'n', "Next model: dinosaur, sphere, cube, icosahedron.", next<&Switches::model, 4>},
    {'j', "Motion: the dinosaur jumps, the light circles.", flip<&Switches::motion>},
    {'u', "Light.", flip<&Switches::light>},
    {'9', "Directional light (arrow) or positional light (ball).", flip<&Switches::directional>},
    {'x', "Texture filter of the floor: nearest, linear, mipmap, no texture.", next<&Switches::texture, 4>},
    {'a', "Shadows.", flip<&Switches::shadows>},
    {'r', "Shadows relight a lit floor, or blend over an unlit one as in the source.", flip<&Switches::relight>},
    {'d', "Reflection.", flip<&Switches::reflection>},
    {'o', "The object and its pillar.", flip<&Switches::object>},
    {'g', "Hide or show the text.", [](HaloMagic&, Hud& hud) { hud.toggle(); }},
};

int run(osg::ArgumentParser& arguments) {
    const ExampleText text = {"halomagic", "shows shadows, reflections and halos at once.",
                              "Shows a dinosaur's shadow, reflection and halo, after M. Kilgard's halomagic.c.\n",
                              "halomagic --keys kv --out halo.png"};
    ExampleOptions options;
    options.view.width = options.view.height = 600;
    options.view.eye = osg::Vec3d(23.98, 36.93, -41.54); // his (0, 8, 60) by the scene's -150 and 30 degrees
    options.view.center = osg::Vec3d(-2.0, 6.93, 3.46), options.view.viewUp = osg::Vec3d(0.0, 1.0, 0.0);
    options.view.zNear = 20.0, options.view.zFar = 100.0;
    options.view.background = {0.0, 0.0, 0.0};
    return runExample(arguments, text, {}, options, keys, [](const auto&) { return HaloMagic(); });
}

} // namespace

int main(int argc, char** argv) { return runProgram("halomagic", argc, argv, run); }
