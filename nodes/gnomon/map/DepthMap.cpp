// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/base/ProgramText.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/gl/UncomparedSampler.h>
#include <gnomon/map/DepthMap.h>

#include <OpenThreads/ScopedLock>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <map>
#include <optional>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;
using Windows = std::vector<MapPicture::Window>;

constexpr int levels = 6;                               // blocks.frag and map_soft.frag know it, too
constexpr int finest = 8, coarsest = 8 << (levels - 1); // texels on a side of a block
constexpr GLint oneFloat = 0x822E;                      // GL_R32F
constexpr GLenum red = 0x1903;                          // GL_RED
constexpr const char* noTarget = "this context cannot render into a depth texture, so there is no map. Use OpenGL 3.0 "
                                 "or later, with framebuffer objects.";
constexpr const char* noBlocks = "the penumbras are no wider than the filter, because this context has no sampler "
                                 "objects, or cannot render into a float texture. Use OpenGL 3.3 or later.";

osg::ref_ptr<osg::Texture2D> textureOf(const glm::ivec2& size, GLint format, GLenum source, GLenum type) {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(size.x, size.y);
    texture->setInternalFormat(format);
    texture->setSourceFormat(source);
    texture->setSourceType(type);
    texture->setResizeNonPowerOfTwoHint(false);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
        texture->setWrap(wrap, osg::Texture::CLAMP_TO_EDGE);
    return texture;
}

osg::ref_ptr<osg::Texture2D> mapTexture(const glm::ivec2& size, osg::Texture::FilterMode filter) {
    const auto texture = textureOf(size, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
    texture->setShadowComparison(true);
    texture->setShadowCompareFunc(osg::Texture::LEQUAL);
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER}) texture->setFilter(which, filter);
    return texture;
}

/// Of whole ones of the coarsest.
osg::ref_ptr<osg::Texture2D> blocksTexture(const glm::ivec2& texels) {
    const auto texture = textureOf((texels + coarsest - 1) / coarsest * (coarsest / finest), oneFloat, red, GL_FLOAT);
    texture->setNumMipmapLevels(levels);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST_MIPMAP_NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return texture;
}

void readLevels(GLint first, GLint last) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, first);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, last);
}

/// OpenGL with these off; put back at its end.
class SavedState {
public:
    SavedState(GLbitfield kept, std::initializer_list<GLenum> off) {
        glPushAttrib(kept);
        for (const GLenum mode : off) glDisable(mode);
    }
    ~SavedState() { glPopAttrib(); }
    SavedState(const SavedState&) = delete;
    SavedState& operator=(const SavedState&) = delete;
};

/// OpenGL as a map is drawn under, each surface half a texel of its own slope deeper. As much of the slope that is seen
/// counts in map.frag.
struct MapState : SavedState {
    MapState()
        : SavedState(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_POLYGON_BIT | GL_SCISSOR_BIT |
                         GL_STENCIL_BUFFER_BIT,
                     {GL_STENCIL_TEST, GL_CULL_FACE, GL_CLIP_PLANE0, GL_CLIP_PLANE1, GL_CLIP_PLANE2, GL_CLIP_PLANE3,
                      GL_CLIP_PLANE4, GL_CLIP_PLANE5}) {
        for (const GLenum mode :
             {GLenum(GL_SCISSOR_TEST), GLenum(GL_DEPTH_TEST), depthClamp, GLenum(GL_POLYGON_OFFSET_FILL)})
            glEnable(mode);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glClearDepth(1.0);
        glPolygonOffset(0.5f, 0.0f);
    }
};

void scissorTo(const PixelRect& texels) { glScissor(texels.x, texels.y, texels.width, texels.height); }

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

/// Where the light of a map is, homogeneous, in the frame that its clip space is seen from; of a sun with length 1.
glm::dvec4 lightOf(const glm::dmat4& clipFromFrame) {
    const glm::dvec4 eye = eyeIn(clipFromFrame);
    return eye.w != 0.0 ? eye / eye.w : glm::dvec4(glm::normalize(glm::dvec3(eye)), 0.0);
}

