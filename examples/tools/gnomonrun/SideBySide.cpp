// SPDX-License-Identifier: MIT
#include "SideBySide.h"
#include "FrameTime.h"
#include "OutputFile.h"
#include "RunClock.h"

#include <gnomon/ShadowSpec.h>

#include <metrics/Grid.h>
#include <nlohmann/json.hpp>
#include <osg/GraphicsContext>
#include <osg/Image>
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
    GlErrorCount() { osg::setNotifyHandler(_handler); }
    ~GlErrorCount() { osg::setNotifyHandler(_handler->after); }
    GlErrorCount(const GlErrorCount&) = delete;
    GlErrorCount& operator=(const GlErrorCount&) = delete;

    int count() const { return _handler->errors; }

private:
    struct Handler : osg::NotifyHandler {
        void notify(osg::NotifySeverity severity, const char* message) override {
            errors += std::string(message).find("detected OpenGL error") != std::string::npos;
            if (after) after->notify(severity, message);
        }

        const osg::ref_ptr<osg::NotifyHandler> after = osg::getNotifyHandler();
        int errors = 0;
    };

    const osg::ref_ptr<Handler> _handler = new Handler;
};

/// The picture of a window at each swap of its buffers: all of its cameras, whichever order they are drawn in. It waits
/// until OpenGL has drawn all.
class WindowPicture : public osg::GraphicsContext::SwapCallback {
public:
    /// Does as the window's own callback, if it has one, besides.
    explicit WindowPicture(osg::GraphicsContext& window) : _own(window.getSwapCallback()) {}

    void swapBuffersImplementation(osg::GraphicsContext* window) override {
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

    /// The last one, RGBA bytes; null before the first.
    const osg::Image* last() const { return _picture; }

private:
    osg::ref_ptr<osg::GraphicsContext::SwapCallback> _own;
    osg::ref_ptr<osg::Image> _picture;
};

constexpr int least = 2;    // of 255: smaller differences do not count
constexpr int reach = 3;    // pixels that are near
constexpr int channels = 3; // alpha is not seen

/// Which pixels of a picture are not those of the same picture without shadows. Both are RGBA bytes of one size.
struct PictureChange {
    metrics::Mask darker; ///< where a channel is darker by more than `least`, and none brighter.
    int darkerPixels = 0;
    int brighterPixels = 0; ///< with a channel that is brighter by more than `least`.
};

PictureChange changeOf(const osg::Image& without, const osg::Image& with) {
    PictureChange change{metrics::Mask(without.s(), without.t())};
    if (with.s() != without.s() || with.t() != without.t()) return change;
    for (int y = 0; y < without.t(); ++y)
        for (int x = 0; x < without.s(); ++x) {
            const unsigned char *before = without.data(unsigned(x), unsigned(y)),
                                *after = with.data(unsigned(x), unsigned(y));
            bool darker = false, brighter = false;
            for (int i = 0; i < channels; ++i) {
                darker |= before[i] - after[i] > least;
                brighter |= after[i] - before[i] > least;
            }
            change.brighterPixels += brighter;
            change.darkerPixels += darker && !brighter;
            change.darker.at(x, y) = darker && !brighter;
        }
    return change;
}

/// All pixels about (x, y), as far as the picture goes, are as it is.
bool isEven(const metrics::Mask& mask, int x, int y) {
    for (int v = y - reach; v <= y + reach; ++v)
        for (int u = x - reach; u <= x + reach; ++u)
            if (mask.holds(u, v) && mask.at(u, v) != mask.at(x, y)) return false;
    return true;
}

/// Pixels at which two changes differ although neither has an edge near.
int disagreement(const PictureChange& a, const PictureChange& b) {
    if (!a.darker.sameSize(b.darker)) return std::max(a.darkerPixels, b.darkerPixels);
    int count = 0;
    for (int y = 0; y < a.darker.height; ++y)
        for (int x = 0; x < a.darker.width; ++x)
            count += a.darker.at(x, y) != b.darker.at(x, y) && isEven(a.darker, x, y) && isEven(b.darker, x, y);
    return count;
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

struct Drawn {
    std::string name;
    osg::ref_ptr<osg::Image> picture;
    double milliseconds = 0.0; ///< a frame, median.
    int glErrors = 0;
    PictureChange change; ///< from the picture without shadows.
    std::vector<std::string> causes;
};

class SideBySide {
public:
    SideBySide(osgViewer::ViewerBase& viewer, const std::function<void()>& draw, const std::string& folder)
        : _viewer(viewer),
          _draw(draw),
          _folder(folder),
          _window(firstWindow(viewer)),
          _picture(new WindowPicture(*_window)) {
        viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        _window->setSwapCallback(_picture);
    }

    /// @return a line each, for people.
    std::vector<std::string> run(const Scenes& scenes) {
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
        std::vector<std::string> lines;
        for (const Drawn& drawn : all)
            lines.push_back(drawn.name + ": " + millisecondsText(drawn.milliseconds) + " a frame, " +
                            std::to_string(drawn.change.darkerPixels) + " pixels in shadow");
        return lines;
    }

private:
    /// Its number is another one, its time the same.
    void nextFrame() {
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

    Drawn draw(const std::string& name) {
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

    void write(const std::vector<Drawn>& all) const {
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

    osgViewer::ViewerBase& _viewer;
    const std::function<void()>& _draw;
    const std::string& _folder;
    osg::ref_ptr<osg::GraphicsContext> _window;
    osg::ref_ptr<WindowPicture> _picture;
};

} // namespace

std::vector<std::string> drawSideBySide(osgViewer::ViewerBase& viewer, const std::function<void()>& draw,
                                        const std::string& folder, const std::vector<ShadowedScene*>& scenes) {
    return SideBySide(viewer, draw, folder).run(scenes);
}

} // namespace gnomon::examples
