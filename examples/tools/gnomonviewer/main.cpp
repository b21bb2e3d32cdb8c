// SPDX-License-Identifier: MIT
// gnomonviewer: scene files with shadows in a window, as osgviewer shows them without.
#include "RunningSun.h"
#include "SceneFile.h"
#include "SceneWindow.h"
#include "ShadowKeys.h"
#include "ViewerOptions.h"

#include <iostream>

namespace {

using namespace gnomon::examples;

int show(const ViewerOptions& asked) {
    const ViewOptions& options = asked.view;
    SceneSetup setup = setUpScene(options, *readScene(options.files, "gnomonviewer"));
    ShadowControls controls(options, setup);
    const osg::ref_ptr<Hud> hud = new Hud([&] { return controls.describe(); });
    const osg::ref_ptr<osgGA::GUIEventHandler> keys = new KeyHandler<ShadowControls>(shadowKeys(), controls, *hud);
    const WindowNames names = {"gnomonviewer", "shows scene files with shadows.", "gnomonshot"};
    SceneWindow window(names, options, setup, *hud, *keys);
    runSun(window, asked.sunSpeed, [&](double seconds) { controls.runSun(seconds); });
    return window.run();
}

int run(osg::ArgumentParser& arguments) {
    const ViewerOptions options = readViewerOptions(arguments);
    if (!options.help) return show(options);
    std::cout << viewerHelp();
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("gnomonviewer", argc, argv, run); }
