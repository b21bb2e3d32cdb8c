// SPDX-License-Identifier: MIT
#pragma once
#include "Hud.h"
#include "ShadowControls.h"

#include <osg/observer_ptr>
#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>
#include <osgUtil/UpdateVisitor>
#include <osgViewer/View>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::examples {

/// A scene of somebody's program with Gnomon's nodes above it.
///
/// It gets ground, lights and shadows in its first frame: when a program hands a scene over, it may still be empty.
class ShadowedScene {
public:
    ShadowedScene(const ViewOptions& options, osg::Node& scene)
        : _options(options), _scene(&scene), _setup(groupScene(options, scene)) {}

    osg::Node& root() const { return *_setup.root; }
    bool isOf(const osg::Node& scene) const { return _scene == &scene; }
    bool isRoot(const osg::Node& node) const { return _setup.root == &node; }

    /// Before a frame of `view`, which shows this scene. @throws std::invalid_argument, one sentence.
    void prepare(osgViewer::View& view) {
        if (!_controls) {
            light(view);
            _setup.furnish(_options);
            _controls = std::make_unique<ShadowControls>(_options, _setup);
            _hud = new Hud([this] { return _controls->describe(); });
            _hud->toggle(); // the program's picture, until somebody asks
            _setup.root->addChild(_hud->camera());
        }
        if (std::find(_views.begin(), _views.end(), &view) == _views.end()) addKeys(view);
    }

    /// True from its first frame on.
    bool isPrepared() const { return _controls != nullptr; }

    void show(bool shadows) { _setup.show(shadows); }
    /// Gives these instead of what the options ask. @throws std::invalid_argument, one sentence.
    void cast(const std::vector<ShadowSpec>& specs) { _setup.cast(specs); }
    /// Has osgShadow::ShadowMap cast instead, for good.
    void castByPeer() {
        osg::ref_ptr<osgShadow::ShadowedScene> peer = new osgShadow::ShadowedScene(new osgShadow::ShadowMap);
        osgUtil::UpdateVisitor update; // in which it gets ready; the program's scene is not yet below
        peer->accept(update);
        for (unsigned i = 0; i < _setup.group->getNumChildren(); ++i)
            if (!dynamic_cast<ShadowTechnique*>(_setup.group->getChild(i))) peer->addChild(_setup.group->getChild(i));
        _setup.root->removeChild(_setup.group);
        _setup.root->addChild(peer); // after the lights: it knows only those that cull met before
    }

    std::vector<std::string> diagnose() const { return _setup.diagnose(); }
    std::vector<std::string> causes() const { return _setup.causes(); }
    /// What draws the shadows now, as --shadow has it.
    std::string technique() const {
        std::string names;
        for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques)
            names += (names.empty() ? "" : " + ") + technique->getName();
        return names.empty() ? "none" : names;
    }

private:
    /// A light at the eye casts shadows that nobody sees.
    void light(osgViewer::View& view) {
        const bool own = !_options.lights.empty();
        if (!own && (view.getLightingMode() != osg::View::HEADLIGHT || !lightSourcesIn(*_setup.group).empty())) return;
        view.setLightingMode(osg::View::NO_LIGHT);
        if (own) return;
        _options.lights.push_back(sunAt(135.0, 45.0));
        std::cerr
            << "gnomonrun: note: the program lights its scene from the eye, where no shadow is seen. A sun takes that "
               "light's place; see --light."
            << std::endl;
    }

    void addKeys(osgViewer::View& view) {
        _views.emplace_back(&view);
        view.addEventHandler(_hud);
        view.addEventHandler(new KeyHandler<ShadowControls>(shadowKeys(), *_controls, *_hud));
    }

    ViewOptions _options;
    osg::observer_ptr<osg::Node> _scene;
    SceneSetup _setup;
    std::unique_ptr<ShadowControls> _controls; ///< null until the first frame.
    osg::ref_ptr<Hud> _hud;
    std::vector<osg::observer_ptr<osgViewer::View>> _views;
};

} // namespace gnomon::examples
