// SPDX-License-Identifier: MIT
#include "ViewerOptions.h"
#include "RunningSun.h"
#include "SceneWindow.h"
#include "ShadowKeys.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

Options viewerOptions(ViewerOptions& into) {
    Options table = viewOptions(into.view);
    table.push_back(sunSpeedOption(into.sunSpeed));
    table.push_back({"--help", "", "print this", "", [&into](const std::string&) { into.help = true; }});
    return table;
}

} // namespace

ViewerOptions readViewerOptions(osg::ArgumentParser& arguments) {
    ViewerOptions options;
    readOptions(arguments, viewerOptions(options));
    readOsgOptions(arguments);
    if (options.help) return options;
    readFiles(arguments, options.view);
    requireConsistent(options.view);
    if (options.sunSpeed > 0.0 && (!options.view.sun || options.view.lights.size() != 1))
        throw std::invalid_argument("--sun-speed needs --sun, once, and no --light beside it.");
    return options;
}

std::string viewerHelp() {
    ViewerOptions defaults;
    return "gnomonviewer FILE... [OPTION...]\n"
           "Shows scene files with shadows in a window.\n\n"
           "Lengths are in the scene's unit; everything is z up.\n\n" +
           describeOptions(viewerOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() + "\nKEYS\n" +
           keysHelp(shadowKeys()) + windowKeysHelp("gnomonviewer") +
           "\nExample: gnomonviewer data/lab8.osgt --shadow planar\n";
}

} // namespace gnomon::examples
