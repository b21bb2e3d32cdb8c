// SPDX-License-Identifier: MIT
#include <gnomon/HeadlessContext.h>
#include <gnomon/headless/OffscreenContext.h>

#include <osgViewer/GraphicsWindow>
#include <osgViewer/View>
#include <osgViewer/ViewerBase>

#include <algorithm>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr int largestSide = 16384;

void requireSize(const HeadlessContext::Options& o, int limit) {
    const bool fits = o.width >= 1 && o.height >= 1 && o.width <= limit && o.height <= limit;
    if (!fits)
        throw headlessFailure("a picture of " + sizeText(o.width, o.height) +
                              " pixels cannot be made. Allowed: 1x1 to " + sizeText(limit, limit) + ".");
}

void requireBits(const HeadlessContext::Options& o) {
    if (o.depthBits != 16 && o.depthBits != 24 && o.depthBits != 32)
        throw headlessFailure(std::to_string(o.depthBits) + " depth bits cannot be had. Allowed: 16, 24, 32.");
    if (o.stencilBits != 0 && o.stencilBits != 8)
        throw headlessFailure(std::to_string(o.stencilBits) + " stencil bits cannot be had. Allowed: 0, 8.");
}

int integer(GLenum name) {
    GLint values[2] = {0, 0}; // GL_MAX_VIEWPORT_DIMS has two
    glGetIntegerv(name, values);
    return values[1] ? std::min(values[0], values[1]) : values[0];
}

osg::ref_ptr<osg::GraphicsContext::Traits> traitsOf(const HeadlessContext::Options& o) {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->x = traits->y = 0;
    traits->width = o.width;
    traits->height = o.height;
    traits->depth = static_cast<unsigned>(o.depthBits);
    traits->stencil = static_cast<unsigned>(o.stencilBits);
    traits->red = traits->green = traits->blue = traits->alpha = o.floatColor ? 32 : 8;
    traits->doubleBuffer = false;
    return traits;
}

osg::ref_ptr<osg::Image> emptyImage(const osg::GraphicsContext::Traits& traits, GLenum format, GLenum type) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(traits.width, traits.height, 1, format, type);
    return image;
}

void keepOneThread(osg::View* view) {
    auto* viewerView = dynamic_cast<osgViewer::View*>(view);
    osgViewer::ViewerBase* viewer = viewerView ? viewerView->getViewerBase() : nullptr;
    if (!viewer) return;
    viewer->setUseConfigureAffinity(false); // else the main thread is pinned to one core for good
    if (viewer->getThreadingModel() == osgViewer::ViewerBase::AutomaticSelection)
        viewer->setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
}

} // namespace

/// The window OSG sees. The context lives as long as this object, so that the last picture can still be read
/// after a viewer has closed it.
class HeadlessContext::Window : public osgViewer::GraphicsWindowEmbedded {
public:
    Window(const Options& options, std::unique_ptr<OffscreenContext> context)
        : osgViewer::GraphicsWindowEmbedded(traitsOf(options).get()),
          _type(options.floatColor ? GL_FLOAT : GL_UNSIGNED_BYTE),
          _context(std::move(context)) {
        getEventQueue()->syncWindowRectangleWithGraphicsContext();
    }

    /// Draws nothing. @throws std::runtime_error
    void start(const Options& options) {
        const Current current(*this);
        _context->prepare(options);
        setDefaultFboId(_context->framebuffer());
        requireWorking(options);
    }

    bool valid() const override { return !_closed; }
    bool isRealizedImplementation() const override { return !_closed; }
    bool realizeImplementation() override { return !_closed; }
    void closeImplementation() override { _closed = true; }
    bool makeCurrentImplementation() override { return bind(); }
    bool makeContextCurrentImplementation(osg::GraphicsContext*) override { return bind(); }
    bool releaseContextImplementation() override { return unbind(); }
    void swapBuffersImplementation() override { glFinish(); } // a frame ends when its picture is there

    osg::ref_ptr<osg::Image> color() {
        const unsigned char* pixels = _context->pixels();
        if (!pixels) return read(GL_RGBA, _type);
        const Current current(*this);
        glFinish();
        osg::ref_ptr<osg::Image> image = emptyImage(*_traits, GL_RGBA, _type);
        std::copy_n(pixels, image->getTotalSizeInBytes(), image->data());
        return image;
    }

