// SPDX-License-Identifier: MIT
#include <gnomon/DepthMap.h>
#include <gnomon/FramebufferBindings.h>
#include <gnomon/MarkProgram.h>
#include <gnomon/RawSampler.h>
#include <gnomon/ScreenPass.h>

#include <OpenThreads/ScopedLock>
#include <osg/ContextData>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

osg::ref_ptr<osg::Texture2D> mapTexture(const glm::ivec2& size, osg::Texture::FilterMode filter) {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(size.x, size.y);
    texture->setInternalFormat(GL_DEPTH_COMPONENT24);
    texture->setSourceFormat(GL_DEPTH_COMPONENT);
    texture->setSourceType(GL_UNSIGNED_INT);
    texture->setResizeNonPowerOfTwoHint(false);
    texture->setShadowComparison(true);
    texture->setShadowCompareFunc(osg::Texture::LEQUAL);
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER}) texture->setFilter(which, filter);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
        texture->setWrap(wrap, osg::Texture::CLAMP_TO_EDGE);
    return texture;
}

constexpr const char* noSamplers =
    "draws penumbras no wider than its filter in this context: wider ones need OpenGL 3.3, or its sampler objects.";

/// OpenGL as a map is drawn under; put back at its end.
class MapState {
public:
    explicit MapState(double slopeOffset) {
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_POLYGON_BIT | GL_SCISSOR_BIT |
                     GL_STENCIL_BUFFER_BIT);
        for (const GLenum mode : {GL_STENCIL_TEST, GL_CULL_FACE}) glDisable(mode);
        for (const GLenum mode :
             {GLenum(GL_SCISSOR_TEST), GLenum(GL_DEPTH_TEST), depthClamp, GLenum(GL_POLYGON_OFFSET_FILL)})
            glEnable(mode);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glClearDepth(1.0);
        glPolygonOffset(static_cast<GLfloat>(slopeOffset), 0.0f);
    }
    ~MapState() { glPopAttrib(); }
    MapState(const MapState&) = delete;
    MapState& operator=(const MapState&) = delete;
};

/// Parts that no tile is in, too.
void clearAll() {
    glDisable(GL_SCISSOR_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
}

/// What is drawn next goes there.
void drawInto(const osg::State& state, const MapPicture::Tile& tile, int size) {
    glViewport(tile.corner.x, tile.corner.y, size, size);
    glScissor(tile.corner.x, tile.corner.y, size, size);
    setUniform(state, "clipFromCaster", tile.clipFromCaster);
}

} // namespace

bool MapPicture::shows(const Tile& tile, const MapPicture& other) const {
    const auto same = [&tile](const Tile& own) {
        return own.corner == tile.corner && own.clipFromCaster == tile.clipFromCaster;
    };
    const auto alike = [](const auto& a, const auto& b) { return a.geometry == b.geometry; };
    return casters == other.casters && outside == other.outside &&
           std::equal(cutouts.begin(), cutouts.end(), other.cutouts.begin(), other.cutouts.end(), alike) &&
           size == other.size && slopeOffset == other.slopeOffset && std::any_of(tiles.begin(), tiles.end(), same);
}

DepthMap::DepthMap(const glm::ivec2& texels, osg::Texture::FilterMode filter)
    : size(texels), _texture(mapTexture(texels, filter)) {}

DepthMap::~DepthMap() { release(nullptr); }

std::string DepthMap::show(osg::RenderInfo& renderInfo, const MapPicture& picture, unsigned& drawn) {
    osg::State& state = *renderInfo.getState();
    const GLint most = glInteger(GL_MAX_TEXTURE_SIZE);
    if (std::max(size.x, size.y) > most)
        return "cannot make a map of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
               " texels, for this OpenGL's textures end at " + std::to_string(most) + ": set a smaller size.";
    Target& target = targetOf(state.getContextID());
    const auto* texture = _texture->getTextureObject(state.getContextID());
    if (texture && target.shown == &picture && target.texture == texture) return "";
    if (target.texture != texture) target.shown = nullptr;
    const std::string cause = draw(renderInfo, target, picture, drawn);
    state.apply(); // ResolvedDepth draws by what it finds, and finds a program otherwise
    return cause;
}

