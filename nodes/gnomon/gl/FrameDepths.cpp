// SPDX-License-Identifier: MIT
#include <gnomon/gl/FrameDepths.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/WorkFramebuffer.h>

#include <OpenThreads/ScopedLock>
#include <glm/gtc/matrix_transform.hpp>
#include <osg/ContextData>
#include <osg/FrameBufferObject>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

GLint attachedDepth(GLenum what) { return attachmentParameter(GL_DEPTH_ATTACHMENT_EXT, what); }

/// The format of the depths that are drawn to: only between equal ones does OpenGL resolve. 0 if they are in no
/// renderbuffer.
GLenum depthFormat(const osg::GLExtensions& extensions) {
    const auto name = static_cast<GLuint>(attachedDepth(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME_EXT));
    const GLint kind = attachedDepth(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE_EXT);
    GLint format = 0;
    if (kind != GL_RENDERBUFFER_EXT || !extensions.glGetRenderbufferParameteriv) return 0;
    extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, name);
    extensions.glGetRenderbufferParameteriv(GL_RENDERBUFFER_EXT, GL_RENDERBUFFER_INTERNAL_FORMAT_EXT, &format);
    return static_cast<GLenum>(format);
}

/// Leaves `to` bound for reading.
void resolve(const osg::GLExtensions& extensions, GLuint from, GLuint to, const PixelRect& pixels) {
    const GLint right = pixels.x + pixels.width, top = pixels.y + pixels.height;
    extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, from);
    extensions.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, to);
    extensions.glBlitFramebuffer(pixels.x, pixels.y, right, top, pixels.x, pixels.y, right, top, GL_DEPTH_BUFFER_BIT,
                                 GL_NEAREST);
    extensions.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, to);
}

/// One pixel of several samples; bound for drawing while it lives.
class Pixel {
public:
    Pixel(const osg::GLExtensions& extensions, GLenum format, GLint samples)
        : framebuffer(extensions), _extensions(extensions) {
        extensions.glGenRenderbuffers(1, &_depth);
        extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _depth);
        extensions.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, samples, format, 1, 1);
        framebuffer.attachDepth(_depth);
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_SCISSOR_BIT);
        glViewport(0, 0, 1, 1);
        for (const GLenum mode : {GL_SCISSOR_TEST, GL_STENCIL_TEST}) glDisable(mode);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
        glDepthMask(GL_TRUE);
    }
    ~Pixel() {
        glPopAttrib();
        _extensions.glDeleteRenderbuffers(1, &_depth);
    }
    Pixel(const Pixel&) = delete;
    Pixel& operator=(const Pixel&) = delete;

    const ScratchFramebuffer framebuffer;

private:
    const osg::GLExtensions& _extensions;
    GLuint _depth = 0;
};

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

/// From a window to what is bound for drawing, `height` rows high.
void blitMirrored(const osg::GLExtensions& gl, const PixelRect& pixels, GLint height, GLbitfield what) {
    const GLint right = pixels.x + pixels.width, top = pixels.y + pixels.height;
    const GLboolean cut = glIsEnabled(GL_SCISSOR_TEST);
    glDisable(GL_SCISSOR_TEST);
    gl.glBlitFramebuffer(pixels.x, pixels.y, right, top, pixels.x, height - pixels.y, right, height - top, what,
                         GL_NEAREST);
    if (cut) glEnable(GL_SCISSOR_TEST);
}

constexpr double stepsOff = 4.0; // as depthBufferShadow()
constexpr double snapsOff = 2.0;

PixelRect united(const PixelRect& a, const PixelRect& b) {
    if (a.empty() || b.empty()) return a.empty() ? b : a;
    const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

bool holds(const PixelRect& all, const PixelRect& part) {
    return part.x >= all.x && part.y >= all.y && part.x + part.width <= all.x + all.width &&
           part.y + part.height <= all.y + all.height;
}

std::mutex sharedMutex; // constant, as the next is: techniques may be made before main()
std::weak_ptr<FrameDepths> sharedDepths;

std::shared_ptr<FrameDepths> sharedIfAny() {
    const std::lock_guard<std::mutex> lock(sharedMutex);
    return sharedDepths.lock();
}

} // namespace