/// While a caster's own state is applied. OpenGL and osg::State are as before at its end.
class SelfDrawnState {
public:
    SelfDrawnState(osg::State& state, const SelfDrawnCasters& all, const SelfDrawing& drawing)
        : _state(state),
          _size(static_cast<unsigned>(state.getStateSetStackSize())),
          _projection(new osg::RefMatrix(state.getProjectionMatrix())),
          _modelview(new osg::RefMatrix(state.getModelViewMatrix())) {
        _state.apply(); // so that osg::State knows now what it will be told at the end
        _unit = _state.getActiveTextureUnit();
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        for (const auto& set : all.states) _state.pushStateSet(set);
        for (const auto& set : drawing.states) _state.pushStateSet(set);
        _state.apply();
        _state.setActiveTextureUnit(0); // evaluators know no other
    }
    ~SelfDrawnState() {
        _state.popStateSetStackToSize(_size);
        _state.apply();
        _state.setActiveTextureUnit(_unit);
        glPopAttrib();
        _state.applyProjectionMatrix(_projection);
        _state.applyModelViewMatrix(_modelview);
    }
    SelfDrawnState(const SelfDrawnState&) = delete;
    SelfDrawnState& operator=(const SelfDrawnState&) = delete;

private:
    osg::State& _state;
    const unsigned _size;
    unsigned _unit = 0;
    const osg::ref_ptr<osg::RefMatrix> _projection, _modelview;
};

/// While the program that is applied has the light's matrices in the uniforms that the group names. They have their values
/// again at its end, which osg::State believes them to have.
class NamedMatrices {
public:
    NamedMatrices(osg::State& state, const SelfDrawnCasters& all, const glm::dmat4& clipFromEye,
                  const glm::dmat4& eyeFromLocal)
        : _gl(*state.get<osg::GLExtensions>()) {
        const auto* program = state.getLastAppliedProgramObject();
        if (!program) return;
        for (const MatrixUniform& uniform : all.matrices) {
            const auto active = program->getActiveUniforms().find(osg::Uniform::getNameID(uniform.name));
            if (active == program->getActiveUniforms().end() || active->second._type != GL_FLOAT_MAT4) continue;
            const glm::dmat4 eyeFromIts = uniform.kind == MatrixUniform::PROJECTION        ? glm::dmat4(1.0)
                                          : uniform.kind == MatrixUniform::VIEW_PROJECTION ? all.eyeFromWorld
                                                                                           : eyeFromLocal;
            const glm::mat4 now(clipFromEye * eyeFromIts);
            const GLint location = active->second._location;
            const auto [before, isNew] = _before.try_emplace(location);
            if (isNew) _gl.glGetUniformfv(program->getHandle(), location, &before->second[0][0]);
            _gl.glUniformMatrix4fv(location, 1, GL_FALSE, &now[0][0]);
        }
    }
    ~NamedMatrices() {
        for (const auto& [location, value] : _before) _gl.glUniformMatrix4fv(location, 1, GL_FALSE, &value[0][0]);
    }
    NamedMatrices(const NamedMatrices&) = delete;
    NamedMatrices& operator=(const NamedMatrices&) = delete;

private:
    const osg::GLExtensions& _gl;
    std::map<GLint, glm::mat4> _before;
};

/// Draws one picture into the framebuffer that is bound, under a MapState.
class Drawing {
public:
    Drawing(osg::RenderInfo& info, const MapPicture& shown, const MapPrograms& of)
        : _renderInfo(info), _state(*info.getState()), _picture(shown), _programs(of) {}

    /// @param all  of the texture is to be cleared, parts that no tile is in, too.
    std::string drawStill(const Windows& windows, bool all) {
        if (all) {
            glDisable(GL_SCISSOR_TEST);
            glClear(GL_DEPTH_BUFFER_BIT);
            glEnable(GL_SCISSOR_TEST);
        }
        for (const auto& window : all ? Windows() : windows) {
            scissorTo(window.texels);
            glClear(GL_DEPTH_BUFFER_BIT);
        }
        return drawLayer(_picture.still, windows);
    }