std::string DepthMap::updateBlocks(osg::State& state, const osg::StateSet& program) {
    if (!RawSampler::isSupported(state)) return noSamplers;
    Target& target = targetOf(state.getContextID());
    if (target.inBlocks) return "";
    {
        Lock lock(_mutex);
        if (!_blocks) _blocks = new BlockDepths(size);
    }
    const std::string cause = _blocks->update(state, program, *_texture);
    if (cause.empty()) target.inBlocks = target.shown;
    return cause;
}

void DepthMap::bind(osg::State& state, unsigned unit) const { state.applyTextureAttribute(unit, _texture); }

/// @return false if OpenGL cannot draw to it.
bool DepthMap::bindTarget(osg::State& state, Target& target) const {
    bind(state, 0); // which makes it
    const auto& gl = *state.get<osg::GLExtensions>();
    if (!target.framebuffer) gl.glGenFramebuffers(1, &target.framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, target.framebuffer);
    target.texture = _texture->getTextureObject(state.getContextID());
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_TEXTURE_2D, target.texture->id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    return gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) == GL_FRAMEBUFFER_COMPLETE_EXT;
}

std::string DepthMap::draw(osg::RenderInfo& renderInfo, Target& target, const MapPicture& picture,
                           unsigned& drawn) const {
    constexpr const char* noTarget =
        "cannot draw into a texture in this context: it needs OpenGL's framebuffer objects.";
    osg::State& state = *renderInfo.getState();
    const auto& gl = *state.get<osg::GLExtensions>();
    if (!gl.isFrameBufferObjectSupported) return noTarget;
    state.apply(picture.program.get());
    if (!hasProgram(state)) return noProgram;
    const FramebufferBindings bound(gl);
    if (!bindTarget(state, target)) return noTarget;
    const MapState mapState(picture.slopeOffset);
    std::vector<MapPicture::Tile> due;
    for (const MapPicture::Tile& tile : picture.tiles)
        if (!target.shown || !target.shown->shows(tile, picture)) due.push_back(tile);
    drawn += static_cast<unsigned>(due.size());
    if (!target.shown) clearAll();
    for (const MapPicture::Tile& tile : due) {
        drawInto(state, tile, picture.size);
        if (target.shown) glClear(GL_DEPTH_BUFFER_BIT);
        if (picture.casters) picture.casters->draw(renderInfo, tile.clipFromCaster, picture.outside);
    }
    const std::string cause = drawCutouts(renderInfo, picture, due);
    target.shown = cause.empty() ? &picture : nullptr;
    target.inBlocks = nullptr;
    return cause;
}

std::string DepthMap::drawCutouts(osg::RenderInfo& renderInfo, const MapPicture& picture,
                                  const std::vector<MapPicture::Tile>& tiles) const {
    if (picture.cutouts.empty()) return "";
    osg::State& state = *renderInfo.getState();
    state.apply(picture.cutoutProgram.get());
    if (!hasProgram(state)) return noProgram;
    setUniform(state, "cutout", 0);
    for (const MapCasters::Cutout& cutout : picture.cutouts) {
        state.applyTextureAttribute(0, cutout.texture);
        setUniform(state, "alphaTest", glm::dvec2(cutout.passing, cutout.reference));
        for (const MapPicture::Tile& tile : tiles) {
            drawInto(state, tile, picture.size);
            cutout.geometry->draw(renderInfo);
        }
    }
    return "";
}

DepthMap::Target& DepthMap::targetOf(unsigned context) {
    Lock lock(_mutex);
    return _targets[context];
}

void DepthMap::resizeGLObjectBuffers(unsigned maxSize) {
    _texture->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    if (_blocks) _blocks->resizeGLObjectBuffers(maxSize);
}

void DepthMap::release(osg::State* state) {
    _texture->releaseGLObjects(state);
    Lock lock(_mutex);
    if (_blocks) _blocks->release(state);
    for (auto entry = _targets.begin(); entry != _targets.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        if (meant && entry->second.framebuffer)
            osg::get<osg::GLFrameBufferObjectManager>(entry->first)
                ->scheduleGLObjectForDeletion(entry->second.framebuffer);
        entry = meant ? _targets.erase(entry) : std::next(entry);
    }
}

} // namespace gnomon
