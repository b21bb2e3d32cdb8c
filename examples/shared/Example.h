// SPDX-License-Identifier: MIT
#pragma once
#include "DragHandler.h"
#include "DrawTime.h"
#include "Keys.h"
#include "OutputFile.h"
#include "SceneWindow.h"

#include <optional>
#include <stdexcept>

namespace gnomon::examples {

/// What every source document's example has on its command line.
struct ExampleOptions {
    ViewOptions view;    ///< camera and size.
    std::string out;     ///< picture; empty: a window.
    std::string keys;    ///< pressed before the picture is drawn.
    int frames = 1;      ///< drawn for the picture.
    int stencilBits = 8; ///< 0 or 8, of the picture.
};

/// What an example says of itself.
struct ExampleText {
    std::string program; ///< also the window's title.
    std::string does;    ///< "shows …", one sentence.
    std::string about;   ///< for --help: a paragraph, lines of at most 120 letters.
    std::string example; ///< a command line.
    std::string files{}; ///< "FILE...": it takes scene files and needs one; empty: it takes none.
};

/// Takes an example's own options, those of all examples and its files, or prints what --help prints.
/// @param defaults  what holds without options. @param keys  as keysHelp() lists them.
/// @return nullopt if it was help that was asked for. @throws std::invalid_argument, one sentence.
std::optional<ExampleOptions> readExample(osg::ArgumentParser& arguments, const ExampleText& text, const Options& own,
                                          const ExampleOptions& defaults, const std::string& keys);

/// A scene file that Gnomon's own nodes stand in, in a group; the plugin that reads them is the one that this build made.
/// @throws std::runtime_error as readScene() does.
osg::ref_ptr<osg::Group> readKitScene(const std::string& file, const std::string& program);

/// Draws a scene into the file; why something is missing goes to standard error.
/// @throws std::runtime_error, one sentence, if there is no OpenGL.
void writePicture(const ExampleText& text, const ExampleOptions& options, SceneSetup& setup, OutputFile& file);

/// Does what a key does, by its letter. @throws std::invalid_argument, one sentence, if there is none.
template <class Controls>
void press(const std::string& letters, const std::vector<Key<Controls>>& keys, Controls& controls, Hud& hud) {
    for (const char letter : letters) {
        const Key<Controls>* key = findKey(keys, letter);
        if (!key)
            throw std::invalid_argument(std::string("--keys: there is no key ") + letter +
                                        ". See --help for all keys.");
        key->act(controls, hud);
    }
}

/// What a program's mouse does besides; overloaded where there is something.
template <class Controls>
void addHands(SceneWindow&, Controls&) {}

/// A window or a picture of one scene with its controls. @param Controls  has SceneSetup& setup(), what its text says in
/// describe(), and what a drag with the middle mouse button does in drag(right, up), pixels.
template <class Controls>
int showExample(const ExampleText& text, const ExampleOptions& options, const std::vector<Key<Controls>>& keys,
                Controls& controls) {
    const osg::ref_ptr<DrawTime> time = new DrawTime;
    const osg::ref_ptr<Hud> hud = new Hud([&] {
        std::vector<std::string> lines = controls.describe();
        if (!time->line().empty()) lines.push_back(time->line());
        lines.push_back("h shows all keys, g hides this text");
        return lines;
    });
    press(options.keys, keys, controls, *hud);
    if (!options.out.empty()) {
        OutputFile file(options.out);
        return file.requireImage(), writePicture(text, options, controls.setup(), file), 0;
    }
    const osg::ref_ptr<osgGA::GUIEventHandler> handler = new KeyHandler<Controls>(keys, controls, *hud);
    SceneWindow window({text.program, text.does, "--out IMAGE"}, options.view, controls.setup(), *hud, *handler);
    window.add(*time);
    window.add(*new DragHandler([&controls](double right, double up) { controls.drag(right, up); }));
    addHands(window, controls);
    return window.run();
}

/// All that an example does. @param make  what makes its controls of the options.
template <class Controls, class Make>
int runExample(osg::ArgumentParser& arguments, const ExampleText& text, const Options& own,
               const ExampleOptions& defaults, const std::vector<Key<Controls>>& keys, const Make& make) {
    const std::optional<ExampleOptions> options = readExample(arguments, text, own, defaults, keysHelp(keys));
    if (!options) return 0;
    Controls controls = make(*options);
    return showExample(text, *options, keys, controls);
}

} // namespace gnomon::examples
