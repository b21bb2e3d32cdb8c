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
    takeUsualShadow(options.view);
    requireConsistent(options.view);
    if (options.sunSpeed > 0.0 && (!options.view.sun || options.view.lights.size() != 1))
        throw std::invalid_argument("--sun-speed needs exactly one --sun and no --light.");
    return options;
}

std::string viewerHelp() {
    ViewerOptions defaults;
    return "gnomonviewer FILE... [OPTION...]\nShows scene files with shadows in a window.\n\nLengths are in the "
           "scene's unit. The z axis points up.\n\n" +
           describeOptions(viewerOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() + "\nKEYS\n" +
           keysHelp(shadowKeys()) + windowKeysHelp("gnomonviewer") +
           "\nExample: gnomonviewer data/lab8.osgt\n";
}

} // namespace gnomon::examples
