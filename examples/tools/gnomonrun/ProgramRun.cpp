// SPDX-License-Identifier: MIT
#include "ProgramRun.h"
#include "OutputFile.h"
#include "SideBySide.h"

#include <gnomon/SceneProps.h>

#include <OpenThreads/ScopedLock>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <link.h>
#include <unistd.h>

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

} // namespace

ProgramRun* ProgramRun::ofProcess() {
    static ProgramRun* const run = []() -> ProgramRun* {
        const char* options = std::getenv(optionsVariable);
        // never deleted: viewers may outlive what is static
        return options ? new ProgramRun(readRunOptions(separated(options))) : nullptr;
    }();
    return run;
}

ProgramRun::ProgramRun(const RunOptions& options) : _options(options) {
    askForStencilBits();
    askForAlphaBits();
    met(metProgram);
    std::atexit([] { // where the program ends by itself
        if (programNeedsOsg()) ofProcess()->met(metOsg);
        ofProcess()->sayCosts();
    });
}

void ProgramRun::met(const std::string& what) {
    const char* report = std::getenv(reportVariable);
    if (report && _met.insert(what).second) std::ofstream(report, std::ios::app) << what << '\n';
}

osg::Node* ProgramRun::shadowed(osg::Node* scene) {
    if (!scene) return nullptr;
    met(metScene);
    for (const auto& known : _scenes) {
        if (known->isRoot(*scene)) return scene;
        if (known->isOf(*scene)) return &known->root();
    }
    _scenes.push_back(std::make_unique<ShadowedScene>(_options.view, *scene));
    return &_scenes.back()->root();
}

double ProgramRun::timeOfFrame(double wanted) const {
    const bool ours = _options.frames > 0 && wanted == USE_REFERENCE_TIME;
    return ours ? _frame / framesASecond : wanted;
}

void ProgramRun::beforeFrame(osgViewer::ViewerBase& viewer) {
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

/// A sentence for what does not suit this program, and its end if it was to be ended.
void ProgramRun::guarded(const std::function<void()>& step) {
    try {
        step();
    } catch (const std::exception& error) {
        if (_said.insert(error.what()).second) say(error.what());
        if (_options.frames > 0) end(1);
    }
}

/// What this frame is drawn with.
void ProgramRun::choose() {
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

void ProgramRun::tryTechnique(std::size_t number) {
    const std::string name = shadowTechniques()[number];
    for (const auto& scene : _scenes) {
        try {
            scene->cast({parseShadowSpec(name)});
        } catch (const std::invalid_argument& error) {
            say(name + ": " + error.what());
        }
    }
}

std::string ProgramRun::drawn() const { return _scenes.empty() || !_shown ? "none" : _scenes.back()->technique(); }

void ProgramRun::afterFrame(osgViewer::ViewerBase& viewer, const std::function<void()>& draw) {
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

/// Each cause once.
void ProgramRun::sayCauses() {
    for (const auto& scene : _scenes)
        for (const std::string& cause : scene->diagnose())
            if (const std::string line = scene->technique() + ": " + cause; _said.insert(line).second)
                say("note: " + line);
}

void ProgramRun::capture(osgViewer::ViewerBase& viewer) {
    _capture = new osgViewer::ScreenCaptureHandler(&captured());
    _capture->captureNextFrame(viewer);
}

void ProgramRun::compare(osgViewer::ViewerBase& viewer, const std::function<void()>& draw) {
    guarded([&] {
        SideBySide comparison(viewer, draw, _options.compare);
        std::vector<ShadowedScene*> shown;
        for (const auto& scene : _scenes)
            if (scene->isPrepared()) shown.push_back(scene.get());
        comparison.run(shown);
        for (const std::string& line : comparison.lines()) say(line);
    });
    _clock = {};
    end(0);
}

void ProgramRun::sayCosts() {
    for (const std::string& line : _clock.lines()) say(line);
}

/// Without the program's own way out, which is not known.
void ProgramRun::end(int status) {
    sayCosts();
    std::cout.flush();
    _exit(status);
}

} // namespace gnomon::examples
