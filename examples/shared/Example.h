// SPDX-License-Identifier: MIT
#pragma once
#include "FrameTime.h"
#include "Keys.h"
#include "OutputFile.h"
#include "SceneWindow.h"

#include <gnomon/NamedNode.h>
#include <osg/FrameStamp>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osgGA/GUIEventHandler>

#include <functional>
#include <optional>
#include <stdexcept>

namespace gnomon::examples {

/// The first node of a scene with this name, of whatever class it is to be put into.
struct Named {
    osg::Node& scene;
    const char* name;

    /// @throws std::runtime_error, one sentence, if there is none: the scene's file is not the program's own.
    template <class Class>
    operator osg::ref_ptr<Class>() const {
        const auto found = findNamed(scene, name);
        auto* node = found ? dynamic_cast<Class*>(found->node.get()) : nullptr;
        if (!node)
            throw std::runtime_error(std::string("the scene has no ") + name +
                                     " of the needed kind. Use the scene file that comes with the program.");
        return node;
    }
};

inline Named named(osg::Node& scene, const char* name) { return {scene, name}; }

/// Calls a function in each update traversal, with the seconds of simulation time.
class EveryFrame : public osg::NodeCallback {
public:
    explicit EveryFrame(std::function<void(double seconds)> act) : _act(std::move(act)) {}

    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        _act(visitor->getFrameStamp() ? visitor->getFrameStamp()->getSimulationTime() : 0.0);
        traverse(node, visitor);
    }

private:
    std::function<void(double)> _act;
};

/// A mouse button that no longer moves the camera: tells how far it was dragged, pixels to the right and up.
class DragHandler : public osgGA::GUIEventHandler {
public:
    using Move = std::function<void(double right, double up)>;
    using Takes = std::function<bool(const osgGA::GUIEventAdapter& pushed)>;

    static bool middleButton(const osgGA::GUIEventAdapter& pushed) {
        return pushed.getButton() == osgGA::GUIEventAdapter::MIDDLE_MOUSE_BUTTON;
    }

    /// @param takes  whether it is for this handler that a button was pushed.
    explicit DragHandler(Move move, Takes takes = middleButton) : _move(std::move(move)), _takes(std::move(takes)) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
        using E = osgGA::GUIEventAdapter;
        const bool pushed = event.getEventType() == E::PUSH && _takes(event);
        const bool released = event.getEventType() == E::RELEASE && _down;
        const bool dragged = event.getEventType() == E::DRAG && _down;
        const double up = event.getMouseYOrientation() == E::Y_INCREASING_DOWNWARDS ? -1.0 : 1.0;
        if (dragged) _move(double(event.getX()) - _x, up * (double(event.getY()) - _y));
        if (pushed || released) _down = pushed;
        _x = double(event.getX());
        _y = double(event.getY());
        return pushed || released || dragged;
    }

private:
    Move _move;
    Takes _takes;
    bool _down = false;
    double _x = 0.0, _y = 0.0;
};

/// A button while shift is held, or else while `alone` holds.
inline DragHandler::Takes shiftAnd(int button, const std::function<bool()>& alone) {
    return [=](const osgGA::GUIEventAdapter& pushed) {
        const bool shift = (pushed.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_SHIFT) != 0;
        return pushed.getButton() == button && (shift || alone());
    };
}

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
    std::string files{}; ///< "FILE...": it takes files and needs one; "[FILE]": it may take some; empty: it takes none.
    std::string middleButton = "to move the light"; ///< what a drag with it is for; empty: it moves the camera, too.
};

/// Takes an example's own options, those of all examples and its files, or prints what --help prints.
/// @param defaults  what holds without options. @param keys  as keysHelp() lists them.
/// @return nullopt if it was help that was asked for. @throws std::invalid_argument, one sentence.
std::optional<ExampleOptions> readExample(osg::ArgumentParser& arguments, const ExampleText& text, const Options& own,
                                          const ExampleOptions& defaults, const std::string& keys);

/// A scene file that Gnomon's own nodes stand in, in a group.
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

/// What a program's mouse and clock do: a drag with the middle button; overloaded where it is something else.
template <class Controls>
void addHands(SceneWindow& window, Controls& controls) {
    window.add(*new DragHandler([&controls](double right, double up) { controls.drag(right, up); }));
}

/// A window or a picture of one scene with its controls. @param Controls  has SceneSetup& setup(), what its text says in
/// describe(), and what a drag with the middle mouse button does in drag(right, up), pixels; see addHands().
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