    std::string drawMovers(const Windows& windows) {
        const std::string cause = drawLayer(_picture.moving, windows);
        if (!cause.empty()) return cause;
        for (const SelfDrawnCaster& caster : _picture.selfDrawn.casters) {
            const auto isIn = [&](const MapPicture::Window& window) {
                return isInMap(caster.box, window.tile->clipFromScene());
            };
            if (std::none_of(windows.begin(), windows.end(), isIn)) continue;
            const SelfDrawnState applied(_state, _picture.selfDrawn, *caster.drawing);
            const MapState map;
            glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
            if (const float alpha = caster.drawing->casting.opaqueFrom; alpha > 0.0f) {
                glEnable(GL_ALPHA_TEST);
                glAlphaFunc(GL_GEQUAL, alpha);
            }
            for (const MapPicture::Window& window : windows)
                if (isIn(window)) drawSelfDrawn(caster, window);
        }
        return "";
    }

private:
    std::string drawLayer(const MapPicture::Layer& layer, const Windows& windows) {
        if (windows.empty()) return "";
        for (const bool smooth : {false, true}) {
            const auto isMeant = [smooth](const MapPicture::Mesh& mesh) { return mesh.triangles->smooth == smooth; };
            if (std::none_of(layer.meshes.begin(), layer.meshes.end(), isMeant)) continue;
            const bool byLamp = windows.front().tile->nearest > 0.0;
            _state.apply(smooth ? _programs.smoothCaster : byLamp ? _programs.casterByLamp : _programs.caster);
            if (!hasProgram(_state)) return noProgram;
            for (const auto& window : windows) {
                drawInto(window);
                drawMeshes(layer, smooth, window.tile->clipFromScene());
            }
        }
        if (layer.cutouts.empty()) return "";
        _state.apply(_programs.cutout);
        if (!hasProgram(_state)) return noProgram;
        setUniform(_state, "cutout", 0);
        for (const MapCutout& cutout : layer.cutouts) {
            _state.applyTextureAttribute(0, cutout.texture);
            setUniform(_state, "alphaTest", glm::dvec2(cutout.passing, cutout.reference));
            for (const auto& window : windows) {
                drawInto(window);
                cutout.geometry->draw(_renderInfo);
            }
        }
        return "";
    }

    /// @param smooth  those that are, or the others.
    void drawMeshes(const MapPicture::Layer& layer, bool smooth, const glm::dmat4& clipFromScene) {
        for (const MapPicture::Mesh& mesh : layer.meshes) {
            if (mesh.triangles->smooth != smooth || !isInMap(mesh.box, clipFromScene)) continue;
            const glm::dmat4 clipFromMesh = clipFromScene * mesh.sceneFromMesh;
            setUniform(_state, "clipFromVertex", clipFromMesh);
            if (smooth) setUniform(_state, "light", lightOf(clipFromMesh));
            mesh.triangles->draw(_renderInfo, clipFromMesh, mesh.outside);
        }
    }

    /// What is drawn next goes there.
    void drawInto(const MapPicture::Window& window) {
        glViewport(window.tile->corner.x, window.tile->corner.y, _picture.size, _picture.size);
        scissorTo(window.texels);
        setUniform(_state, "clipFromVertex", window.tile->clipFromScene());
        setUniform(_state, "nearest", window.tile->nearest);
        (window.tile->nearest > 0.0 ? glEnable : glDisable)(GL_CLIP_PLANE0);
    }

