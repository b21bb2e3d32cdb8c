// SPDX-License-Identifier: MIT
#include "ShadowedScene.h"
#include "ShadowControls.h"

#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowedScene>
#include <osgUtil/UpdateVisitor>

#include <algorithm>
#include <iostream>

namespace gnomon::examples {
ShadowedScene::ShadowedScene(const ViewOptions& options, osg::Node& scene)
    : _options(options), _scene(&scene), _setup(groupScene(options, scene)) {}

void ShadowedScene::prepare(osgViewer::View& view) {
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

/// A light at the eye casts shadows that nobody sees.
void ShadowedScene::light(osgViewer::View& view) {
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

void ShadowedScene::castByPeer() {
    osg::ref_ptr<osgShadow::ShadowedScene> peer = new osgShadow::ShadowedScene(new osgShadow::ShadowMap);
    osgUtil::UpdateVisitor update; // in which it gets ready; the program's scene is not yet below
    peer->accept(update);
    for (unsigned i = 0; i < _setup.group->getNumChildren(); ++i)
        if (!dynamic_cast<ShadowTechnique*>(_setup.group->getChild(i))) peer->addChild(_setup.group->getChild(i));
    _setup.root->removeChild(_setup.group);
    _setup.root->addChild(peer); // after the lights: it knows only those that cull met before
}

void ShadowedScene::addKeys(osgViewer::View& view) {
    _views.emplace_back(&view);
    view.addEventHandler(_hud);
    view.addEventHandler(new KeyHandler<ShadowControls>(shadowKeys(), *_controls, *_hud));
}

std::string ShadowedScene::technique() const {
    std::string names;
    for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques)
        names += (names.empty() ? "" : " + ") + technique->getName();
    return names.empty() ? "none" : names;
}

} // namespace gnomon::examples
