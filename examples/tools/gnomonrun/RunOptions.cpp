// SPDX-License-Identifier: MIT
#include "RunOptions.h"
#include "ShadowControls.h"

#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int mostFrames = 100000;
constexpr char separator = '\x1f'; // ASCII's own, which no option holds

using Text = const std::string&;

Options runOptions(RunOptions& into) {
    Options table;
    addShadowOptions(table, into.view);
    addLightOptions(table, into.view);
    table.push_back({"--frames", "N", "end the program after so many frames, 1 to 100000", "it ends by itself",
                     [&into](Text t) { into.frames = readWhole(t, 1, mostFrames); }});
    table.push_back({"--out", "IMAGE", "picture of the window at the last frame; needs --frames", "none",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--diagnose", "",
                     "try every technique in turn, N frames each or 60, print a table, and end the program", "",
                     [&into](Text) { into.diagnose = true; }});
    table.push_back({"--compare", "FOLDER",
                     "draw the last frame without shadows, with every technique and with osgShadow::ShadowMap, write "
                     "pictures and compare.json, and end the program; needs --frames",
                     "none", [&into](Text t) { into.compare = t; }});
    table.push_back({"--help", "", "print this", "", [&into](Text) { into.help = true; }});
    return table;
}

} // namespace

RunOptions::RunOptions() {
    view.ground = "none";
    view.keepLights = true;
}

RunOptions readRunOptions(osg::ArgumentParser& arguments) {
    RunOptions options;
    readOptions(arguments, runOptions(options));
    refuseUnknownOptions(arguments);
    if (options.help) return options;
    if (arguments.argc() > 1)
        throw std::invalid_argument(std::string("\"") + arguments[1] +
                                    "\" stands before --. Write gnomonrun OPTION... -- PROGRAM ARGUMENT...");
    if (!options.out.empty() && options.frames == 0) throw std::invalid_argument("--out needs --frames N.");
    if (!options.compare.empty() && options.frames == 0) throw std::invalid_argument("--compare needs --frames N.");
    if (options.diagnose + !options.out.empty() + !options.compare.empty() > 1)
        throw std::invalid_argument("--diagnose, --out and --compare exclude one another. Give one of them.");
    takeUsualShadow(options.view);
    return options;
}

std::string joined(const std::vector<std::string>& arguments) {
    std::string text;
    for (const std::string& word : arguments) text += (text.empty() ? "" : std::string(1, separator)) + word;
    return text;
}

std::vector<std::string> separated(const std::string& arguments) {
    std::vector<std::string> words;
    std::istringstream in(arguments);
    for (std::string word; std::getline(in, word, separator);) words.push_back(word);
    return words;
}

std::string runHelp() {
    RunOptions defaults;
    return "gnomonrun [OPTION...] -- PROGRAM [ARGUMENT...]\n"
           "Runs a program that shows its scene by osgViewer, and puts shadows into it. Nothing is rebuilt.\n\n"
           "Without --light or --sun the program's own lights cast; where it has none but "
           "the\nlight at the eye, whose shadows nobody sees, a sun takes its place.\n\n" +
           describeOptions(runOptions(defaults)) +
           "\nIt reaches scenes that the program gives to osgViewer::View::setSceneData(). It does not reach programs\n"
           "that link OpenSceneGraph statically, or draw with osgUtil::SceneView without a viewer.\n"
           "\nSPEC\n" +
           shadowSpecHelp() + "\nKEYS, as far as the program has no other use for them\n" + keysHelp(shadowKeys()) +
           "\nExample: gnomonrun --ground auto -- osgviewer cow.osgt.30,0,0.rot\n";
}

} // namespace gnomon::examples
