// SPDX-License-Identifier: MIT
#include <gnomon/LeafReplay.h>

#include <osg/GLExtensions>
#include <osg/Light>
#include <osgUtil/StateGraph>

#include <string>

namespace gnomon {
namespace {

constexpr int maxLights = 8;

void setColors(int light, const osg::Vec4& diffuse, const osg::Vec4& specular) {
    const GLenum name = GL_LIGHT0 + static_cast<GLenum>(light);
    glLightfv(name, GL_DIFFUSE, diffuse.ptr());
    glLightfv(name, GL_SPECULAR, specular.ptr());
}

/// The colours that osg::State believes the light to have; OpenGL's own defaults if no osg::Light was ever applied.
void restoreColors(const osg::State& state, int number) {
    const auto* light = dynamic_cast<const osg::Light*>(
        state.getLastAppliedAttribute(osg::StateAttribute::LIGHT, static_cast<unsigned>(number)));
    const osg::Vec4 fallback = number == 0 ? osg::Vec4(1, 1, 1, 1) : osg::Vec4(0, 0, 0, 1);
    setColors(number, light ? light->getDiffuse() : fallback, light ? light->getSpecular() : fallback);
}

/// OSG's own list of a program's uniforms leaves the built-in ones out, so OpenGL is asked.
bool readsLights(const osg::GLExtensions& gl, GLuint program) {
    GLint count = 0;
    gl.glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        char name[64] = {}; // cut off if longer: only how it begins matters
        GLint size = 0;
        GLenum type = 0;
        gl.glGetActiveUniform(program, static_cast<GLuint>(i), sizeof name, nullptr, &size, &type, name);
        for (const std::string light : {"gl_LightSource", "gl_FrontLightProduct", "gl_BackLightProduct"})
            if (std::string(name).compare(0, light.size(), light) == 0) return true;
    }
    return false;
}

} // namespace

LeafReplay::LeafReplay(osg::RenderInfo& renderInfo, const Overlay& overlay)
    : _renderInfo(renderInfo),
      _state(*renderInfo.getState()),
      _overlay(overlay),
      _stackSize(static_cast<unsigned>(_state.getStateSetStackSize())) {}

LeafReplay::~LeafReplay() {
    using A = osg::StateAttribute;
    _state.popStateSetStackToSize(_stackSize);
    darken(0);
    _state.haveAppliedMode(GL_STENCIL_TEST, A::ON);
    if (_overlay.factor < 1.0f) _state.haveAppliedMode(GL_BLEND, A::ON);
    for (A::Type type : {A::STENCIL, A::DEPTH, A::COLORMASK, A::BLENDFUNC, A::BLENDCOLOR})
        _state.haveAppliedAttribute(type);
}

void LeafReplay::draw(const StageLeaf& entry, unsigned dark) {
    if (_state.getAbortRendering()) return;
    if (entry.bin != _bin) enter(entry.bin);
    const osgUtil::RenderLeaf& leaf = *entry.leaf;
    osgUtil::StateGraph* graph = leaf._parent;
    _state.applyProjectionMatrix(leaf._projection.get());
    _state.applyModelViewMatrix(leaf._modelview.get());
    osgUtil::StateGraph::moveStateGraph(_state, _previous, graph->_parent);
    _previous = graph->_parent;
    _state.apply(graph->getStateSet());
    if (_state.getUseModelViewAndProjectionUniforms()) _state.applyModelViewAndProjectionUniformsIfRequired();
    layOver();
    const bool faded = dark && !canBeRelit();
    darken(faded ? 0 : dark);
    if (faded)
        drawFaded(leaf);
    else
        leaf._drawable->draw(_renderInfo);
}

bool LeafReplay::canBeRelit() {
    const osg::Program::PerContextProgram* program = _state.getLastAppliedProgramObject();
    if (!program) return _state.getLastAppliedMode(GL_LIGHTING);
    const auto [known, isNew] = _readsLights.insert({program, false});
    if (isNew) known->second = readsLights(*_state.get<osg::GLExtensions>(), program->getHandle());
    return known->second;
}

/// Its own colour times a factor, whatever colour stands; a leaf that blends by itself stays as it is.
void LeafReplay::drawFaded(const osgUtil::RenderLeaf& leaf) {
    _notRelit.push_back(&leaf);
    const bool blends = _state.getLastAppliedMode(GL_BLEND);
    if (!blends) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_CONSTANT_COLOR, GL_ZERO);
        _state.get<osg::GLExtensions>()->glBlendColor(_overlay.unlit, _overlay.unlit, _overlay.unlit, 1.0f);
    }
    leaf._drawable->draw(_renderInfo);
    if (!blends) glDisable(GL_BLEND);
    for (auto type : {osg::StateAttribute::BLENDFUNC, osg::StateAttribute::BLENDCOLOR})
        _state.haveAppliedAttribute(type);
}

/// A bin may have a state set of its own, which lies under those of its leaves.
void LeafReplay::enter(osgUtil::RenderBin* bin) {
    _state.popStateSetStackToSize(_stackSize);
    _previous = nullptr;
    _bin = bin;
    std::vector<osg::StateSet*> sets;
    for (; bin && bin != bin->getStage(); bin = bin->getParent())
        if (bin->getStateSet()) sets.push_back(bin->getStateSet());
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) _state.pushStateSet(*set);
}

void LeafReplay::layOver() {
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(_overlay.stencilFunction, static_cast<GLint>(_overlay.reference), _overlay.test);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilMask(_overlay.write);
    if (!_overlay.color) glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    if (_overlay.equalDepth) {
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_EQUAL);
    }
    if (_overlay.factor < 1.0f) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ZERO, GL_CONSTANT_COLOR);
        _state.get<osg::GLExtensions>()->glBlendColor(_overlay.factor, _overlay.factor, _overlay.factor, 1.0f);
    }
}

/// Again for each leaf: its own state may have set the light's colours.
void LeafReplay::darken(unsigned lights) {
    const osg::Vec4 black(0, 0, 0, 1);
    for (int i = 0; i < maxLights; ++i) {
        if (lights & (1u << i))
            setColors(i, black, black);
        else if (_dark & (1u << i))
            restoreColors(_state, i);
    }
    _dark = lights;
}

} // namespace gnomon