std::optional<glm::dvec2> ResolvedDepth::read(osg::State& state, const PixelRect& pixels,
                                              const std::function<void()>& readOut) {
    const auto& extensions = *state.get<osg::GLExtensions>();
    const SavedFramebuffers bound(extensions);
    const GLenum format = depthFormat(extensions);
    if (!format || !extensions.glBlitFramebuffer || !extensions.glRenderbufferStorageMultisample) return std::nullopt;
    Buffers& buffers = of(state.getContextID());
    const GLint samples = glInteger(GL_SAMPLES);
    const bool known = buffers.format == format && buffers.samples == samples;
    const GLsizei width = pixels.x + pixels.width, height = pixels.y + pixels.height;
    if (!known || buffers.width < width || buffers.height < height) {
        buffers.format = format;
        buffers.samples = samples;
        fit(buffers, extensions, width, height);
    }
    const ScratchFramebuffer framebuffer(extensions);
    framebuffer.attachDepth(buffers.depth);
    if (!framebuffer.isComplete()) return std::nullopt;
    if (!known)
        buffers.place = {placeOnSlope(buffers, framebuffer.name, state, false),
                         placeOnSlope(buffers, framebuffer.name, state, true)};
    resolve(extensions, bound.draw, framebuffer.name, pixels);
    readOut();
    return buffers.place;
}

ResolvedDepth::Buffers& ResolvedDepth::of(unsigned context) {
    Lock lock(_mutex);
    return _buffers[context];
}

void ResolvedDepth::fit(Buffers& buffers, const osg::GLExtensions& extensions, GLsizei width, GLsizei height) {
    if (!buffers.depth) extensions.glGenRenderbuffers(1, &buffers.depth);
    buffers.width = std::max(buffers.width, width);
    buffers.height = std::max(buffers.height, height);
    extensions.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffers.depth);
    extensions.glRenderbufferStorage(GL_RENDERBUFFER_EXT, buffers.format, buffers.width, buffers.height);
}

/// Over a pixel whose depth rises from 0 to 1, the resolved depth is the place.
double ResolvedDepth::placeOnSlope(const Buffers& buffers, GLuint into, osg::State& state, bool upwards) {
    const auto& extensions = *state.get<osg::GLExtensions>();
    const Pixel pixel(extensions, buffers.format, buffers.samples);
    drawQuad(state, 0.0, upwards ? 0.0 : 1.0, upwards ? 1.0 : 0.0);
    float place = 0.5f;
    resolve(extensions, pixel.framebuffer.name, into, {0, 0, 1, 1});
    glReadPixels(0, 0, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &place);
    return static_cast<double>(place);
}

bool ResolvedDepth::isNeeded(const osg::State& state) {
    return state.get<osg::GLExtensions>()->isFrameBufferObjectSupported && glInteger(GL_FRAMEBUFFER_BINDING_EXT) != 0 &&
           glInteger(GL_SAMPLES) > 0;
}

void ResolvedDepth::release(const osg::State* state) {
    Lock lock(_mutex);
    for (auto entry = _buffers.begin(); entry != _buffers.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        if (meant) letGo(entry->first, entry->second);
        entry = meant ? _buffers.erase(entry) : std::next(entry);
    }
}

void ResolvedDepth::letGo(unsigned context, const Buffers& buffers) {
    if (!buffers.depth) return;
    osg::get<osg::GLRenderBufferManager>(context)->scheduleGLObjectForDeletion(buffers.depth);
}

std::shared_ptr<FrameDepths> FrameDepths::shared() {
    const std::lock_guard<std::mutex> lock(sharedMutex);
    std::shared_ptr<FrameDepths> depths = sharedDepths.lock();
    if (!depths) sharedDepths = depths = std::make_shared<FrameDepths>();
    return depths;
}

void FrameDepths::begin(const osg::State& state, const PixelRect& pixels) {
    const std::shared_ptr<FrameDepths> depths = sharedIfAny();
    if (!depths) return;
    const std::shared_ptr<Kept> kept = depths->of(state);
    kept->held = {};
    kept->wanted = pixels;
}