    osg::ref_ptr<osg::Image> read(GLenum format, GLenum type) {
        const Current current(*this);
        osg::ref_ptr<osg::Image> image = emptyImage(*_traits, format, type);
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, _traits->width, _traits->height, format, type, image->data());
        glPopClientAttrib();
        return image;
    }

    const std::string& renderer() const { return _renderer; }

protected:
    ~Window() override {
        if (_current == this) unbind();
    }

private:
    /// Makes a window current for a scope, and afterwards the one that was.
    class Current {
    public:
        explicit Current(Window& window) : _before(_current) {
            if (!window.bind())
                throw headlessFailure("the " + window._context->name() + " context cannot be made current.");
        }
        ~Current() { _before ? _before->bind() : unbind(); }
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        Window* _before;
    };

    bool bind() {
        if (!_context->bind()) return false;
        _current = this;
        return true;
    }

    static bool unbind() {
        Window* before = _current;
        _current = nullptr;
        return !before || before->_context->unbind();
    }

    void requireWorking(const Options& options) {
        const GLubyte* name = glGetString(GL_RENDERER);
        if (!name)
            throw headlessFailure("OpenGL calls do not reach " + _context->name() + ". " + _context->linkRemedy() +
                                  ".");
        _renderer = reinterpret_cast<const char*>(name);
        requireSize(options, std::min(largestSide, integer(GL_MAX_VIEWPORT_DIMS)));
        const bool fewer = integer(GL_DEPTH_BITS) < options.depthBits || integer(GL_STENCIL_BITS) < options.stencilBits;
        if (glGetError() == GL_NO_ERROR && fewer) // a core profile does not say
            throw headlessFailure(_context->name() + " has fewer depth or stencil bits than asked for. Ask for fewer.");
    }

    static thread_local Window* _current;

    GLenum _type;
    std::unique_ptr<OffscreenContext> _context;
    std::string _renderer;
    bool _closed = false;
};

thread_local HeadlessContext::Window* HeadlessContext::Window::_current = nullptr;

HeadlessContext::HeadlessContext(int width, int height) : HeadlessContext(Options{width, height}) {}

HeadlessContext::HeadlessContext(const Options& options) {
    requireSize(options, largestSide);
    requireBits(options);
    _window = new Window(options, makeOffscreenContext(options));
    _window->start(options);
}

HeadlessContext::~HeadlessContext() {
    if (_window->getState()) _window->close();
}

osg::GraphicsContext* HeadlessContext::graphicsContext() const { return _window.get(); }

void HeadlessContext::attach(osg::Camera& camera) const {
    const osg::GraphicsContext::Traits& traits = *_window->getTraits();
    attach(camera, new osg::Viewport(0, 0, traits.width, traits.height));
}

void HeadlessContext::attach(osg::Camera& camera, osg::Viewport* part) const {
    const osg::ref_ptr<osg::Viewport> held = part; // also where it is refused
    if (!_window->valid())
        throw std::logic_error(
            "HeadlessContext: the viewer that used this context is gone. Make a new context for each viewer.");
    camera.setGraphicsContext(_window.get());
    camera.setViewport(part);
    double fovy, aspect, zNear, zFar;
    if (camera.getProjectionMatrixAsPerspective(fovy, aspect, zNear, zFar))
        camera.setProjectionMatrixAsPerspective(fovy, part->aspectRatio(), zNear, zFar);
    keepOneThread(camera.getView());
}

osg::ref_ptr<osg::Image> HeadlessContext::image() const { return _window->color(); }
osg::ref_ptr<osg::Image> HeadlessContext::depth() const { return _window->read(GL_DEPTH_COMPONENT, GL_FLOAT); }

osg::ref_ptr<osg::Image> HeadlessContext::stencil() const {
    if (_window->getTraits()->stencil == 0) {
        osg::ref_ptr<osg::Image> none = emptyImage(*_window->getTraits(), GL_STENCIL_INDEX, GL_UNSIGNED_BYTE);
        std::fill(none->data(), none->data() + none->getTotalSizeInBytes(), static_cast<unsigned char>(0));
        return none;
    }
    return _window->read(GL_STENCIL_INDEX, GL_UNSIGNED_BYTE);
}

std::string HeadlessContext::renderer() const { return _window->renderer(); }

} // namespace gnomon
