// SPDX-License-Identifier: MIT
// Stands before OpenSceneGraph in a program that gnomonrun started: these functions are called in the place of osgViewer's and
// osgUtil's of the same name, and call them in turn.
#include "OutputFile.h"
#include "RunClock.h"
#include "RunOptions.h"
#include "ShadowedScene.h"
#include "SideBySide.h"

#include <gnomon/SceneProps.h>

#include <OpenThreads/ScopedLock>
#include <osgUtil/SceneView>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <cstddef>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <functional>
#include <iostream>
#include <link.h>
#include <memory>
#include <set>
#include <string>
#include <unistd.h>
#include <vector>

namespace gnomon::examples {
namespace {

/// The name without its folder.
std::string fileOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

bool isOsgs(const std::string& file) {
    return file.rfind("libosg", 0) == 0 || file.rfind("libOpenThreads", 0) == 0 || file.rfind("osgdb_", 0) == 0;
}
bool isOurs(const std::string& file) { return file.rfind("gnomonrun", 0) == 0 || file.rfind("libgnomon", 0) == 0; }

const ElfW(Dyn) * dynamicPartOf(const dl_phdr_info& object) {
    for (std::size_t i = 0; i < object.dlpi_phnum; ++i)
        if (object.dlpi_phdr[i].p_type == PT_DYNAMIC)
            return reinterpret_cast<const ElfW(Dyn)*>(object.dlpi_addr + object.dlpi_phdr[i].p_vaddr);
    return nullptr;
}

bool needsOsg(const dl_phdr_info& object) {
    const ElfW(Dyn)* part = dynamicPartOf(object);
    const char* names = nullptr;
    for (const ElfW(Dyn)* entry = part; entry && entry->d_tag != DT_NULL; ++entry)
        if (entry->d_tag == DT_STRTAB) names = reinterpret_cast<const char*>(entry->d_un.d_ptr);
    if (!names || names < reinterpret_cast<const char*>(object.dlpi_addr)) return false; // the vDSO's are not moved
    for (const ElfW(Dyn)* entry = part; entry->d_tag != DT_NULL; ++entry)
        if (entry->d_tag == DT_NEEDED && isOsgs(names + entry->d_un.d_val)) return true;
    return false;
}

int look(dl_phdr_info* object, std::size_t, void* found) {
    const std::string file = fileOf(object->dlpi_name);
    if (!isOsgs(file) && !isOurs(file) && needsOsg(*object)) *static_cast<bool*>(found) = true;
    return 0;
}

/// True if the program, or a library that it has loaded, needs a library of OpenSceneGraph. This library and those of
/// OpenSceneGraph itself do not count.
bool programNeedsOsg() {
    bool found = false;
    dl_iterate_phdr(look, &found);
    return found;
}

constexpr double framesASecond = 60.0;
constexpr int turn = 10;      // frames with and without shadow, to tell what shadows cost
constexpr int patience = 100; // frames to wait for a picture from another thread

/// The picture goes from the draw thread to the one that runs the viewer.
struct Captured : osgViewer::ScreenCaptureHandler::CaptureOperation {
    void operator()(const osg::Image& image, const unsigned) override {
        const OpenThreads::ScopedLock<OpenThreads::Mutex> lock(mutex);
        picture = new osg::Image(image, osg::CopyOp::DEEP_COPY_ALL);
    }
    osg::ref_ptr<osg::Image> take() {
        const OpenThreads::ScopedLock<OpenThreads::Mutex> lock(mutex);
        return picture;
    }
    OpenThreads::Mutex mutex;
    osg::ref_ptr<osg::Image> picture;
};

Captured& captured() {
    static const osg::ref_ptr<Captured> one = new Captured;
    return *one;
}

void say(const std::string& line) { std::cerr << "gnomonrun: " << line << std::endl; }

/// All that gnomonrun's library does in a program. One a process; used by the thread that runs the viewers.
class ProgramRun {
public:
    /// Null if gnomonrun did not start the program.
    static ProgramRun* ofProcess() {
        static ProgramRun* const run = []() -> ProgramRun* {
            const char* options = std::getenv(optionsVariable);
            // never deleted: viewers may outlive what is static
            if (!options) return nullptr;
            CommandWords words(separated(options));
            return new ProgramRun(readRunOptions(words.arguments()));
        }();
        return run;
    }

    /// What a view is to show in the place of `scene`.
    osg::Node* shadowed(osg::Node* scene) {
        if (!scene) return nullptr;
        met(metScene);
        for (const auto& known : _scenes) {
            if (known->isRoot(*scene)) return scene;
            if (known->isOf(*scene)) return &known->root();
        }
        _scenes.push_back(std::make_unique<ShadowedScene>(_options.view, *scene));
        return &_scenes.back()->root();
    }

    /// The scene's time in seconds for the next frame: with --frames, 1/60 s after the last one, so that each run draws the same.
    /// @param wanted  what the program asks for; a time of its own stays.
    double timeOfFrame(double wanted) const {
        const bool ours = _options.frames > 0 && wanted == USE_REFERENCE_TIME;
        return ours ? _frame / framesASecond : wanted;
    }

