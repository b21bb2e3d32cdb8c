// SPDX-License-Identifier: MIT
#include "Example.h"
#include "InputFile.h"
#include "ScenePicture.h"

#include <iostream>

namespace gnomon::examples {
namespace {

using Text = const std::string&;

constexpr int mostFrames = 10000;

int readStencilBits(Text text) {
    if (text != "0" && text != "8") throw std::invalid_argument("Allowed: 0, 8.");
    return text == "0" ? 0 : 8;
}

Options exampleOptions(ExampleOptions& into, bool& help, const std::string& program) {
    Options table;
    addSize(table, into.view);
    table.push_back({"--out", "IMAGE", "write one picture to this file, without a window or display", "a window",
                     [&into](Text t) { into.out = t; }});
    table.push_back({"--offscreen", "", "the same as --out " + program + ".png", "",
                     [&into, program](Text) { into.out = program + ".png"; }});
    table.push_back(
        {"--keys", "LETTERS", "keys to press first, see KEYS below", "none", [&into](Text t) { into.keys = t; }});
    table.push_back({"--frames", "N", "frames to draw, 30 a second; the last one is written; 1 to 10000", "1",
                     [&into](Text t) { into.frames = readWhole(t, 1, mostFrames); }});
    table.push_back({"--stencil-bits", "0|8", "stencil bits of the picture's framebuffer", "8",
                     [&into](Text t) { into.stencilBits = readStencilBits(t); }});
    table.push_back({"--help", "", "print this", "", [&help](Text) { help = true; }});
    return table;
}

Options joined(Options first, const Options& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

std::string helpText(const ExampleText& text, const Options& table, const std::string& keys) {
    return text.program + " [OPTION...]" + (text.files.empty() ? "" : " " + text.files) + "\n" + text.about + "\n" +
           describeOptions(table) + osgOptionsHelp() + "\nKEYS\n" + keys +
           "  m        Show or hide the time that a frame takes to draw.\n" + windowKeysHelp(text.program) +
           "\nDrag with the left mouse button to move the camera" +
           (text.middleButton.empty() ? "" : ", with the middle one " + text.middleButton) +
           ".\n\nExample: " + text.example + "\n";
}

void takeFilesOf(const ExampleText& text, osg::ArgumentParser& arguments, ViewOptions& into) {
    if (!text.files.empty()) {
        takeFiles(arguments, into);
        if (into.files.empty() && text.files[0] != '[')
            throw std::invalid_argument("no scene file is given. Usage: " + text.program + " [OPTION...] " +
                                        text.files);
        return;
    }
    refuseUnknownOptions(arguments);
    if (arguments.argc() > 1)
        throw std::invalid_argument(std::string("\"") + arguments[1] +
                                    "\" is not an option. See --help for all options.");
}

} // namespace

std::optional<ExampleOptions> readExample(osg::ArgumentParser& arguments, const ExampleText& text, const Options& own,
                                          const ExampleOptions& defaults, const std::string& keys) {
    ExampleOptions into = defaults;
    bool help = false;
    const Options table = joined(own, exampleOptions(into, help, text.program));
    const std::string says = helpText(text, table, keys);
    readOptions(arguments, table);
    readOsgOptions(arguments);
    if (help) return std::cout << says, std::nullopt;
    takeFilesOf(text, arguments, into.view);
    return into;
}

osg::ref_ptr<osg::Group> readKitScene(const std::string& file, const std::string& program) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(readScene({file}, program));
    return root;
}

void writePicture(const ExampleText& text, const ExampleOptions& options, SceneSetup& setup, OutputFile& file) {
    setup.diagnose(); // who asks is not warned by osg::notify() besides
    const osg::ref_ptr<osg::Image> picture =
        ScenePicture(options.view, setup, options.stencilBits).draw(options.frames);
    for (const std::string& cause : setup.diagnose()) std::cerr << text.program << ": note: " << cause << std::endl;
    file.write(*picture);
}

} // namespace gnomon::examples
