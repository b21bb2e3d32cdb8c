// SPDX-License-Identifier: MIT
#include "SceneWindow.h"
#include "Hud.h"
#include "OutputFile.h"

#include <gnomon/SceneProps.h>
#include <gnomon/ShadowStats.h>
#include <osgGA/DriveManipulator>
#include <osgGA/FirstPersonManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/SphericalManipulator>
#include <osgGA/StateSetManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>
#include <osgViewer/ViewerEventHandlers>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int corner = 50; // of the window on the screen, pixels from above and left

/// OSG's own messages are silent while this lives.
class Silence {
public:
    Silence() : _before(osg::getNotifyLevel()) { osg::setNotifyLevel(osg::ALWAYS); }
    ~Silence() { osg::setNotifyLevel(_before); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    osg::NotifySeverity _before;
};

/// Goes back to where the others do; OSG's own goes to the south, level, at a distance that nobody gave.
class Spherical : public osgGA::SphericalManipulator {
public:
    void home(double) override {
        osg::Vec3d eye, center, up;
        getHomePosition(eye, center, up);
        setDistance((eye - center).length());
        setByMatrix(osg::Matrixd::inverse(osg::Matrixd::lookAt(eye, center, up)));
    }
};

/// Speaks for all manipulators in a line or two: each one's own lines would crowd the others off the help.
class Hands : public osgGA::KeySwitchMatrixManipulator {
public:
    void getUsage(osg::ApplicationUsage& usage) const override {
        usage.addKeyboardMouseBinding(
            "1 ... 7", "Camera modes: trackball, flight, drive, terrain, orbit, first person, spherical.");
        usage.addKeyboardMouseBinding("Space", "Back to the first camera position.");
    }
};

/// osgviewer's, on osgviewer's number keys.
osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> makeHands() {
    osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> hands = new Hands;
    hands->addMatrixManipulator('1', "Trackball", new osgGA::TrackballManipulator);
    hands->addMatrixManipulator('2', "Flight", new osgGA::FlightManipulator);
    hands->addMatrixManipulator('3', "Drive", new osgGA::DriveManipulator);
    hands->addMatrixManipulator('4', "Terrain", new osgGA::TerrainManipulator);
    hands->addMatrixManipulator('5', "Orbit", new osgGA::OrbitManipulator);
    hands->addMatrixManipulator('6', "FirstPerson", new osgGA::FirstPersonManipulator);
    hands->addMatrixManipulator('7', "Spherical", new Spherical);
    return hands;
}

/// Where DISPLAY names none OSG would open a window on whatever screen is numbered 0, perhaps another user's.
bool namesDisplay() {
    const char* name = std::getenv("DISPLAY");
    return name && std::strchr(name, ':');
}

/// Writes pictures as PROGRAM_0_0.png and so on, by the first number that is no file yet: none is written over.
class NumberedPictures : public osgViewer::ScreenCaptureHandler::CaptureOperation {
public:
    explicit NumberedPictures(const std::string& program) : _program(program) {}

    void operator()(const osg::Image& picture, const unsigned int context) override {
        const std::string start = _program + "_" + std::to_string(context) + "_";
        int number = 0;
        while (std::filesystem::exists(start + std::to_string(number) + ".png")) ++number;
        try {
            OutputFile(start + std::to_string(number) + ".png").write(picture);
        } catch (const std::exception& error) {
            std::cerr << _program << ": note: " << error.what() << std::endl;
        }
    }

private:
    const std::string _program;
};

/// Has Mesa apply what is set: it puts that off, and where text was drawn last, the material of the last frame's end comes to stand
/// in the place of the next frame's first one. A model without colours then has another ambient colour. Costs a query a frame.
struct ApplyColours : public osg::Camera::DrawCallback {
    void operator()(osg::RenderInfo&) const override {
        float color[4];
        glGetFloatv(GL_CURRENT_COLOR, color);
    }
};

/// Keeps the background the colour of an added ground in the distance, wherever the lights are now.
class FadingGround : public osg::NodeCallback {
public:
    FadingGround(const SceneSetup& setup, osg::Camera& camera) : _setup(setup), _camera(&camera) {}

    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        _camera->setClearColor(osg::Vec4(osg::Vec3(_setup.farColour()), 1.0f));
        traverse(node, visitor);
    }

private:
    const SceneSetup& _setup;
    osg::Camera* _camera; // of the viewer, which updates the scene
};

} // namespace

