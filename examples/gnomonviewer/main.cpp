// SPDX-License-Identifier: MIT
// gnomonviewer: scene files with shadows in a window, as osgviewer shows them without.
#include "SceneFile.h"
#include "ViewerOptions.h"
#include "ViewerWindow.h"

#include <iostream>

namespace {

using namespace gnomon::examples;

int run(osg::ArgumentParser& arguments) {
    const ViewerOptions options = readViewerOptions(arguments);
    if (options.help) {
        std::cout << viewerHelp();
        return 0;
    }
    return ViewerWindow(options.view, *readScene(options.view.files, "gnomonviewer")).run();
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("gnomonviewer", argc, argv, run); }
