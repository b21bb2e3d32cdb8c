// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/map/MapCasters.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

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

} // namespace

std::vector<OwnCaster> ownCastersOf(const CasterLayers& layers) {
    std::vector<OwnCaster> result;
    const glm::dmat4 sceneFromGroup = glm::translate(glm::dmat4(1.0), -toGlm(layers.origin));
    for (const auto& drawing : layers.pieces->own) {
        const osg::BoundingBoxd& bounds = drawing->bounds;
        if (!bounds.valid()) continue;
        result.push_back({drawing,
                          sceneFromGroup * toGlm(drawing->groupFromLocal),
                          {toGlm(bounds._min - layers.origin), toGlm(bounds._max - layers.origin)}});
    }
    return result;
}

double clearanceOf(const std::vector<OwnCaster>& casters, const glm::dvec3& lamp) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const OwnCaster& caster : casters)
        if (!caster.drawing->hasPiece)
            nearest = std::min(nearest, glm::distance(lamp, glm::clamp(lamp, caster.box.low, caster.box.high)));
    return nearest;
}

/// osgUtil::SceneView's set has the time and the view's matrices, and is at the root of all leaves.
OwnView::OwnView(const glm::dmat4& matrix, const std::vector<const osgUtil::RenderLeaf*>& seen) : eyeFromScene(matrix) {
    if (seen.empty()) return;
    for (const osgUtil::StateGraph* graph = seen.front()->_parent; graph; graph = graph->_parent)
        if (graph->getStateSet() && graph->getStateSet()->getNumParents() == 0)
            states.insert(states.begin(), graph->getStateSet());
}

bool OwnCasters::areSame(const OwnCasters& other) const {
    const bool sameView = view.eyeFromScene == other.view.eyeFromScene;
    return std::equal(casters.begin(), casters.end(), other.casters.begin(), other.casters.end(),
                      [sameView](const OwnCaster& a, const OwnCaster& b) {
                          return a.drawing == b.drawing && a.sceneFromLocal == b.sceneFromLocal &&
                                 !a.drawing->mayChange && (sameView || !a.drawing->byProgram);
                      });
}

void OwnCasterPass::draw(const std::vector<Target>& targets) const {
    for (const OwnCaster& caster : _own.casters) draw(caster, targets);
}

void OwnCasterPass::draw(const OwnCaster& caster, const std::vector<Target>& targets) const {
    const auto isIn = [&](const Target& target) { return isInMap(caster.box, target.clipFromScene); };
    if (std::none_of(targets.begin(), targets.end(), isIn)) return;
    const OwnState own(*_renderInfo.getState(), _own, *caster.drawing);
    const MapState map(_slopeOffset);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    if (const float alpha = caster.drawing->casting.ownFrom; alpha > 0.0f) {
        glEnable(GL_ALPHA_TEST);
        glAlphaFunc(GL_GEQUAL, alpha);
    }
    for (const Target& target : targets)
        if (isIn(target)) draw(caster, target);
}

/// The modelview is the view's, so that what goes by the eye, as tessellation may, looks as it does there.
void OwnCasterPass::draw(const OwnCaster& caster, const Target& target) const {
    osg::State& state = *_renderInfo.getState();
    const glm::dmat4 clipFromEye = target.clipFromScene * glm::inverse(_own.view.eyeFromScene);
    glViewport(target.corner.x, target.corner.y, target.size, target.size);
    glScissor(target.texels.x, target.texels.y, target.texels.width, target.texels.height);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity(); // else Mesa keeps a part of a perspective's inverse, and cuts elsewhere
    state.applyProjectionMatrix(refMatrix(clipFromEye));
    if (!state.getLastAppliedProgramObject()) clip(caster, clipFromEye, target.nearest);
    state.applyModelViewMatrix(refMatrix(_own.view.eyeFromScene * caster.sceneFromLocal));
    for (const auto& [number, plane] : caster.drawing->casting.clips) {
        const osg::Vec4d inLocal = caster.drawing->groupFromLocal * plane;
        glClipPlane(GL_CLIP_PLANE0 + number, inLocal.ptr());
        glEnable(GL_CLIP_PLANE0 + number);
    }
    if (state.getUseModelViewAndProjectionUniforms()) state.applyModelViewAndProjectionUniformsIfRequired();
    caster.drawing->drawable->draw(_renderInfo);
}

/// Nothing that a lamp has nearer than this casts. The plane is one that does not cut the caster already, if there is one.
void OwnCasterPass::clip(const OwnCaster& caster, const glm::dmat4& clipFromEye, double nearest) const {
    if (!(nearest > 0.0)) return;
    const auto isUsed = [&caster](GLenum plane) {
        const auto& clips = caster.drawing->casting.clips;
        return std::any_of(clips.begin(), clips.end(),
                           [plane](const NumberedPlane& used) { return GL_CLIP_PLANE0 + used.first == plane; });
    };
    GLenum free = GL_CLIP_PLANE0;
    while (isUsed(free) && free < GL_CLIP_PLANE5) ++free;
    const glm::dvec4 distance = glm::row(clipFromEye, 3), plane = distance - glm::dvec4(0.0, 0.0, 0.0, nearest);
    _renderInfo.getState()->applyModelViewMatrix(nullptr);
    glClipPlane(free, &plane[0]);
    glEnable(free);
}

} // namespace gnomon
