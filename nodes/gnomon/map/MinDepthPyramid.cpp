// SPDX-License-Identifier: MIT
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/MinDepthPyramid.h>

namespace gnomon {
namespace {

constexpr int levels = 6;                               // blocks.frag and map_filter.frag know it, too
constexpr int finest = 8, coarsest = 8 << (levels - 1); // texels on a side of a block
constexpr GLint oneFloat = 0x822E;                      // GL_R32F
constexpr GLenum red = 0x1903;                          // GL_RED
constexpr const char* noTarget = "the penumbras are no wider than the filter, because this context cannot render into "
                                 "a float texture. Use OpenGL 3.3 or later.";

/// Of a side, for a multiple of the coarsest blocks.
int blocksOf(int texels) { return (texels + coarsest - 1) / coarsest * (coarsest / finest); }

osg::ref_ptr<osg::Texture2D> blocksTexture(const glm::ivec2& texels) {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(blocksOf(texels.x), blocksOf(texels.y));
    texture->setInternalFormat(oneFloat);
    texture->setSourceFormat(red);
    texture->setSourceType(GL_FLOAT);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setNumMipmapLevels(levels);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST_MIPMAP_NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
        texture->setWrap(wrap, osg::Texture::CLAMP_TO_EDGE);
    return texture;
}

/// OpenGL as values are drawn under; put back at its end.
class ValueState {
public:
    ValueState() {
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_COLOR_BUFFER_BIT);
        for (const GLenum mode :
             {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_ALPHA_TEST})
            glDisable(mode);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    ~ValueState() { glPopAttrib(); }
    ValueState(const ValueState&) = delete;
    ValueState& operator=(const ValueState&) = delete;
};

void readLevels(GLint first, GLint last) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, first);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, last);
}

} // namespace

MinDepthPyramid::MinDepthPyramid(const glm::ivec2& texels) : _texture(blocksTexture(texels)) {}

std::string MinDepthPyramid::update(osg::State& state, const osg::StateSet& program, const osg::Texture2D& map) {
    const auto& gl = *state.get<osg::GLExtensions>();
    const bool made = _texture->getTextureObject(state.getContextID());
    bind(state, 0);
    if (!made) gl.glGenerateMipmap(GL_TEXTURE_2D); // room for all levels
    const ValueState values;
    const ScratchFramebuffer framebuffer(gl);
    state.apply(&program);
    if (!hasProgram(state)) return noProgram;
    setUniform(state, "finer", 0);
    state.applyTextureAttribute(0, &map);
    bool drawn = false;
    {
        const UncomparedSampler raw(state, 0);
        drawn = drawLevel(state, 0);
    }
    bind(state, 0);
    for (int level = 1; drawn && level < levels; ++level) {
        readLevels(level - 1, level - 1);
        drawn = drawLevel(state, level);
    }
    readLevels(0, levels - 1);
    return drawn ? "" : noTarget;
}

/// From what is bound to unit 0.
bool MinDepthPyramid::drawLevel(osg::State& state, int level) const {
    const auto& gl = *state.get<osg::GLExtensions>();
    const GLuint name = _texture->getTextureObject(state.getContextID())->id();
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, name, level);
    if (gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT) return false;
    glViewport(0, 0, _texture->getTextureWidth() >> level, _texture->getTextureHeight() >> level);
    setUniform(state, "side", level == 0 ? finest : 2);
    drawQuad(state);
    return true;
}

} // namespace gnomon
