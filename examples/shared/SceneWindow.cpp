// SPDX-License-Identifier: MIT
#include "ViewerWindow.h"
#include "Legible.h"
#include "ShadowKeys.h"

#include <osg/DisplaySettings>
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
            "1 ... 7", "Ways to move: trackball, flight, drive, terrain, orbit, first person, spherical.");
        usage.addKeyboardMouseBinding("Space", "Back to where the camera was first.");
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

osgViewer::ScreenCaptureHandler* makeCapture() {
    using Capture = osgViewer::ScreenCaptureHandler;
    return new Capture(new Capture::WriteToFile("gnomonviewer", "png", Capture::WriteToFile::SEQUENTIAL_NUMBER));
}

} // namespace

ViewerWindow::ViewerWindow(const ViewOptions& options, osg::Node& files)
    : _setup(setUpScene(options, files)), _controls(options, _setup), _usage(new osg::ApplicationUsage) {
    osg::DisplaySettings::instance()->setMinimumNumStencilBits(8);
    _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded); // keys change what another thread could be drawing
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    openWindow(options);
    placeCamera(*_viewer.getCamera(), options, _setup.bounds);
    addHandlers();
    _viewer.setSceneData(_setup.root);
    placeHands(options);
}

void ViewerWindow::openWindow(const ViewOptions& options) {
    const Silence silence;
    if (namesDisplay()) _viewer.setUpViewInWindow(corner, corner, options.width, options.height);
    osgViewer::Viewer::Windows windows;
    _viewer.getWindows(windows);
    if (windows.empty())
        throw std::runtime_error("no window can be opened: DISPLAY must name an X server with OpenGL and a stencil "
                                 "buffer; gnomonshot draws without one.");
    _viewer.realize();
    windows.front()->setWindowName("gnomonviewer");
}

void ViewerWindow::addHandlers() {
    osg::ref_ptr<Hud> hud = new Hud([this] { return _controls.describe(); });
    _setup.root->addChild(hud->camera());
    _viewer.addEventHandler(hud);
    _viewer.addEventHandler(new ShadowKeys(_controls, *hud));
    _viewer.addEventHandler(new osgGA::StateSetManipulator(_viewer.getCamera()->getOrCreateStateSet()));
    _viewer.addEventHandler(new osgViewer::WindowSizeHandler);
    _viewer.addEventHandler(makeCapture());
    addOverlays();
}

void ViewerWindow::addOverlays() {
    osg::ref_ptr<osgViewer::StatsHandler> stats = new osgViewer::StatsHandler;
    keepLegible(*stats->getCamera()->getOrCreateStateSet());
    _viewer.addEventHandler(stats);
    _usage->setDescription("gnomonviewer shows scene files with shadows.");
    osg::ref_ptr<osgViewer::HelpHandler> help = new osgViewer::HelpHandler(_usage);
    keepLegible(*help->getCamera()->getOrCreateStateSet());
    darkenBehind(*help->getCamera());
    _viewer.addEventHandler(help);
}

void ViewerWindow::placeHands(const ViewOptions& options) {
    const Lookout place = lookout(options, _setup.bounds);
    osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> hands = makeHands();
    hands->setHomePosition(place.eye, place.center, place.up, false);
    _viewer.setCameraManipulator(hands);
}

} // namespace gnomon::examples