    /// By its own code, at what that costs in the view. The modelview is the view's, so that what goes by the eye, as
    /// tessellation may, looks as it does there.
    void drawSelfDrawn(const SelfDrawnCaster& caster, const MapPicture::Window& window) {
        const glm::dmat4& eyeFromScene = _picture.selfDrawn.eyeFromScene;
        const glm::dmat4 clipFromEye = window.tile->clipFromScene() * glm::inverse(eyeFromScene);
        const auto refMatrix = [](const glm::dmat4& matrix) { return new osg::RefMatrix(toOsg(matrix)); };
        glViewport(window.tile->corner.x, window.tile->corner.y, _picture.size, _picture.size);
        scissorTo(window.texels);
        glMatrixMode(GL_PROJECTION);
        glLoadIdentity(); // else Mesa keeps a part of a perspective's inverse, and cuts elsewhere
        _state.applyProjectionMatrix(refMatrix(clipFromEye));
        if (const double nearest = window.tile->nearest; nearest > 0.0 && !_state.getLastAppliedProgramObject()) {
            const glm::dvec4 before = glm::row(clipFromEye, 3) - glm::dvec4(0.0, 0.0, 0.0, nearest);
            _state.applyModelViewMatrix(nullptr);
            glClipPlane(GL_CLIP_PLANE5, &before[0]); // unless the caster has as many planes of its own
            glEnable(GL_CLIP_PLANE5);
        }
        _state.applyModelViewMatrix(refMatrix(eyeFromScene * caster.sceneFromLocal));
        for (const auto& [number, plane] : caster.drawing->casting.clips) {
            const osg::Vec4d inLocal = caster.drawing->groupFromLocal * plane;
            glClipPlane(GL_CLIP_PLANE0 + number, inLocal.ptr());
            glEnable(GL_CLIP_PLANE0 + number);
        }
        const auto* program = _state.getLastAppliedProgramObject();
        const bool cuts = program && writesClipDistance(*program->getProgram());
        for (unsigned i = 0; cuts && i < 8; ++i)
            if (_state.getLastAppliedMode(GL_CLIP_PLANE0 + i)) glEnable(GL_CLIP_PLANE0 + i);
        if (_state.getUseModelViewAndProjectionUniforms()) _state.applyModelViewAndProjectionUniformsIfRequired();
        const NamedMatrices named(_state, _picture.selfDrawn, clipFromEye, eyeFromScene * caster.sceneFromLocal);
        caster.drawing->drawable->draw(_renderInfo);
    }

    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    const MapPicture& _picture;
    const MapPrograms& _programs;
};

} // namespace

glm::dmat4 MapPicture::Tile::clipFromScene() const {
    return glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)), glm::dvec3(2.0)) * mapFromScene;
}

bool MapPicture::Layer::operator==(const Layer& other) const {
    const auto alike = [](const auto& a, const auto& b) { return a.geometry == b.geometry; };
    return meshes == other.meshes &&
           std::equal(cutouts.begin(), cutouts.end(), other.cutouts.begin(), other.cutouts.end(), alike);
}

const MapPicture::Tile* MapPicture::findStill(const Tile& tile, const MapPicture& other) const {
    if (!(still == other.still && size == other.size)) return nullptr;
    const auto found = std::find_if(tiles.begin(), tiles.end(), [&tile](const Tile& each) {
        return each.corner == tile.corner && each.mapFromScene == tile.mapFromScene;
    });
    return found == tiles.end() ? nullptr : &*found;
}

DepthMap::DepthMap(const glm::ivec2& texels, osg::Texture::FilterMode filter)
    : size(texels),
      _texture(mapTexture(texels, filter)),
      _saved(mapTexture(texels, osg::Texture::NEAREST)),
      _blocks(blocksTexture(texels)) {}

DepthMap::~DepthMap() { release(nullptr); }

std::string DepthMap::show(osg::RenderInfo& renderInfo, const MapPicture& picture, MapPrograms& programs) {
    osg::State& state = *renderInfo.getState();
    const GLint most = glInteger(GL_MAX_TEXTURE_SIZE);
    if (std::max(size.x, size.y) > most)
        return "a map of " + std::to_string(size.x) + " x " + std::to_string(size.y) +
               " texels cannot be made, because this OpenGL allows at most " + std::to_string(most) +
               " on a side. Set a smaller size.";
    Target& target = targetOf(state);
    const auto* texture = _texture->getTextureObject(state.getContextID());
    if (texture && target.shown == &picture && target.texture == texture) return "";
    if (target.texture != texture) target.shown = nullptr;
    const std::string cause = draw(renderInfo, target, picture, programs);
    target.shown = cause.empty() ? &picture : nullptr;
    state.apply(); // ResolvedDepth draws by what it finds, and finds a program otherwise
    return cause;
}

