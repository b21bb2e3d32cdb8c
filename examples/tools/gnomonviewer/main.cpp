// SPDX-License-Identifier: MIT
// gnomonviewer: scene files with shadows in a window, as osgviewer shows them without.
#include "InputFile.h"
#include "SceneWindow.h"
#include "ShadowControls.h"
#include "ViewOptions.h"

#include <iostream>
#include <stdexcept>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

/// What gnomonviewer's command line asks for.
struct ViewerOptions {
    ViewOptions view = pictureOptions(4);
    double sunSpeed = 0.0; ///< 1 is the clock's.
    bool help = false;
};

Options viewerOptions(ViewerOptions& into) {
    Options table = viewOptions(into.view);
    table.push_back(sunSpeedOption(into.sunSpeed));
    table.push_back({"--help", "", "print this", "", [&into](const std::string&) { into.help = true; }});
    return table;
}

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
ViewerOptions readViewerOptions(osg::ArgumentParser& arguments) {
    ViewerOptions options;
    readViewOptions(arguments, viewerOptions(options), options.view, options.help);
    if (!options.help && options.sunSpeed > 0.0 && (!options.view.sun || options.view.lights.size() != 1))
        throw std::invalid_argument("--sun-speed needs exactly one --sun and no --light.");
    return options;
}

/// What --help prints.
std::string viewerHelp() {
    ViewerOptions defaults;
    return "gnomonviewer FILE... [OPTION...]\nShows scene files with shadows in a window.\n\nLengths are in the "
           "scene's unit. The z axis points up.\n\n" +
           describeOptions(viewerOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() + "\nKEYS\n" +
           keysHelp(shadowKeys()) + windowKeysHelp("gnomonviewer") + "\nExample: gnomonviewer data/lab8.osgt\n";
}

int show(const ViewerOptions& asked) {
    const ViewOptions& options = asked.view;
    SceneSetup setup = setUpScene(options, *readScene(options.files, "gnomonviewer"));
    for (const std::string& note : setup.notes()) std::cerr << "gnomonviewer: note: " << note << std::endl;
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