SceneWindow::SceneWindow(const WindowNames& names, const ViewOptions& options, SceneSetup& setup, Hud& hud,
                         osgGA::GUIEventHandler& keys)
    : _usage(new osg::ApplicationUsage) {
    askForStencilBits();
    askForAlphaBits();                                            // soft edges
    _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded); // keys change what another thread could be drawing
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    openWindow(names, options);
    placeCamera(*_viewer.getCamera(), options, setup);
    setup.root->addChild(hud.camera());
    _viewer.getCamera()->setPreDrawCallback(new ApplyColours);
    if (!options.background) setup.root->addUpdateCallback(new FadingGround(setup, *_viewer.getCamera()));
    addHandlers(names, hud, keys);
    _viewer.setSceneData(setup.root);
    placeHands(options, setup);
}

void SceneWindow::openWindow(const WindowNames& names, const ViewOptions& options) {
    const Silence silence;
    osgViewer::Viewer::Windows windows;
    const auto tryToOpen = [&](int samples) {
        if (options.samples > 1) osg::DisplaySettings::instance()->setNumMultiSamples(unsigned(samples));
        if (namesDisplay()) _viewer.setUpViewInWindow(corner, corner, options.width, options.height);
        _viewer.getWindows(windows);
    };
    const bool isPlain = !options.needsSamples;
    tryToOpen(options.samples);
    if (windows.empty() && isPlain && options.samples > 1) tryToOpen(0);
    const std::string kind = isPlain ? "" : " of " + std::to_string(options.samples) + " samples";
    if (windows.empty())
        throw std::runtime_error("no window" + kind + " can be opened. " + (isPlain ? "" : "Give fewer --samples. ") +
                                 "Set DISPLAY to an X server with OpenGL, or use " + names.without +
                                 ", which needs no window.");
    _viewer.realize();
    windows.front()->setWindowName(names.program);
}

void SceneWindow::addHandlers(const WindowNames& names, Hud& hud, osgGA::GUIEventHandler& keys) {
    _viewer.addEventHandler(&hud);
    _viewer.addEventHandler(&keys);
    _viewer.addEventHandler(new osgGA::StateSetManipulator(_viewer.getCamera()->getOrCreateStateSet()));
    _viewer.addEventHandler(new osgViewer::WindowSizeHandler);
    _viewer.addEventHandler(new osgViewer::ScreenCaptureHandler(new NumberedPictures(names.program)));
    addOverlays(names, hud);
}

void SceneWindow::addOverlays(const WindowNames& names, Hud& hud) {
    osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    addShadowStats(*stats);
    keepLegible(*stats->getCamera()->getOrCreateStateSet());
    _viewer.addEventHandler(stats);
    _usage->setDescription(names.program + " " + names.does);
    osg::ref_ptr<osgViewer::HelpHandler> help = new osgViewer::HelpHandler(_usage);
    keepLegible(*help->getCamera()->getOrCreateStateSet());
    darkenBehind(*help->getCamera());
    hud.yieldTo(*help->getCamera());
    _viewer.addEventHandler(help);
}

void SceneWindow::placeHands(const ViewOptions& options, const SceneSetup& setup) {
    const Lookout place = lookout(options, setup);
    osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> hands = makeHands();
    hands->setHomePosition(place.eye, place.center, place.up, false);
    _viewer.setCameraManipulator(hands);
}

std::string windowKeysHelp(const std::string& program) {
    return "  1 ... 7  camera modes: trackball, flight, drive, terrain, orbit, first person, spherical; space: home\n"
           "  s        statistics\n"
           "  w l b t  wire frame, lighting, back faces, textures\n"
           "  f        full screen\n"
           "  c        save the window as " +
           program +
           "_0_0.png and so on, in the current folder\n"
           "  h        all keys, on the screen\n"
           "  Esc      end\n";
}

} // namespace gnomon::examples
