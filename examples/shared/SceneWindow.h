// SPDX-License-Identifier: MIT
#pragma once
#include "Hud.h"
#include "SceneSetup.h"

#include <osgViewer/Viewer>

#include <string>

namespace gnomon::examples {

/// What a window says of its program.
struct WindowNames {
    std::string program; ///< also the window's title, and how its pictures' names begin.
    std::string does;    ///< "shows scene files with shadows."
    std::string without; ///< what draws where there is no window.
};

/// A window on one scene, with osgviewer's keys, a program's own, and its text.
class SceneWindow {
public:
    /// @param setup  gets the text's camera; outlives it. @param keys  before osgviewer's.
    /// @throws std::invalid_argument or std::runtime_error, one sentence, if the options do not suit the scene or no
    /// window can be had.
    SceneWindow(const WindowNames& names, const ViewOptions& options, SceneSetup& setup, Hud& hud,
                osgGA::GUIEventHandler& keys);

    /// Another handler, after the program's own keys and before the ways to move.
    void add(osgGA::GUIEventHandler& handler) { _viewer.addEventHandler(&handler); }
    /// Until the user ends it. @return the program's exit status.
    int run() { return _viewer.run(); }

private:
    void openWindow(const WindowNames& names, const ViewOptions& options);
    void addHandlers(const WindowNames& names, Hud& hud, osgGA::GUIEventHandler& keys);
    void addOverlays(const WindowNames& names);
    void placeHands(const ViewOptions& options, const osg::BoundingBoxd& bounds);

    osg::ref_ptr<osg::ApplicationUsage> _usage;
    osgViewer::Viewer _viewer;
};

/// osgviewer's keys that there are, a line each, for --help.
std::string windowKeysHelp(const std::string& program);

} // namespace gnomon::examples
