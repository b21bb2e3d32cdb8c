// SPDX-License-Identifier: MIT
#include <gnomon/HeadlessContext.h>

#include <osgViewer/GraphicsWindow>
#include <osgViewer/View>
#include <osgViewer/ViewerBase>

#include <GL/osmesa.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <vector>

namespace gnomon {
namespace {

constexpr int largestSide = 16384;

std::runtime_error failure(const std::string& sentence) { return std::runtime_error("HeadlessContext: " + sentence); }

std::string sizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

void requireSize(const HeadlessContext::Options& o, int limit) {
    const bool fits = o.width >= 1 && o.height >= 1 && o.width <= limit && o.height <= limit;
    if (!fits)
        throw failure("a picture of " + sizeText(o.width, o.height) + " pixels cannot be made; allowed are 1x1 to " +
                      sizeText(limit, limit) + ".");
}

void requireBits(const HeadlessContext::Options& o) {
    if (o.depthBits != 16 && o.depthBits != 24 && o.depthBits != 32)
        throw failure(std::to_string(o.depthBits) + " depth bits cannot be had; allowed are 16, 24 and 32.");
    if (o.stencilBits != 0 && o.stencilBits != 8)
        throw failure(std::to_string(o.stencilBits) + " stencil bits cannot be had; allowed are 0 and 8.");
}

OSMesaContext createOSMesa(const HeadlessContext::Options& o) {
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, o.depthBits, o.stencilBits, 0, nullptr);
    if (!context) throw failure("OSMesa gives no context with these depth and stencil bits.");
    return context;
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

/// The window OSG sees. The OSMesa context lives as long as this object, so that the last picture can still be read
/// after a viewer has closed it.
class HeadlessContext::Window : public osgViewer::GraphicsWindowEmbedded {
public:
    explicit Window(const Options& options)
        : osgViewer::GraphicsWindowEmbedded(traitsOf(options).get()),
          _type(options.floatColor ? GL_FLOAT : GL_UNSIGNED_BYTE),
          _context(createOSMesa(options)) {
        getEventQueue()->syncWindowRectangleWithGraphicsContext();
    }

    /// Allocates the colour buffer and draws nothing into it. @throws std::runtime_error
    void start(const Options& options) {
        const std::size_t bytes =
            (options.floatColor ? 16u : 4u) * std::size_t(options.width) * std::size_t(options.height);
        try {
            _buffer.assign(bytes, 0);
        } catch (const std::bad_alloc&) {
            throw failure("there is no memory for " + sizeText(options.width, options.height) + " pixels.");
        }
        const Current current(*this);
        requireWorking(options);
    }

    bool valid() const override { return !_closed; }
    bool isRealizedImplementation() const override { return !_closed; }
    bool realizeImplementation() override { return !_closed; }
    void closeImplementation() override { _closed = true; }
    bool makeCurrentImplementation() override { return bind(); }
    bool makeContextCurrentImplementation(osg::GraphicsContext*) override { return bind(); }
    bool releaseContextImplementation() override { return unbind(); }
    void swapBuffersImplementation() override { glFinish(); } // brings the picture into _buffer

    osg::ref_ptr<osg::Image> color() {
        const Current current(*this);
        glFinish();
        osg::ref_ptr<osg::Image> image = emptyImage(*_traits, GL_RGBA, _type);
        std::copy(_buffer.begin(), _buffer.end(), image->data());
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
        OSMesaDestroyContext(_context);
    }

private:
    /// Makes a window current for a scope, and afterwards the one that was.
    class Current {
    public:
        explicit Current(Window& window) : _before(_current) {
            if (!window.bind()) throw failure("the OSMesa context cannot be made current.");
        }
        ~Current() { _before ? _before->bind() : unbind(); }
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        Window* _before;
    };

    bool bind() {
        if (!OSMesaMakeCurrent(_context, _buffer.data(), _type, _traits->width, _traits->height)) return false;
        _current = this;
        return true;
    }

    static bool unbind() {
        _current = nullptr;
        return OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0) != GL_FALSE;
    }

    void requireWorking(const Options& options) {
        const GLubyte* name = glGetString(GL_RENDERER);
        if (!name) throw failure("OpenGL calls do not reach OSMesa; link libOSMesa ahead of libGL.");
        _renderer = reinterpret_cast<const char*>(name);
        requireSize(options, std::min(largestSide, integer(GL_MAX_VIEWPORT_DIMS)));
        if (integer(GL_DEPTH_BITS) < options.depthBits || integer(GL_STENCIL_BITS) < options.stencilBits)
            throw failure("OSMesa gives fewer depth or stencil bits than asked for.");
    }

    static thread_local Window* _current;

    GLenum _type;
    OSMesaContext _context;
    std::vector<unsigned char> _buffer;
    std::string _renderer;
    bool _closed = false;
};

thread_local HeadlessContext::Window* HeadlessContext::Window::_current = nullptr;

HeadlessContext::HeadlessContext(int width, int height)
    : HeadlessContext([&] {
          Options options;
          options.width = width;
          options.height = height;
          return options;
      }()) {}

HeadlessContext::HeadlessContext(const Options& options) {
    requireSize(options, largestSide);
    requireBits(options);
    _window = new Window(options);
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
    if (!_window->valid())
        throw std::logic_error("HeadlessContext: its viewer has gone; make a new context for each viewer.");
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
