// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/DepthMap.h>

#include <OpenThreads/ScopedLock>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <iterator>

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
                const std::vector<MapLayer::Drawn>& meshes) {
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

/// OpenGL as a map is drawn under, each surface half a texel of its own slope deeper; put back at its end. As much of the
/// slope that is seen counts in map.frag.
class MapState {
public:
    MapState() {
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_POLYGON_BIT | GL_SCISSOR_BIT |
                     GL_STENCIL_BUFFER_BIT);
        for (const GLenum mode : {GL_STENCIL_TEST, GL_CULL_FACE}) glDisable(mode);
        for (GLenum plane = GL_CLIP_PLANE0; plane <= GL_CLIP_PLANE5; ++plane) glDisable(plane);
        for (const GLenum mode :
             {GLenum(GL_SCISSOR_TEST), GLenum(GL_DEPTH_TEST), depthClamp, GLenum(GL_POLYGON_OFFSET_FILL)})
            glEnable(mode);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glClearDepth(1.0);
        glPolygonOffset(0.5f, 0.0f);
    }
    ~MapState() { glPopAttrib(); }
    MapState(const MapState&) = delete;
    MapState& operator=(const MapState&) = delete;
};

/// While a caster's own state is applied. OpenGL and osg::State are as before at its end.
class OwnState {
public:
    OwnState(osg::State& state, const OwnCasters& own, const OwnDrawing& drawing)
        : _state(state),
          _size(static_cast<unsigned>(state.getStateSetStackSize())),
          _projection(new osg::RefMatrix(state.getProjectionMatrix())),
          _modelview(new osg::RefMatrix(state.getModelViewMatrix())) {
        _state.apply(); // so that osg::State knows now what it will be told at the end
        _unit = _state.getActiveTextureUnit();
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        for (const auto& set : own.view.states) _state.pushStateSet(set);
        for (const auto& set : drawing.states) _state.pushStateSet(set);
        _state.apply();
        _state.setActiveTextureUnit(0); // evaluators know no other
    }
    ~OwnState() {
        _state.popStateSetStackToSize(_size);
        _state.apply();
        _state.setActiveTextureUnit(_unit);
        glPopAttrib();
        _state.applyProjectionMatrix(_projection);
        _state.applyModelViewMatrix(_modelview);
    }
    OwnState(const OwnState&) = delete;
    OwnState& operator=(const OwnState&) = delete;

private:
    osg::State& _state;
    const unsigned _size;
    unsigned _unit = 0;
    const osg::ref_ptr<osg::RefMatrix> _projection, _modelview;
};

osg::ref_ptr<osg::RefMatrix> refMatrix(const glm::dmat4& matrix) { return new osg::RefMatrix(toOsg(matrix)); }

/// Nothing that a lamp has nearer than this casts. The plane is one that does not cut the caster already, if there is one.
void clipOwn(osg::State& state, const OwnCaster& caster, const glm::dmat4& clipFromEye, double nearest) {
    if (!(nearest > 0.0)) return;
    const auto isUsed = [&caster](GLenum plane) {
        const auto& clips = caster.drawing->casting.clips;
        return std::any_of(clips.begin(), clips.end(),
                           [plane](const NumberedPlane& used) { return GL_CLIP_PLANE0 + used.first == plane; });
    };
    GLenum free = GL_CLIP_PLANE0;
    while (isUsed(free) && free < GL_CLIP_PLANE5) ++free;
    const glm::dvec4 distance = glm::row(clipFromEye, 3), plane = distance - glm::dvec4(0.0, 0.0, 0.0, nearest);
    state.applyModelViewMatrix(nullptr);
    glClipPlane(free, &plane[0]);
    glEnable(free);
}

/// By its own code, at what that costs in the view. The modelview is the view's, so that what goes by the eye, as
/// tessellation may, looks as it does there.
void drawOwn(osg::RenderInfo& renderInfo, const MapPicture& picture, const OwnCaster& caster,
             const MapPicture::Tile& tile, const PixelRect& texels) {
    osg::State& state = *renderInfo.getState();
    const glm::dmat4 clipFromEye = tile.clipFromScene * glm::inverse(picture.own.view.eyeFromScene);
    glViewport(tile.corner.x, tile.corner.y, picture.size, picture.size);
    glScissor(texels.x, texels.y, texels.width, texels.height);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity(); // else Mesa keeps a part of a perspective's inverse, and cuts elsewhere
    state.applyProjectionMatrix(refMatrix(clipFromEye));
    if (!state.getLastAppliedProgramObject()) clipOwn(state, caster, clipFromEye, tile.nearest);
    state.applyModelViewMatrix(refMatrix(picture.own.view.eyeFromScene * caster.sceneFromLocal));
    for (const auto& [number, plane] : caster.drawing->casting.clips) {
        const osg::Vec4d inLocal = caster.drawing->groupFromLocal * plane;
        glClipPlane(GL_CLIP_PLANE0 + number, inLocal.ptr());
        glEnable(GL_CLIP_PLANE0 + number);
    }
    if (state.getUseModelViewAndProjectionUniforms()) state.applyModelViewAndProjectionUniformsIfRequired();
    caster.drawing->drawable->draw(renderInfo);
}

