// SPDX-License-Identifier: MIT
#include <gnomon/FramebufferBindings.h>
#include <gnomon/SeenDepth.h>

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

constexpr double stepsOff = 4.0; // as depthShadow()
constexpr double snapsOff = 2.0;

} // namespace

SeenDepth::Copy SeenDepth::copy(osg::State& state, const PixelRect& pixels) {
    Copy result;
    const GLint bits = glInteger(GL_DEPTH_BITS);
    if (bits == 0) return {noDepth};
    result.error.x = stepsOff * std::ldexp(1.0, -std::min(bits, 24));
    result.error.y = snapsOff * std::ldexp(1.0, -std::clamp(glInteger(GL_SUBPIXEL_BITS), 4, 16));
    const PlainTransfer plain;
    const bool resolves = ResolvedDepth::isNeeded(state), packed = !resolves && isPacked();
    const auto read = [&] {
        state.applyTextureAttribute(0, &textureFor(state.getContextID(), pixels, packed));
        glCopyTexSubImage2D(GL_TEXTURE_2D, 0, pixels.x, pixels.y, pixels.x, pixels.y, pixels.width, pixels.height);
    };
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

void SeenDepth::bind(osg::State& state, unsigned unit) {
    Lock lock(_mutex);
    state.applyTextureAttribute(unit, _textures.at(state.getContextID()));
}

osg::Texture2D& SeenDepth::textureFor(unsigned context, const PixelRect& pixels, bool packed) {
    Lock lock(_mutex);
    osg::ref_ptr<osg::Texture2D>& texture = _textures[context];
    const GLint format = packed ? GL_DEPTH24_STENCIL8_EXT : GL_DEPTH_COMPONENT24;
    if (!texture || texture->getInternalFormat() != format) texture = depthTexture(packed);
    const int width = std::max(texture->getTextureWidth(), pixels.x + pixels.width);
    const int height = std::max(texture->getTextureHeight(), pixels.y + pixels.height);
    if (width != texture->getTextureWidth() || height != texture->getTextureHeight()) {
        texture->setTextureSize(width, height);
        texture->dirtyTextureObject();
    }
    return *texture;
}

void SeenDepth::release(osg::State* state) {
    _resolved.release(state);
    Lock lock(_mutex);
    for (auto entry = _textures.begin(); entry != _textures.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        if (meant) entry->second->releaseGLObjects(state);
        entry = meant ? _textures.erase(entry) : std::next(entry);
    }
}

} // namespace gnomon
