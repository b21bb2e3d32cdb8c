// SPDX-License-Identifier: MIT
#pragma once
#include "Hud.h"
#include "ShadowControls.h"

#include <osg/observer_ptr>
#include <osgViewer/View>

#include <memory>
#include <string>
#include <vector>

namespace gnomon::examples {

/// A scene of somebody's program with Gnomon's nodes above it.
///
/// It gets ground, lights and shadows in its first frame: when a program hands a scene over, it may still be empty.
class ShadowedScene {
public:
    ShadowedScene(const ViewOptions& options, osg::Node& scene);

    osg::Node& root() const { return *_setup.root; }
    bool isOf(const osg::Node& scene) const { return _scene == &scene; }
    bool isRoot(const osg::Node& node) const { return _setup.root == &node; }

    /// Before a frame of `view`, which shows this scene. @throws std::invalid_argument, one sentence.
    void prepare(osgViewer::View& view);

    /// True from its first frame on.
    bool isPrepared() const { return _controls != nullptr; }

    void show(bool shadows) { _setup.show(shadows); }
    /// Gives these instead of what the options ask. @throws std::invalid_argument, one sentence.
    void cast(const std::vector<ShadowSpec>& specs) { _setup.cast(specs); }
    /// Has osgShadow::ShadowMap cast instead, for good.
    void castByPeer();
    std::vector<std::string> diagnose() const { return _setup.diagnose(); }
    /// What draws the shadows now, as --shadow has it.
    std::string technique() const;

private:
    void light(osgViewer::View& view);
    void addKeys(osgViewer::View& view);

    ViewOptions _options;
    osg::observer_ptr<osg::Node> _scene;
    SceneSetup _setup;
    std::unique_ptr<ShadowControls> _controls; ///< null until the first frame.
    osg::ref_ptr<Hud> _hud;
    std::vector<osg::observer_ptr<osgViewer::View>> _views;
};

} // namespace gnomon::examples
