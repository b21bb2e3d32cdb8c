// SPDX-License-Identifier: MIT
#include <gnomon/DepthShadow.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/TracedMark.h>

#include <osg/FrameBufferObject>
#include <osg/GLExtensions>
#include <osg/State>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

GLint integer(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

/// Pixels go to and come from memory as they are, without gaps; put back at its end.
class PlainPixels {
public:
    explicit PlainPixels(const osg::State& state) {
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPushAttrib(GL_CURRENT_BIT | GL_PIXEL_MODE_BIT);
        for (GLenum size : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SWAP_BYTES,
                            GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_LSB_FIRST})
            glPixelStorei(size, 0);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glPixelTransferf(GL_DEPTH_SCALE, 1.0f);
        glPixelTransferf(GL_DEPTH_BIAS, 0.0f);
        const auto* extensions = state.get<osg::GLExtensions>();
        if (!extensions->isPBOSupported) return;
        for (GLenum buffer : {GL_PIXEL_PACK_BUFFER_ARB, GL_PIXEL_UNPACK_BUFFER_ARB})
            extensions->glBindBuffer(buffer, 0);
    }
    ~PlainPixels() {
        glPopAttrib();
        glPopClientAttrib();
    }
    PlainPixels(const PlainPixels&) = delete;
    PlainPixels& operator=(const PlainPixels&) = delete;
};

/// What is neither cut away by the scissor, which stands at the marks' bounds, nor by the viewport.
DepthPicture partInScissor(const osg::Viewport& viewport) {
    GLint box[4];
    glGetIntegerv(GL_SCISSOR_BOX, box);
    DepthPicture part;
    part.viewportWidth = static_cast<int>(viewport.width());
    part.viewportHeight = static_cast<int>(viewport.height());
    part.x = std::max(0, box[0] - static_cast<int>(viewport.x()));
    part.y = std::max(0, box[1] - static_cast<int>(viewport.y()));
    part.width = std::min(box[2], part.viewportWidth - part.x);
    part.height = std::min(box[3], part.viewportHeight - part.y);
    return part;
}

/// glReadPixels reads no samples but a window's, which OpenGL resolves by itself.
bool isMultisampledObject(const osg::State& state) {
    return state.get<osg::GLExtensions>()->isFrameBufferObjectSupported && integer(GL_FRAMEBUFFER_BINDING_EXT) != 0 &&
           integer(GL_SAMPLES) > 0;
}

/// @return false if this framebuffer's depth cannot be read.
bool readDepth(osg::State& state, ResolvedDepth& resolved, DepthPicture& part) {
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const GLint x = part.x + static_cast<GLint>(viewport.x()), y = part.y + static_cast<GLint>(viewport.y());
    part.depths.resize(std::size_t(part.width) * std::size_t(part.height));
    part.step = std::ldexp(1.0, -std::min(integer(GL_DEPTH_BITS), 24));
    part.subpixel = std::ldexp(1.0, -std::clamp(integer(GL_SUBPIXEL_BITS), 4, 16));
    if (isMultisampledObject(state)) {
        const auto place = resolved.read(state, x, y, part.width, part.height, part.depths.data());
        part.place = place.value_or(part.place);
        return place.has_value();
    }
    part.offPlace = integer(GL_SAMPLES) > 0 ? 0.5 : 0.0; // whichever sample a window's depth is
    glReadPixels(x, y, part.width, part.height, GL_DEPTH_COMPONENT, GL_FLOAT, part.depths.data());
    return true;
}

/// A fragment where a bit is set. The empty bitmap moves the raster position, which no place off the screen may set.
void drawBits(osg::State& state, const DepthPicture& part, const std::vector<std::uint8_t>& bits) {
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glRasterPos2d(-1.0, -1.0);
    glBitmap(0, 0, 0.0f, 0.0f, static_cast<GLfloat>(part.x), static_cast<GLfloat>(part.y), nullptr);
    glBitmap(part.width, part.height, 0.0f, 0.0f, 0.0f, 0.0f, bits.data());
}

/// The same as rectangles, one for each run of bits in a row: of glBitmap Mesa's llvmpipe (22.3) takes one sample only.
void drawRuns(osg::State& state, const DepthPicture& part, const std::vector<std::uint8_t>& bits) {
    const osg::ref_ptr<osg::RefMatrix> pixels =
        new osg::RefMatrix(osg::Matrixd::ortho2D(0.0, part.viewportWidth, 0.0, part.viewportHeight));
    state.applyProjectionMatrix(pixels);
    state.applyModelViewMatrix(nullptr);
    const std::size_t stride = bits.size() / std::size_t(part.height);
    for (int y = 0; y < part.height; ++y) {
        const std::uint8_t* row = bits.data() + stride * std::size_t(y);
        const auto isSet = [row](int x) { return (row[x / 8] & (0x80 >> (x % 8))) != 0; };
        for (int x = 0, first = 0; x < part.width; first = x) {
            const bool set = isSet(first);
            while (x < part.width && isSet(x) == set) ++x;
            if (set) glRecti(part.x + first, part.y + y, part.x + x, part.y + y + 1);
        }
    }
}

} // namespace

std::string TracedMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    if (integer(GL_DEPTH_BITS) == 0)
        return "finds no depth bits in this framebuffer, from which it takes what is seen: give the camera a depth "
               "buffer.";
    const PlainPixels plain(state);
    DepthPicture part = partInScissor(*state.getCurrentViewport());
    if (part.width <= 0 || part.height <= 0) return "";
    if (!readDepth(state, *resolved, part))
        return "cannot resolve the depth of this multisampled framebuffer object: attach a renderbuffer for it, not a "
               "texture.";
    pass.stencilEqual(bit, 0, bit);
    const std::vector<std::uint8_t> bits = depthShadow(*scene, part, clipFromScene, light);
    (integer(GL_SAMPLES) > 0 ? drawRuns : drawBits)(state, part, bits);
    return "";
}

} // namespace gnomon
