// SPDX-License-Identifier: MIT
#include "SideBySide.h"
#include "FrameTime.h"
#include "OutputFile.h"
#include "RunClock.h"

#include <gnomon/ShadowSpec.h>

#include <nlohmann/json.hpp>
#include <osg/Notify>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

/// Counts OpenGL's errors, of which OpenSceneGraph warns, while it lives. All messages go where they went.
class GlErrorCount {
public:
    GlErrorCount();
    ~GlErrorCount();
    GlErrorCount(const GlErrorCount&) = delete;
    GlErrorCount& operator=(const GlErrorCount&) = delete;

    int count() const;

private:
    struct Handler;
    osg::ref_ptr<osg::NotifyHandler> _before;
    osg::ref_ptr<Handler> _handler;
};

struct GlErrorCount::Handler : osg::NotifyHandler {
    explicit Handler(osg::NotifyHandler* next) : after(next) {}
    void notify(osg::NotifySeverity severity, const char* message) override {
        errors += std::string(message).find("detected OpenGL error") != std::string::npos;
        if (after) after->notify(severity, message);
    }
    osg::ref_ptr<osg::NotifyHandler> after;
    int errors = 0;
};

GlErrorCount::GlErrorCount() : _before(osg::getNotifyHandler()), _handler(new Handler(_before)) {
    osg::setNotifyHandler(_handler);
}

GlErrorCount::~GlErrorCount() { osg::setNotifyHandler(_before); }

int GlErrorCount::count() const { return _handler->errors; }

constexpr int channels = 3; // alpha is not seen

/// All pixels about (x, y), as far as the picture goes, are as it is.
bool isEven(const PictureChange& of, int x, int y, int reach) {
    const std::uint8_t here = of.darker[std::size_t(y) * std::size_t(of.width) + std::size_t(x)];
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, of.height - 1); ++v)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, of.width - 1); ++u)
            if (of.darker[std::size_t(v) * std::size_t(of.width) + std::size_t(u)] != here) return false;
    return true;
}

constexpr int settling = 2; // frames: OSG keeps two scene views, each of which compiles in its first
constexpr int timed = 3;    // frames

using Scenes = std::vector<ShadowedScene*>;

/// What can be drawn, by the names of the files.
std::vector<std::string> specifications() {
    std::vector<std::string> names;
    for (const std::string& technique : shadowTechniques()) {
        if (technique == "none") continue;
        names.push_back(technique);
        names.push_back(technique + ":composite=blend");
    }
    return names;
}

/// @return why the technique does not suit the scenes; empty if it does.
std::vector<std::string> cast(const Scenes& scenes, const std::string& name) {
    std::vector<std::string> refusals;
    for (ShadowedScene* scene : scenes) {
        try {
            scene->cast({parseShadowSpec(name)});
        } catch (const std::invalid_argument& error) {
            refusals.push_back(error.what());
        }
    }
    return refusals;
}

std::vector<std::string> causesOf(const Scenes& scenes) {
    std::vector<std::string> causes;
    for (ShadowedScene* scene : scenes)
        for (const std::string& cause : scene->diagnose()) causes.push_back(cause);
    return causes;
}

std::string fileOf(std::string name) {
    std::replace(name.begin(), name.end(), ':', '-');
    std::replace(name.begin(), name.end(), '=', '-');
    return name + ".png";
}

osg::ref_ptr<osg::GraphicsContext> firstWindow(osgViewer::ViewerBase& viewer) {
    osgViewer::ViewerBase::Contexts contexts;
    viewer.getContexts(contexts);
    for (osg::GraphicsContext* context : contexts)
        if (context->getTraits() && !context->getTraits()->pbuffer) return context;
    throw std::runtime_error("the program shows no window.");
}

} // namespace

WindowPicture::WindowPicture(osg::GraphicsContext& window) : _own(window.getSwapCallback()) {}

void WindowPicture::swapBuffersImplementation(osg::GraphicsContext* window) {
    const osg::GraphicsContext::Traits& traits = *window->getTraits();
    _picture = new osg::
        Image; // from what is bound: toolkits give their windows framebuffers that OpenSceneGraph does not know
    glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    _picture->readPixels(0, 0, traits.width, traits.height, GL_RGBA, GL_UNSIGNED_BYTE);
    glPopClientAttrib();
    if (_own)
        _own->swapBuffersImplementation(window);
    else
        window->swapBuffersImplementation();
}

