// SPDX-License-Identifier: MIT
// Stands before OpenSceneGraph in a program that gnomonrun started: these functions are called in the place of osgViewer's and
// osgUtil's of the same name, and call them in turn.
#include "ProgramRun.h"

#include <osgUtil/SceneView>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Viewer>

#include <dlfcn.h>

using gnomon::examples::ProgramRun;

namespace {

/// The same function in the next library. @param name  as compilers write it for the linker.
template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// osgViewer's own, with the run's time in the place of the clock's.
template <typename Viewer>
void advanceByRun(Viewer& viewer, double time, void (*osgs)(Viewer*, double)) {
    const ProgramRun* run = ProgramRun::ofProcess();
    const double settled = run ? run->timeOfFrame(time) : time;
    osgs(&viewer, settled);
    if (settled != time) viewer.getViewerFrameStamp()->setReferenceTime(settled);
}

/// Says that the library is in, whatever the program then does.
const bool isIn = [] {
    ProgramRun::ofProcess();
    return true;
}();

} // namespace

void osgViewer::View::setSceneData(osg::Node* node) {
    static const auto osgs =
        next<void (*)(osgViewer::View*, osg::Node*)>("_ZN9osgViewer4View12setSceneDataEPN3osg4NodeE");
    ProgramRun* run = ProgramRun::ofProcess();
    osgs(this, run ? run->shadowed(node) : node);
}

void osgViewer::Viewer::advance(double time) {
    static const auto osgs = next<void (*)(osgViewer::Viewer*, double)>("_ZN9osgViewer6Viewer7advanceEd");
    advanceByRun(*this, time, osgs);
}

void osgViewer::CompositeViewer::advance(double time) {
    static const auto osgs =
        next<void (*)(osgViewer::CompositeViewer*, double)>("_ZN9osgViewer15CompositeViewer7advanceEd");
    advanceByRun(*this, time, osgs);
}

void osgViewer::ViewerBase::renderingTraversals() {
    static const auto osgs = next<void (*)(osgViewer::ViewerBase*)>("_ZN9osgViewer10ViewerBase19renderingTraversalsEv");
    ProgramRun* run = ProgramRun::ofProcess();
    if (run) run->beforeFrame(*this);
    osgs(this);
    if (run) run->afterFrame(*this, [this] { osgs(this); });
}

/// Viewers cull by it, too; a program that calls it without a viewer is told of.
void osgUtil::SceneView::cull() {
    static const auto osgs = next<void (*)(osgUtil::SceneView*)>("_ZN7osgUtil9SceneView4cullEv");
    if (ProgramRun* run = ProgramRun::ofProcess()) run->met(gnomon::examples::metSceneView);
    osgs(this);
}
