// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"
#include "ShadowControls.h"

#include <osgViewer/Viewer>

namespace gnomon::examples {

/// A window on one scene, with osgviewer's keys and gnomonviewer's own.
class ViewerWindow {
public:
    /// @throws std::invalid_argument or std::runtime_error, one sentence, if the options do not suit the scene or no
    /// window can be had.
    ViewerWindow(const ViewOptions& options, osg::Node& files);

    /// Until the user ends it. @return the program's exit status.
    int run() { return _viewer.run(); }

private:
    void openWindow(const ViewOptions& options);
    void addHandlers();
    void addOverlays();
    void placeHands(const ViewOptions& options);

    SceneSetup _setup;
    ShadowControls _controls;
    osg::ref_ptr<osg::ApplicationUsage> _usage;
    osgViewer::Viewer _viewer;
};

} // namespace gnomon::examples
