// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/DepthMap.h>

#include <OpenThreads/ScopedLock>

#include <algorithm>

namespace gnomon {
namespace {

constexpr int levels = 6;                               // blocks.frag and map_filter.frag know it, too
constexpr int finest = 8, coarsest = 8 << (levels - 1); // texels on a side of a block
constexpr GLint oneFloat = 0x822E;                      // GL_R32F
constexpr GLenum red = 0x1903;                          // GL_RED
constexpr const char* noFloats = "the penumbras are no wider than the filter, because this context cannot render into "
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
    "the penumbras are no wider than the filter, because this context has no sampler objects. Use OpenGL 3.3 or later.";

/// Parts that no tile is in, too.
void clearAll() {
    glDisable(GL_SCISSOR_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
}

PixelRect wholeOf(const MapPicture::Tile& tile, int size) { return {tile.corner.x, tile.corner.y, size, size}; }

/// What is drawn next goes there.
void drawInto(const osg::State& state, const MapPicture::Tile& tile, int size, const PixelRect& texels) {
    glViewport(tile.corner.x, tile.corner.y, size, size);
    glScissor(texels.x, texels.y, texels.width, texels.height);
    setUniform(state, "clipFromVertex", tile.clipFromScene);
    setUniform(state, "nearest", tile.nearest);
    (tile.nearest > 0.0 ? glEnable : glDisable)(GL_CLIP_PLANE0);
}

void drawMeshes(osg::RenderInfo& renderInfo, const glm::dmat4& clipFromScene,
                const std::vector<MapPicture::Layer::Mesh>& meshes) {
    for (const auto& mesh : meshes) {
        if (!isInMap(mesh.box, clipFromScene)) continue;
        const glm::dmat4 clipFromMesh = clipFromScene * mesh.sceneFromMesh;
        setUniform(*renderInfo.getState(), "clipFromVertex", clipFromMesh);
        mesh.faces->draw(renderInfo, clipFromMesh, mesh.outside);
    }
}

/// Depths, to the bit, between framebuffers of one size.
void copyDepths(const osg::GLExtensions& gl, GLuint from, GLuint to, const std::vector<PixelRect>& parts) {
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, from);
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, to);
    glDisable(GL_SCISSOR_TEST);
    for (const PixelRect& part : parts) {
        const GLint endX = part.x + part.width, endY = part.y + part.height;
        gl.glBlitFramebuffer(part.x, part.y, endX, endY, part.x, part.y, endX, endY, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    }
    glEnable(GL_SCISSOR_TEST);
}

constexpr const char* noTarget = "this context cannot render into a depth texture, so there is no map. Use OpenGL 3.0 "
                                 "or later, with framebuffer objects.";

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
    return drawn ? "" : noFloats;
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

bool MapPicture::Layer::operator==(const Layer& other) const {
    const auto alike = [](const auto& a, const auto& b) { return a.geometry == b.geometry; };
    return meshes == other.meshes &&
           std::equal(cutouts.begin(), cutouts.end(), other.cutouts.begin(), other.cutouts.end(), alike);
}

const MapPicture::Tile* MapPicture::findStill(const Tile& tile, const MapPicture& other) const {
    if (!(still == other.still && size == other.size && slopeOffset == other.slopeOffset)) return nullptr;
    const auto found = std::find_if(tiles.begin(), tiles.end(), [&tile](const Tile& each) {
        return each.corner == tile.corner && each.clipFromScene == tile.clipFromScene;
    });
    return found == tiles.end() ? nullptr : &*found;
}

DepthMap::DepthMap(const glm::ivec2& texels, osg::Texture::FilterMode filter)
    : size(texels), _texture(mapTexture(texels, filter)) {}

DepthMap::~DepthMap() { release(nullptr); }

std::string DepthMap::show(osg::RenderInfo& renderInfo, const MapPicture& picture, unsigned& drawn) {
    osg::State& state = *renderInfo.getState();
    const GLint most = glInteger(GL_MAX_TEXTURE_SIZE);
    if (std::max(size.x, size.y) > most)
        return "a map of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
               " texels cannot be made, because this OpenGL allows at most " + std::to_string(most) +
               " on a side. Set a smaller size.";
    Target& target = targetOf(state.getContextID());
    const auto* texture = _texture->getTextureObject(state.getContextID());
    if (texture && target.shown == &picture && target.texture == texture) return "";
    if (target.texture != texture) target.shown = nullptr;
    const std::string cause = draw(renderInfo, target, picture, drawn);
    state.apply(); // ResolvedDepth draws by what it finds, and finds a program otherwise
    return cause;
}

std::string DepthMap::updateBlocks(osg::State& state, const osg::StateSet& program) {
    if (!UncomparedSampler::isSupported(state)) return noSamplers;
    Target& target = targetOf(state.getContextID());
    if (target.inBlocks) return "";
    {
        Lock lock(_mutex);
        if (!_blocks) _blocks = new MinDepthPyramid(size);
    }
    const std::string cause = _blocks->update(state, program, *_texture);
    target.inBlocks = cause.empty();
    return cause;
}

void DepthMap::bind(osg::State& state, unsigned unit) const { state.applyTextureAttribute(unit, _texture); }

/// @return false if OpenGL cannot draw to it.
bool DepthMap::attach(osg::State& state, Target& target, const ScratchFramebuffer& framebuffer) const {
    bind(state, 0); // which makes it
    target.texture = _texture->getTextureObject(state.getContextID());
    framebuffer.attachDepth(*target.texture);
    return framebuffer.isComplete();
}

std::string DepthMap::draw(osg::RenderInfo& renderInfo, Target& target, const MapPicture& picture, unsigned& drawn) {
    osg::State& state = *renderInfo.getState();
    const auto& gl = *state.get<osg::GLExtensions>();
    if (!gl.isFrameBufferObjectSupported) return noTarget;
    const ScratchFramebuffer framebuffer(gl);
    if (!attach(state, target, framebuffer)) return noTarget;
    const MapState mapState(picture.slopeOffset);
    const bool sameMoving = target.shown && target.shown->hasSameMoving(picture);
    std::vector<Due> due;
    for (const MapPicture::Tile& tile : picture.tiles) {
        const MapPicture::Tile* shown =
            target.shown && gl.glBlitFramebuffer ? target.shown->findStill(tile, picture) : nullptr;
        const bool same = shown && (sameMoving || (shown->movers.empty() && tile.movers.empty()));
        if (!same) due.push_back({&tile, shown});
    }
    std::string cause = drawStill(renderInfo, target, picture, due);
    if (cause.empty()) cause = drawMoving(renderInfo, framebuffer, picture, due);
    if (cause.empty()) drawn += static_cast<unsigned>(due.size());
    target.shown = cause.empty() ? &picture : nullptr;
    if (!due.empty()) target.inBlocks = false;
    return cause;
}

std::string DepthMap::drawStill(osg::RenderInfo& renderInfo, const Target& target, const MapPicture& picture,
                                const std::vector<Due>& due) const {
    std::vector<Part> parts;
    for (const Due& each : due)
        if (!each.shown) parts.push_back({each.tile, wholeOf(*each.tile, picture.size)});
    if (target.shown)
        for (const Part& part : parts) {
            glScissor(part.texels.x, part.texels.y, part.texels.width, part.texels.height);
            glClear(GL_DEPTH_BUFFER_BIT);
        }
    else
        clearAll();
    return drawLayer(renderInfo, picture, picture.still, parts);
}

std::string DepthMap::drawMoving(osg::RenderInfo& renderInfo, const ScratchFramebuffer& framebuffer,
                                 const MapPicture& picture, const std::vector<Due>& due) {
    std::vector<PixelRect> hidden;
    std::vector<Part> parts;
    for (const Due& each : due) {
        if (each.shown && !each.shown->movers.empty()) hidden.push_back(each.shown->movers);
        if (!each.tile->movers.empty()) parts.push_back({each.tile, each.tile->movers});
    }
    if (hidden.empty() && parts.empty()) return "";
    osg::State& state = *renderInfo.getState();
    const auto& gl = *state.get<osg::GLExtensions>();
    if (!gl.glBlitFramebuffer) return drawMovers(renderInfo, picture, parts); // all is drawn each time
    const osg::ref_ptr<osg::Texture2D> texture = savedTexture();
    state.applyTextureAttribute(0, texture); // which makes it
    const ScratchFramebuffer saved(gl);
    saved.attachDepth(*texture->getTextureObject(state.getContextID()));
    if (!saved.isComplete()) return noTarget;
    copyDepths(gl, saved.name, framebuffer.name, hidden);
    std::vector<PixelRect> toHide;
    for (const Part& part : parts) toHide.push_back(part.texels);
    copyDepths(gl, framebuffer.name, saved.name, toHide);
    framebuffer.bind();
    return drawMovers(renderInfo, picture, parts);
}

std::string DepthMap::drawMovers(osg::RenderInfo& renderInfo, const MapPicture& picture,
                                 const std::vector<Part>& parts) const {
    const std::string cause = drawLayer(renderInfo, picture, picture.moving, parts);
    if (!cause.empty() || picture.own.casters.empty()) return cause;
    std::vector<OwnCasterPass::Target> targets;
    for (const auto& [tile, texels] : parts)
        targets.push_back({tile->corner, picture.size, texels, tile->clipFromScene, tile->nearest});
    OwnCasterPass(renderInfo, picture.own, picture.slopeOffset).draw(targets);
    return "";
}

std::string DepthMap::drawLayer(osg::RenderInfo& renderInfo, const MapPicture& picture, const MapPicture::Layer& layer,
                                const std::vector<Part>& parts) const {
    if (parts.empty()) return "";
    osg::State& state = *renderInfo.getState();
    if (!layer.meshes.empty()) {
        state.apply(picture.program.get());
        if (!hasProgram(state)) return noProgram;
        for (const Part& part : parts) {
            drawInto(state, *part.tile, picture.size, part.texels);
            drawMeshes(renderInfo, part.tile->clipFromScene, layer.meshes);
        }
    }
    if (layer.cutouts.empty()) return "";
    state.apply(picture.cutoutProgram.get());
    if (!hasProgram(state)) return noProgram;
    setUniform(state, "cutout", 0);
    for (const MapLayer::Cutout& cutout : layer.cutouts) {
        state.applyTextureAttribute(0, cutout.texture);
        setUniform(state, "alphaTest", glm::dvec2(cutout.passing, cutout.reference));
        for (const Part& part : parts) {
            drawInto(state, *part.tile, picture.size, part.texels);
            cutout.geometry->draw(renderInfo);
        }
    }
    return "";
}

osg::ref_ptr<osg::Texture2D> DepthMap::savedTexture() {
    Lock lock(_mutex);
    if (!_saved) _saved = mapTexture(size, osg::Texture::NEAREST);
    return _saved;
}

DepthMap::Target& DepthMap::targetOf(unsigned context) {
    Lock lock(_mutex);
    return _targets[context];
}

void DepthMap::resizeGLObjectBuffers(unsigned maxSize) {
    _texture->resizeGLObjectBuffers(maxSize);
    Lock lock(_mutex);
    if (_saved) _saved->resizeGLObjectBuffers(maxSize);
    if (_blocks) _blocks->resizeGLObjectBuffers(maxSize);
}

void DepthMap::release(osg::State* state) {
    _texture->releaseGLObjects(state);
    Lock lock(_mutex);
    if (_saved) _saved->releaseGLObjects(state);
    if (_blocks) _blocks->release(state);
    for (auto entry = _targets.begin(); entry != _targets.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        entry = meant ? _targets.erase(entry) : std::next(entry);
    }
}

} // namespace gnomon