using Parts = std::vector<MapPicture::Part>;

std::string drawLayer(osg::RenderInfo& renderInfo, const MapPicture& picture, const MapPicture::Layer& layer,
                      const Parts& parts) {
    if (parts.empty()) return "";
    osg::State& state = *renderInfo.getState();
    if (!layer.meshes.empty()) {
        state.apply(picture.program.get());
        if (!hasProgram(state)) return noProgram;
        for (const auto& [tile, texels] : parts) {
            drawInto(state, *tile, picture.size, texels);
            drawMeshes(renderInfo, tile->clipFromScene, layer.meshes);
        }
    }
    if (layer.cutouts.empty()) return "";
    state.apply(picture.cutoutProgram.get());
    if (!hasProgram(state)) return noProgram;
    setUniform(state, "cutout", 0);
    for (const MapLayer::Cutout& cutout : layer.cutouts) {
        state.applyTextureAttribute(0, cutout.texture);
        setUniform(state, "alphaTest", glm::dvec2(cutout.passing, cutout.reference));
        for (const auto& [tile, texels] : parts) {
            drawInto(state, *tile, picture.size, texels);
            cutout.geometry->draw(renderInfo);
        }
    }
    return "";
}

/// @param all  of the texture is to be cleared, parts that no tile is in, too.
std::string drawStill(osg::RenderInfo& renderInfo, const MapPicture& picture, const Parts& parts, bool all) {
    if (all) {
        glDisable(GL_SCISSOR_TEST);
        glClear(GL_DEPTH_BUFFER_BIT);
        glEnable(GL_SCISSOR_TEST);
    }
    for (const auto& [tile, texels] : all ? Parts() : parts) {
        glScissor(texels.x, texels.y, texels.width, texels.height);
        glClear(GL_DEPTH_BUFFER_BIT);
    }
    return drawLayer(renderInfo, picture, picture.still, parts);
}

std::string drawMovers(osg::RenderInfo& renderInfo, const MapPicture& picture, const Parts& parts) {
    const std::string cause = drawLayer(renderInfo, picture, picture.moving, parts);
    if (!cause.empty()) return cause;
    for (const OwnCaster& caster : picture.own.casters) {
        const auto isIn = [&](const MapPicture::Part& part) { return isInMap(caster.box, part.tile->clipFromScene); };
        if (std::none_of(parts.begin(), parts.end(), isIn)) continue;
        const OwnState own(*renderInfo.getState(), picture.own, *caster.drawing);
        const MapState map;
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        if (const float alpha = caster.drawing->casting.ownFrom; alpha > 0.0f) {
            glEnable(GL_ALPHA_TEST);
            glAlphaFunc(GL_GEQUAL, alpha);
        }
        for (const MapPicture::Part& part : parts)
            if (isIn(part)) drawOwn(renderInfo, picture, caster, *part.tile, part.texels);
    }
    return "";
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
    if (!(still == other.still && size == other.size)) return nullptr;
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
    const MapState mapState;
    const bool sameMoving = target.shown && target.shown->hasSameMoving(picture);
    Parts still, moving;
    std::vector<PixelRect> hidden; // by what moved
    unsigned due = 0;
    for (const MapPicture::Tile& tile : picture.tiles) {
        const MapPicture::Tile* shown =
            target.shown && gl.glBlitFramebuffer ? target.shown->findStill(tile, picture) : nullptr;
        if (shown && (sameMoving || (shown->movers.empty() && tile.movers.empty()))) continue;
        ++due;
        if (!shown) still.push_back({&tile, wholeOf(tile, picture.size)});
        if (shown && !shown->movers.empty()) hidden.push_back(shown->movers);
        if (!tile.movers.empty()) moving.push_back({&tile, tile.movers});
    }
    std::string cause = drawStill(renderInfo, picture, still, !target.shown);
    if (cause.empty()) cause = drawMoving(renderInfo, framebuffer, picture, hidden, moving);
    if (cause.empty()) drawn += due;
    target.shown = cause.empty() ? &picture : nullptr;
    if (due > 0) target.inBlocks = false;
    return cause;
}

std::string DepthMap::drawMoving(osg::RenderInfo& renderInfo, const ScratchFramebuffer& framebuffer,
                                 const MapPicture& picture, const std::vector<PixelRect>& hidden,
                                 const std::vector<MapPicture::Part>& parts) {
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
    for (const auto& part : parts) toHide.push_back(part.texels);
    copyDepths(gl, framebuffer.name, saved.name, toHide);
    framebuffer.bind();
    return drawMovers(renderInfo, picture, parts);
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