/// What stands still where the texture shows something else, and what moves where that is, or was.
std::string DepthMap::draw(osg::RenderInfo& renderInfo, Target& target, const MapPicture& picture,
                           MapPrograms& programs) {
    osg::State& state = *renderInfo.getState();
    const auto& gl = *state.get<osg::GLExtensions>();
    if (!gl.isFrameBufferObjectSupported || !gl.glBlitFramebuffer) return noTarget;
    const ScratchFramebuffer framebuffer(gl);
    bind(state, 0); // which makes it
    target.texture = _texture->getTextureObject(state.getContextID());
    framebuffer.attachDepth(*target.texture);
    if (!framebuffer.isComplete()) return noTarget;
    const MapState mapState;
    const bool sameMoving = target.shown && target.shown->hasSameMoving(picture);
    unsigned due = 0;
    Windows still, moving;
    std::vector<PixelRect> hidden, toHide; // by what moved, and by what moves
    for (const MapPicture::Tile& tile : picture.tiles) {
        const MapPicture::Tile* shown = target.shown ? target.shown->findStill(tile, picture) : nullptr;
        if (shown && (sameMoving || (shown->movers.empty() && tile.movers.empty()))) continue;
        ++due;
        if (!shown) still.push_back({&tile, {tile.corner.x, tile.corner.y, picture.size, picture.size}});
        if (shown && !shown->movers.empty()) hidden.push_back(shown->movers);
        if (tile.movers.empty()) continue;
        moving.push_back({&tile, tile.movers});
        toHide.push_back(tile.movers);
    }
    if (due > 0) target.inBlocks = false;
    Drawing drawing(renderInfo, picture, programs);
    std::string cause = drawing.drawStill(still, !target.shown);
    if (cause.empty() && !(hidden.empty() && moving.empty())) {
        state.applyTextureAttribute(0, _saved); // which makes it
        const ScratchFramebuffer saved(gl);
        saved.attachDepth(*_saved->getTextureObject(state.getContextID()));
        if (!saved.isComplete()) return noTarget;
        copyDepths(gl, saved.name, framebuffer.name, hidden);
        copyDepths(gl, framebuffer.name, saved.name, toHide);
        framebuffer.bind();
        cause = drawing.drawMovers(moving);
    }
    if (cause.empty()) programs.passes += due;
    return cause;
}

std::string DepthMap::updateBlocks(osg::State& state, const MapPrograms& programs) {
    if (!UncomparedSampler::isSupported(state)) return noBlocks;
    Target& target = targetOf(state);
    if (target.inBlocks) return "";
    const auto& gl = *state.get<osg::GLExtensions>();
    const bool made = _blocks->getTextureObject(state.getContextID());
    bindBlocks(state, 0);
    if (!made) gl.glGenerateMipmap(GL_TEXTURE_2D); // room for all levels
    const SavedState values(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_COLOR_BUFFER_BIT,
                            {GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_ALPHA_TEST});
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const ScratchFramebuffer framebuffer(gl);
    state.apply(programs.blocks);
    if (!hasProgram(state)) return noProgram;
    setUniform(state, "finer", 0);
    target.inBlocks = true;
    for (int level = 0; target.inBlocks && level < levels; ++level) {
        std::optional<UncomparedSampler> raw;
        state.applyTextureAttribute(0, level == 0 ? _texture : _blocks);
        level == 0 ? void(raw.emplace(state, 0u)) : readLevels(level - 1, level - 1);
        target.inBlocks = drawLevel(state, level);
    }
    bindBlocks(state, 0);
    readLevels(0, levels - 1);
    return target.inBlocks ? "" : noBlocks;
}

/// From what is bound to unit 0. @return false if OpenGL cannot draw to it.
bool DepthMap::drawLevel(osg::State& state, int level) const {
    const auto& gl = *state.get<osg::GLExtensions>();
    const GLuint name = _blocks->getTextureObject(state.getContextID())->id();
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, name, level);
    if (gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) != GL_FRAMEBUFFER_COMPLETE_EXT) return false;
    glViewport(0, 0, _blocks->getTextureWidth() >> level, _blocks->getTextureHeight() >> level);
    setUniform(state, "side", level == 0 ? finest : 2);
    drawQuad(state);
    return true;
}

DepthMap::Target& DepthMap::targetOf(const osg::State& state) {
    Lock lock(_mutex);
    return _targets[state.getContextID()];
}

void DepthMap::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& texture : {_texture, _saved, _blocks}) texture->resizeGLObjectBuffers(maxSize);
}

void DepthMap::release(osg::State* state) {
    for (const auto& texture : {_texture, _saved, _blocks}) texture->releaseGLObjects(state);
    Lock lock(_mutex);
    for (auto entry = _targets.begin(); entry != _targets.end();) {
        const bool meant = !state || state->getContextID() == entry->first;
        entry = meant ? _targets.erase(entry) : std::next(entry);
    }
}

} // namespace gnomon
