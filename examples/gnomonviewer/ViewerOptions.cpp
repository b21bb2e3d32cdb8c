// SPDX-License-Identifier: MIT
#include "ViewerOptions.h"
#include "ShadowKeys.h"

namespace gnomon::examples {
namespace {

Options viewerOptions(ViewerOptions& into) {
    Options table = viewOptions(into.view);
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
    return options;
}

std::string viewerHelp() {
    ViewerOptions defaults;
    return "gnomonviewer FILE... [OPTION...]\n"
           "Shows scene files with shadows in a window.\n\n"
           "Lengths are in the scene's unit; everything is z up.\n\n" +
           describeOptions(viewerOptions(defaults)) + osgOptionsHelp() + "\nSPEC\n" + shadowSpecHelp() + "\nKEYS\n" +
           shadowKeysHelp() +
           "  1 ... 7  ways to move: trackball, flight, drive, terrain, orbit, first person, spherical; space: back\n"
           "  s        statistics\n"
           "  w l b t  wire frame, lighting, back faces, textures\n"
           "  f        full screen\n"
           "  c        picture of the window, gnomonviewer_0_0.png and on, in the folder where the program was "
           "started\n"
           "  h        all keys, on the screen\n"
           "  Esc      end\n"
           "\nExample: gnomonviewer data/lab8.osgt --shadow planar\n";
}

} // namespace gnomon::examples
