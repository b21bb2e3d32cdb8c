// SPDX-License-Identifier: MIT
#include <gnomon/headless/OffscreenContext.h>

#include <GL/osmesa.h>

#include <new>
#include <vector>

namespace gnomon {
namespace {

class OSMesaOffscreen : public OffscreenContext {
public:
    explicit OSMesaOffscreen(const HeadlessOptions& o)
        : _width(o.width),
          _height(o.height),
          _type(o.floatColor ? GL_FLOAT : GL_UNSIGNED_BYTE),
          _buffer((o.floatColor ? 16u : 4u) * std::size_t(o.width) * std::size_t(o.height)),
          _context(OSMesaCreateContextExt(OSMESA_RGBA, o.depthBits, o.stencilBits, 0, nullptr)) {
        if (!_context)
            throw headlessFailure("OSMesa makes no context with these depth and stencil bits. Ask for fewer.");
    }
    ~OSMesaOffscreen() override { OSMesaDestroyContext(_context); }

    bool bind() override { return OSMesaMakeCurrent(_context, _buffer.data(), _type, _width, _height) != GL_FALSE; }
    bool unbind() override { return OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0) != GL_FALSE; }
    const unsigned char* pixels() const override { return _buffer.data(); } // OSMesa's glReadPixels clamps floats
    std::string name() const override { return "OSMesa"; }
    std::string linkRemedy() const override {
        return "Link gnomon::headless to the program itself with target_link_libraries(), or put -lOSMesa ahead of "
               "-lGL "
               "in its link line";
    }

private:
    int _width, _height;
    GLenum _type;
    std::vector<unsigned char> _buffer;
    OSMesaContext _context;
};

} // namespace

std::unique_ptr<OffscreenContext> makeOffscreenContext(const HeadlessOptions& options) try {
    return std::make_unique<OSMesaOffscreen>(options);
} catch (const std::bad_alloc&) {
    throw headlessFailure("there is not enough memory for a picture of " + sizeText(options.width, options.height) +
                          " pixels.");
}

} // namespace gnomon