    void beforeFrame(osgViewer::ViewerBase& viewer) {
        met(metFrame);
        guarded([&] {
            osgViewer::ViewerBase::Views views;
            viewer.getViews(views);
            for (osgViewer::View* view : views)
                for (const auto& scene : _scenes)
                    if (view->getSceneData() && scene->isRoot(*view->getSceneData())) scene->prepare(*view);
            choose();
        });
        if (!_options.out.empty() && _frame + 1 >= _options.frames && !_capture) capture(viewer);
        _clock.start(drawn());
    }

    /// Ends the process after the last frame asked for. @param draw  draws a frame as the program does.
    void afterFrame(osgViewer::ViewerBase& viewer, const std::function<void()>& draw) {
        _clock.stop();
        sayCauses();
        ++_frame;
        if (_options.diagnose || _options.frames == 0 || _frame < _options.frames) return;
        if (!_options.compare.empty()) compare(viewer, draw);
        if (_options.out.empty()) end(0);
        const osg::ref_ptr<osg::Image> picture = captured().take();
        if (!picture && _frame < _options.frames + patience) return;
        guarded([&] {
            if (!picture) throw std::runtime_error("no picture could be taken of this program's windows.");
            OutputFile(_options.out).write(*picture);
        });
        end(0);
    }

    /// What was met, once: gnomonrun reads it when the program has ended.
    void met(const std::string& what) {
        const char* report = std::getenv(reportVariable);
        if (report && _met.insert(what).second) std::ofstream(report, std::ios::app) << what << '\n';
    }

private:
    explicit ProgramRun(const RunOptions& options) : _options(options) {
        askForStencilBits();
        askForAlphaBits();
        met(metProgram);
        std::atexit([] { // where the program ends by itself
            if (programNeedsOsg()) ofProcess()->met(metOsg);
            ofProcess()->sayCosts();
        });
    }

    /// A sentence for what does not suit this program, and its end if it was to be ended.
    void guarded(const std::function<void()>& step) {
        try {
            step();
        } catch (const std::exception& error) {
            if (_said.insert(error.what()).second) say(error.what());
            if (_options.frames > 0) end(1);
        }
    }

    /// What this frame is drawn with.
    void choose() {
        if (_options.diagnose && _frame % _options.framesEach() == 0) {
            const auto number = static_cast<std::size_t>(_frame / _options.framesEach());
            if (number == shadowTechniques().size()) end(0);
            tryTechnique(number);
        }
        if (_options.diagnose || _options.frames == 0) return;
        const int left = _options.frames - 1 - _frame; // the last turn is one with shadow
        _shown = _options.compare.empty() && (left < 0 || left / turn % 2 == 0);
        for (const auto& scene : _scenes) scene->show(_shown);
    }

    void tryTechnique(std::size_t number) {
        const std::string name = shadowTechniques()[number];
        for (const auto& scene : _scenes) {
            try {
                scene->cast({parseShadowSpec(name)});
            } catch (const std::invalid_argument& error) {
                say(name + ": " + error.what());
            }
        }
    }

    /// Each cause once. With --frames or --diagnose a technique's last frame looks for those that take long to find.
    void sayCauses() {
        const bool ends = _options.diagnose || _options.frames > 0;
        const bool lastIsNext = ends && (_frame + 2) % _options.framesEach() == 0;
        for (const auto& scene : _scenes)
            for (const std::string& cause : lastIsNext ? scene->diagnose() : scene->causes())
                if (const std::string line = scene->technique() + ": " + cause; _said.insert(line).second)
                    say("note: " + line);
    }

    void capture(osgViewer::ViewerBase& viewer) {
        if (viewer.areThreadsRunning()) { // else it may be the last frame's picture, which they still draw
            viewer.stopThreading();
            viewer.startThreading();
        }
        _capture = new osgViewer::ScreenCaptureHandler(&captured());
        _capture->captureNextFrame(viewer);
    }

    [[noreturn]] void compare(osgViewer::ViewerBase& viewer, const std::function<void()>& draw) {
        guarded([&] {
            std::vector<ShadowedScene*> shown;
            for (const auto& scene : _scenes)
                if (scene->isPrepared()) shown.push_back(scene.get());
            for (const std::string& line : drawSideBySide(viewer, draw, _options.compare, shown)) say(line);
        });
        _clock = {};
        end(0);
    }

    void sayCosts() {
        for (const std::string& line : _clock.lines()) say(line);
    }

    /// Without the program's own way out, which is not known.
    [[noreturn]] void end(int status) {
        sayCosts();
        std::cout.flush();
        _exit(status);
    }

    std::string drawn() const { return _scenes.empty() || !_shown ? "none" : _scenes.back()->technique(); }

    RunOptions _options;
    std::vector<std::unique_ptr<ShadowedScene>> _scenes;
    std::set<std::string> _met, _said;
    RunClock _clock;
    osg::ref_ptr<osgViewer::ScreenCaptureHandler>
        _capture; ///< its callback takes itself from the camera while it runs.
    int _frame = 0;
    bool _shown = true;
};

} // namespace
} // namespace gnomon::examples

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