PictureChange changeOf(const osg::Image& without, const osg::Image& with, int least) {
    PictureChange change;
    change.width = without.s();
    change.height = without.t();
    change.darker.resize(std::size_t(change.width) * std::size_t(change.height));
    if (with.s() != change.width || with.t() != change.height) return change;
    for (int y = 0; y < change.height; ++y)
        for (int x = 0; x < change.width; ++x) {
            const unsigned char *before = without.data(unsigned(x), unsigned(y)),
                                *after = with.data(unsigned(x), unsigned(y));
            bool darker = false, brighter = false;
            for (int i = 0; i < channels; ++i) {
                darker |= before[i] - after[i] > least;
                brighter |= after[i] - before[i] > least;
            }
            change.brighterPixels += brighter;
            change.darkerPixels += darker && !brighter;
            change.darker[std::size_t(y) * std::size_t(change.width) + std::size_t(x)] = darker && !brighter;
        }
    return change;
}

int disagreement(const PictureChange& a, const PictureChange& b, int reach) {
    if (a.width != b.width || a.height != b.height) return std::max(a.darkerPixels, b.darkerPixels);
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(a.width) + std::size_t(x);
            count += a.darker[i] != b.darker[i] && isEven(a, x, y, reach) && isEven(b, x, y, reach);
        }
    return count;
}

SideBySide::SideBySide(osgViewer::ViewerBase& viewer, std::function<void()> draw, std::string folder)
    : _viewer(viewer),
      _draw(std::move(draw)),
      _folder(std::move(folder)),
      _window(firstWindow(viewer)),
      _picture(new WindowPicture(*_window)) {
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    _window->setSwapCallback(_picture);
}

/// Its number is another one, its time the same.
void SideBySide::nextFrame() {
    osgViewer::ViewerBase::Views views;
    _viewer.getViews(views);
    std::vector<osg::FrameStamp*> stamps{_viewer.getViewerFrameStamp()};
    for (osgViewer::View* view : views) stamps.push_back(view->getFrameStamp());
    std::sort(stamps.begin(), stamps.end());
    stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
    for (osg::FrameStamp* stamp : stamps)
        if (stamp) stamp->setFrameNumber(stamp->getFrameNumber() + 1);
    _draw();
}

SideBySide::Drawn SideBySide::draw(const std::string& name) {
    using Clock = std::chrono::steady_clock;
    std::cerr << "gnomonrun: drawing " << name << std::endl; // which one it was, should the program end in it
    const GlErrorCount errors;
    std::vector<double> times;
    for (int frame = 0; frame < settling + timed; ++frame) {
        const Clock::time_point start = Clock::now();
        nextFrame();
        const std::chrono::duration<double, std::milli> took = Clock::now() - start;
        if (frame >= settling) times.push_back(took.count());
    }
    if (!_picture->last()) throw std::runtime_error("no picture could be taken of this program's windows.");
    Drawn drawn;
    drawn.name = name;
    drawn.picture = new osg::Image(*_picture->last(), osg::CopyOp::DEEP_COPY_ALL);
    drawn.milliseconds = quartiles(times).median;
    drawn.glErrors = errors.count();
    return drawn;
}

void SideBySide::run(const Scenes& scenes) {
    requireFolder(_folder);
    for (ShadowedScene* scene : scenes) scene->cast({});
    std::vector<Drawn> all{draw("none"), draw("again")};
    for (const std::string& name : specifications()) {
        const std::vector<std::string> refusals = cast(scenes, name);
        Drawn drawn = draw(name);
        drawn.causes = causesOf(scenes);
        drawn.causes.insert(drawn.causes.end(), refusals.begin(), refusals.end());
        all.push_back(std::move(drawn));
    }
    for (ShadowedScene* scene : scenes) scene->castByPeer();
    all.push_back(draw("osgShadow::ShadowMap"));
    for (Drawn& drawn : all) drawn.change = changeOf(*all.front().picture, *drawn.picture);
    write(all);
    for (const Drawn& drawn : all) {
        _lines.push_back(drawn.name + ": " + millisecondsText(drawn.milliseconds) + " a frame, " +
                         std::to_string(drawn.change.darkerPixels) + " pixels in shadow");
    }
}

void SideBySide::write(const std::vector<Drawn>& all) const {
    nlohmann::ordered_json table;
    table["width"] = all.front().picture->s();
    table["height"] = all.front().picture->t();
    for (const Drawn& drawn : all) {
        OutputFile(_folder + "/" + fileOf(drawn.name)).write(*drawn.picture);
        table["drawn"].push_back({{"name", drawn.name},
                                  {"file", fileOf(drawn.name)},
                                  {"ms", drawn.milliseconds},
                                  {"darker", drawn.change.darkerPixels},
                                  {"brighter", drawn.change.brighterPixels},
                                  {"glErrors", drawn.glErrors},
                                  {"causes", drawn.causes}});
    }
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b)
            table["disagree"][all[a].name][all[b].name] = disagreement(all[a].change, all[b].change);
    OutputFile(_folder + "/compare.json").write(table.dump(1) + "\n");
}

} // namespace gnomon::examples
