// SPDX-License-Identifier: MIT
#include <gnomon/gl/FrameDepthCopy.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/WorkFramebuffer.h>

#include <OpenThreads/ScopedLock>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// Formats of depths: OpenGL copies between equal ones as they are, which is faster.
bool isPacked() { return glInteger(GL_DEPTH_BITS) == 24 && glInteger(GL_STENCIL_BITS) == 8; }

osg::ref_ptr<osg::Texture2D> depthTexture(bool packed) {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setInternalFormat(packed ? GL_DEPTH24_STENCIL8_EXT : GL_DEPTH_COMPONENT24);
    texture->setSourceFormat(packed ? GL_DEPTH_STENCIL_EXT : GL_DEPTH_COMPONENT);
    texture->setSourceType(packed ? GL_UNSIGNED_INT_24_8_EXT : GL_UNSIGNED_INT);
    texture->setResizeNonPowerOfTwoHint(false);
    for (const auto filter : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(filter, osg::Texture::NEAREST);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
        texture->setWrap(wrap, osg::Texture::CLAMP_TO_EDGE);
    return texture;
}

/// Depths are copied as they are.
class PlainTransfer {
public:
    PlainTransfer() {
        glPushAttrib(GL_PIXEL_MODE_BIT);
        glPixelTransferf(GL_DEPTH_SCALE, 1.0f);
        glPixelTransferf(GL_DEPTH_BIAS, 0.0f);
    }
    ~PlainTransfer() { glPopAttrib(); }
    PlainTransfer(const PlainTransfer&) = delete;
    PlainTransfer& operator=(const PlainTransfer&) = delete;
};

/// From a window to what is bound for drawing, `height` rows high.
void blitMirrored(const osg::GLExtensions& gl, const PixelRect& pixels, GLint height, GLbitfield what) {
    const GLint right = pixels.x + pixels.width, top = pixels.y + pixels.height;
    const GLboolean cut = glIsEnabled(GL_SCISSOR_TEST);
    glDisable(GL_SCISSOR_TEST);
    gl.glBlitFramebuffer(pixels.x, pixels.y, right, top, pixels.x, height - pixels.y, right, height - top, what,
                         GL_NEAREST);
    if (cut) glEnable(GL_SCISSOR_TEST);
}

int endOf(double start, double size) { return static_cast<int>(std::ceil(start + size)); }

constexpr double stepsOff = 4.0; // as depthBufferShadow()
constexpr double snapsOff = 2.0;

} // namespace

FrameDepthCopy::Copy FrameDepthCopy::copy(osg::State& state, const PixelRect& pixels) {
    Copy result;
    const GLint bits = glInteger(GL_DEPTH_BITS);
    if (bits == 0) return {noDepth};
    result.error.x = stepsOff * std::ldexp(1.0, -std::min(bits, 24));
    result.error.y = snapsOff * std::ldexp(1.0, -std::clamp(glInteger(GL_SUBPIXEL_BITS), 4, 16));
    const PlainTransfer plain;
    const bool resolves = ResolvedDepth::isNeeded(state), packed = !resolves && isPacked();
    Target& target = targetFor(state, pixels, packed);
    result.texture = target.texture;
    const auto read = [&] { result.rows = transfer(state, target, pixels); };
    if (resolves) {
        const auto place = _resolved.read(state, pixels.x, pixels.y, pixels.width, pixels.height, read);
        if (!place) return {unresolvedDepth};
        result.error.z = place->x - 0.5;
        result.error.w = place->y - 0.5;
        return result;
    }
    if (glInteger(GL_SAMPLES) > 0) result.error.y += 0.5; // whichever sample a window's depth is
    read();
    return result;
}

/// @return Copy::rows.
glm::dvec2 FrameDepthCopy::transfer(osg::State& state, Target& target, const PixelRect& pixels) {
    state.applyTextureAttribute(0, target.texture);
    if (target.mirrors && mirror(state, target, pixels)) return {target.texture->getTextureHeight() - 1, -1};
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, pixels.x, pixels.y, pixels.x, pixels.y, pixels.width, pixels.height);
    return {0.0, 1.0};
}

/// Rows of Mesa's windows go from the top, a texture's from the bottom: so mirrored, memory is copied and nothing drawn.
/// @return false if they do not, or pixels have several samples, or that is not possible: formats can differ though they have as many
///         bits.
bool FrameDepthCopy::mirror(osg::State& state, Target& target, const PixelRect& pixels) {
    const auto& gl = *state.get<osg::GLExtensions>();
    const bool sameBits = target.packed || glInteger(GL_DEPTH_BITS) == 24;
    if (!gl.glBlitFramebuffer || !sameBits || glInteger(GL_SAMPLES) > 0 || !isTopDown(state)) return false;
    const auto source = static_cast<GLuint>(glInteger(GL_READ_FRAMEBUFFER_BINDING_EXT));
    const ScratchFramebuffer framebuffer(gl);
    const osg::Texture::TextureObject* texture = target.texture->getTextureObject(state.getContextID());
    framebuffer.attachDepth(*texture);
    if (target.packed)
        gl.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_STENCIL_ATTACHMENT_EXT, GL_TEXTURE_2D, texture->id(), 0);
    const bool first = target.tried != texture;
    target.tried = texture;
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, source);
    if (first) glGetError(); // somebody else's
    blitMirrored(gl, pixels, target.texture->getTextureHeight(),
                 GL_DEPTH_BUFFER_BIT | (target.packed ? GL_STENCIL_BUFFER_BIT : 0));
    if (first) target.mirrors = glGetError() == GL_NO_ERROR;
    return target.mirrors;
}

FrameDepthCopy::Target& FrameDepthCopy::targetFor(const osg::State& state, const PixelRect& pixels, bool packed) {
    const osg::Viewport& viewport = *state.getCurrentViewport();
    Lock lock(_mutex);
    Target& target = _targets[{state.getContextID(), packed}];
    target.packed = packed;
    osg::ref_ptr<osg::Texture2D>& texture = target.texture;
    if (!texture) texture = depthTexture(packed);
    // As the viewport, not as the pixels: these grow with a shadow that moves, and each time another texture would be made.
    const int width =
        std::max({texture->getTextureWidth(), pixels.x + pixels.width, endOf(viewport.x(), viewport.width())});
    const int height =
        std::max({texture->getTextureHeight(), pixels.y + pixels.height, endOf(viewport.y(), viewport.height())});
    if (width != texture->getTextureWidth() || height != texture->getTextureHeight()) {
        texture->setTextureSize(width, height);
        texture->dirtyTextureObject();
    }
    return target;
}

void FrameDepthCopy::release(osg::State* state) {
    _resolved.release(state);
    Lock lock(_mutex);
    for (auto entry = _targets.begin(); entry != _targets.end();) {
        const bool meant = !state || state->getContextID() == entry->first.first;
        if (meant) entry->second.texture->releaseGLObjects(state);
        entry = meant ? _targets.erase(entry) : std::next(entry);
    }
}

} // namespace gnomon
