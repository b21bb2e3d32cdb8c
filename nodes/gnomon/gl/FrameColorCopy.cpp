// SPDX-License-Identifier: MIT
#include <gnomon/gl/FrameColorCopy.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <OpenThreads/ScopedLock>
#include <osg/TexEnv>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

osg::ref_ptr<osg::Texture2D> makeTexture() {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setInternalFormat(glInteger(GL_RED_BITS) > 8 ? GL_RGBA32F_ARB : GL_RGBA8);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

} // namespace

bool FrameColorCopy::save(osg::State& state, const osg::Viewport& viewport) {
    const bool isObject = glInteger(GL_FRAMEBUFFER_BINDING_EXT) != 0;
    if (isObject && glInteger(GL_SAMPLE_BUFFERS) > 0) return false;
    state.setActiveTextureUnit(0);
    osg::Texture2D& texture = of(state.getContextID());
    const PixelRect all = pixelsOf(viewport);
    GLint box[4];
    glGetIntegerv(GL_SCISSOR_BOX, box);
    if (texture.getTextureWidth() == all.width && texture.getTextureHeight() == all.height)
        texture.copyTexSubImage2D(state, box[0] - all.x, box[1] - all.y, box[0], box[1], box[2], box[3]);
    else
        texture.copyTexImage2D(state, all.x, all.y, all.width, all.height);
    return true;
}

void FrameColorCopy::draw(osg::State& state) {
    const osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setTextureAttributeAndModes(0, &of(state.getContextID()));
    set->setTextureAttribute(0, new osg::TexEnv(osg::TexEnv::REPLACE));
    state.apply(set);
    drawTexturedQuad(state, {0.0, 0.0}, {1.0, 1.0});
    state.apply();
}

osg::Texture2D& FrameColorCopy::of(unsigned context) {
    Lock lock(_mutex);
    osg::ref_ptr<osg::Texture2D>& texture = _textures[context];
    if (!texture) texture = makeTexture();
    return *texture;
}

void FrameColorCopy::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    for (const auto& entry : _textures) entry.second->resizeGLObjectBuffers(maxSize);
}

void FrameColorCopy::release(osg::State* state) {
    Lock lock(_mutex);
    for (auto entry = _textures.begin(); entry != _textures.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        if (meant) entry->second->releaseGLObjects(state);
        entry = meant ? _textures.erase(entry) : std::next(entry);
    }
}

} // namespace gnomon