void FrameDepths::hold(osg::State& state, const PixelRect& pixels) {
    if (const std::shared_ptr<FrameDepths> depths = sharedIfAny()) depths->copy(state, pixels);
}

void FrameDepths::forget(const osg::State& state) {
    if (const std::shared_ptr<FrameDepths> depths = sharedIfAny()) depths->drop(state);
}

std::shared_ptr<FrameDepths::Kept> FrameDepths::of(const osg::State& state) {
    Lock lock(_mutex);
    std::shared_ptr<Kept>& kept = _kept[state.getContextID()];
    if (!kept) kept = std::make_shared<Kept>();
    return kept;
}

FrameDepths::Copy FrameDepths::copy(osg::State& state, const PixelRect& pixels) {
    const std::shared_ptr<Kept> kept = of(state);
    if (kept->held.empty() || !holds(kept->held, pixels)) {
        kept->held = united(pixels, kept->wanted);
        kept->copy = make(state, *kept, kept->held);
    }
    return kept->copy;
}

FrameDepths::Copy FrameDepths::make(osg::State& state, Kept& kept, const PixelRect& pixels) {
    Copy result;
    const GLint bits = glInteger(GL_DEPTH_BITS);
    if (bits == 0) return {noDepth};
    result.error.x = stepsOff * std::ldexp(1.0, -std::min(bits, 24));
    result.error.y = snapsOff * std::ldexp(1.0, -std::clamp(glInteger(GL_SUBPIXEL_BITS), 4, 16));
    const PlainPixels plain(state);
    const bool resolves = ResolvedDepth::isNeeded(state), packed = !resolves && isPacked();
    Target& target = packed ? kept.packed : kept.plain;
    target.packed = packed;
    fit(target, state, pixels);
    result.texture = target.texture;
    const auto read = [&] { result.rows = transfer(state, target, pixels); };
    if (resolves) {
        const auto place = kept.resolved.read(state, pixels, read);
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
glm::dvec2 FrameDepths::transfer(osg::State& state, Target& target, const PixelRect& pixels) {
    state.applyTextureAttribute(0, target.texture);
    if (target.mirrors && mirror(state, target, pixels)) return {target.texture->getTextureHeight() - 1, -1};
    glCopyTexSubImage2D(GL_TEXTURE_2D, 0, pixels.x, pixels.y, pixels.x, pixels.y, pixels.width, pixels.height);
    return {0.0, 1.0};
}

/// Rows of Mesa's windows go from the top, a texture's from the bottom: so mirrored, memory is copied and nothing drawn.
/// @return false if they do not, or pixels have several samples, or that is not possible: formats can differ though they have as many
///         bits.
bool FrameDepths::mirror(osg::State& state, Target& target, const PixelRect& pixels) {
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

void FrameDepths::fit(Target& target, const osg::State& state, const PixelRect& pixels) {
    const PixelRect all = pixelsOf(*state.getCurrentViewport());
    osg::ref_ptr<osg::Texture2D>& texture = target.texture;
    if (!texture) texture = depthTexture(target.packed);
    // As the viewport, not as the pixels: these grow with a shadow that moves, and each time another texture would be made.
    const int width = std::max({texture->getTextureWidth(), pixels.x + pixels.width, all.x + all.width});
    const int height = std::max({texture->getTextureHeight(), pixels.y + pixels.height, all.y + all.height});
    if (width == texture->getTextureWidth() && height == texture->getTextureHeight()) return;
    texture->setTextureSize(width, height);
    texture->dirtyTextureObject();
}

void FrameDepths::release(osg::State* state) {
    Lock lock(_mutex);
    if (state)
        _kept.erase(state->getContextID());
    else
        _kept.clear();
}

glm::dmat4 clipFromPixel(const osg::Viewport& viewport) {
    const PixelRect all = pixelsOf(viewport);
    const glm::dvec3 half(all.width / 2.0, all.height / 2.0, -0.5);
    const glm::dmat4 atCorner = glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, -1.0, 1.0));
    return glm::translate(glm::scale(atCorner, 1.0 / half), glm::dvec3(-all.x, -all.y, 0.0));
}

} // namespace gnomon
