// SPDX-License-Identifier: MIT
#include <gnomon/ScreenPass.h>
#include <gnomon/base/PixelRect.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/MaterialHistory.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/TriangleClusters.h>

#include <osg/AlphaFunc>
#include <osg/ColorMask>
#include <osg/FragmentProgram>
#include <osg/FrontFace>
#include <osg/Light>
#include <osg/VertexProgram>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <typeinfo>

namespace gnomon {
namespace {

bool contains(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

bool namesColor(const std::string& source) { return contains(source, "diffuse") || contains(source, "specular"); }

/// True if GLSL text uses what a light colours: a product of light and material, a light's colour, or a light as a whole.
bool usesLightColor(const std::string& source) {
    if (contains(source, "LightProduct")) return true;
    const std::string name = "gl_LightSource";
    for (std::size_t at = source.find(name); at != std::string::npos; at = source.find(name, at + 1)) {
        const std::size_t bracket =
            source.find(']', at); // an index that itself has brackets is taken for a whole light
        const std::size_t next =
            bracket == std::string::npos ? bracket : source.find_first_not_of(" \t\r\n", bracket + 1);
        if (next == std::string::npos || source[next] != '.') return true;
        const std::size_t member = source.find_first_not_of(" \t\r\n", next + 1);
        for (const char* color : {"diffuse", "specular"})
            if (member != std::string::npos && source.compare(member, std::string(color).size(), color) == 0)
                return true;
    }
    return false;
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

/// OpenGL may list all of a light where its position alone is read: the text tells better, if there is one.
bool textUsesColor(const osg::Program& program) {
    bool hasText = false;
    for (unsigned i = 0; i < program.getNumShaders(); ++i) {
        const std::string& source = program.getShader(i)->getShaderSource();
        if (usesLightColor(source)) return true;
        hasText = hasText || !source.empty();
    }
    return !hasText;
}

/// An assembly program that is in use; null if none is.
template <typename AssemblyProgram>
const AssemblyProgram* assemblyIn(const osg::State& state, GLenum mode, osg::StateAttribute::Type type) {
    if (!state.getLastAppliedMode(mode)) return nullptr;
    return dynamic_cast<const AssemblyProgram*>(state.getLastAppliedAttribute(type));
}

bool assemblyReads(const std::string& source) { return contains(source, "state.light") && namesColor(source); }

/// By fixed function, or by assembly programs in its place.
bool fixedFunctionReads(const osg::State& state) {
    const auto* vertex =
        assemblyIn<osg::VertexProgram>(state, GL_VERTEX_PROGRAM_ARB, osg::StateAttribute::VERTEXPROGRAM);
    const auto* fragment =
        assemblyIn<osg::FragmentProgram>(state, GL_FRAGMENT_PROGRAM_ARB, osg::StateAttribute::FRAGMENTPROGRAM);
    if (fragment && assemblyReads(fragment->getFragmentProgram())) return true;
    return vertex ? assemblyReads(vertex->getVertexProgram()) : state.getLastAppliedMode(GL_LIGHTING);
}

/// 0 for a type that is no light's colour.
int componentsOf(GLenum type) {
    switch (type) {
    case GL_FLOAT:
        return 1;
    case GL_FLOAT_VEC2:
        return 2;
    case GL_FLOAT_VEC3:
        return 3;
    case GL_FLOAT_VEC4:
        return 4;
    default:
        return 0;
    }
}

void setUniform(const osg::GLExtensions& gl, GLint location, int components, const GLfloat* value) {
    const auto set = std::array{gl.glUniform1fv, gl.glUniform2fv, gl.glUniform3fv, gl.glUniform4fv};
    set.at(static_cast<std::size_t>(components - 1))(location, 1, value);
}

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

bool isReceiver(const std::vector<const ShadowJob*>& jobs, const osgUtil::RenderLeaf* leaf) {
    return std::any_of(jobs.begin(), jobs.end(), [leaf](const ShadowJob* job) { return job->isNamed(leaf); });
}

unsigned lightsLostBy(const osgUtil::RenderLeaf* leaf, const std::vector<const ShadowJob*>& jobs) {
    unsigned lost = 0;
    for (const ShadowJob* job : jobs)
        if (job->isReceiver(*leaf)) lost |= 1u << job->light;
    return lost;
}

/// Index of the last receiver, if only receivers and what is drawn over or before them can show where marks are.
/// The number of leaves if that cannot be told.
std::size_t lastReceiver(const std::vector<DrawnLeaf>& leaves, const std::vector<const ShadowJob*>& jobs) {
    if (std::any_of(jobs.begin(), jobs.end(), [](const ShadowJob* job) { return !job->receiverNamed; }))
        return leaves.size();
    std::size_t last = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (!isReceiver(jobs, leaves[i].leaf)) continue;
        if (!isPlain(leaves[i].leaf->_parent)) return leaves.size();
        last = i;
    }
    return last;
}

/// Tells catchers of shadows: what writes depth and no colour, unless another leaf draws the same in colour, as after a pass of
/// depths alone.
class Catchers {
public:
    explicit Catchers(const std::vector<DrawnLeaf>& leaves) : _leaves(leaves) {}

    bool isColored(const osgUtil::RenderLeaf& leaf) {
        if (leaf._parent != _graph)
            _isColored = writesColor(_graph = leaf._parent); // leaves of one state mostly follow
        return _isColored;
    }

    /// Of a leaf that writes no colour.
    bool operator()(const osgUtil::RenderLeaf& leaf) {
        if (!writesDepth(leaf._parent)) return false;
        if (_colored.empty())
            for (const DrawnLeaf& entry : _leaves)
                if (isColored(*entry.leaf)) _colored.insert({entry.leaf->_drawable.get(), entry.leaf});
        const auto [begin, end] = _colored.equal_range(leaf._drawable.get());
        return std::none_of(begin, end, [&](auto& other) { return modelviewOf(*other.second) == modelviewOf(leaf); });
    }

private:
    const std::vector<DrawnLeaf>& _leaves;
    const osgUtil::StateGraph* _graph = nullptr;
    bool _isColored = true;
    std::multimap<const osg::Drawable*, const osgUtil::RenderLeaf*> _colored;
};

/// A leaf by which one finds out what is seen.
struct SeenStep {
    DrawnLeaf entry;
    bool isSeen; ///< by itself, else it hides what was drawn before.
};

/// Puts among steps, in the order of drawing, what is drawn over one that leaves no depth or colour of its own, and hides it.
/// @return whether there is any.
bool addDrawnOver(const CompositorStage& draw, std::vector<SeenStep>& steps) {
    const auto stands = [](const SeenStep& step) {
        return writesDepth(step.entry.leaf->_parent) && writesColor(step.entry.leaf->_parent);
    };
    if (std::all_of(steps.begin(), steps.end(), stands)) return false;
    std::set<const osgUtil::RenderLeaf*> seen;
    for (const SeenStep& step : steps) seen.insert(step.entry.leaf);
    std::vector<SeenStep> all;
    bool open = false, overdrawn = false;
    for (const DrawnLeaf& entry : draw.leaves) {
        const osgUtil::StateGraph* graph = entry.leaf->_parent;
        const bool isSeen = seen.count(entry.leaf) > 0;
        open = open || (isSeen && !stands({entry, true}));
        const bool hides =
            !isSeen && open && writesColor(graph) && !isOn(graph, GL_BLEND) && !isOn(graph, GL_COLOR_LOGIC_OP);
        if (isSeen || hides) all.push_back({entry, isSeen});
        overdrawn = overdrawn || hides;
    }
    if (overdrawn) steps = std::move(all);
    return overdrawn;
}

} // namespace

bool ProgramLightUse::canLose(unsigned lost) {
    const Program* program = _state.getLastAppliedProgramObject();
    if (!program) return fixedFunctionReads(_state);
    const auto [known, isNew] = _readsColors.insert({program, false});
    if (isNew)
        known->second = readsLights(*_state.get<osg::GLExtensions>(), program->getHandle()) &&
                        textUsesColor(*program->getProgram());
    return known->second || readsUniforms(*program, lost);
}

bool ProgramLightUse::readsUniforms(const Program& program, unsigned lost) const {
    unsigned read = 0;
    for (const LightUniform& uniform : _uniforms) {
        const auto active = program.getActiveUniforms().find(osg::Uniform::getNameID(uniform.name));
        const bool isColor = active != program.getActiveUniforms().end() && componentsOf(active->second._type) > 0;
        if (isColor) read |= 1u << uniform.number;
    }
    return (lost & ~read) == 0;
}

void ProgramLightUse::darken(unsigned lost) {
    const Program* program = _state.getLastAppliedProgramObject();
    if (!program) return;
    const osg::GLExtensions& gl = *_state.get<osg::GLExtensions>();
    for (const LightUniform& uniform : _uniforms) {
        const auto active = program->getActiveUniforms().find(osg::Uniform::getNameID(uniform.name));
        if (!(lost & (1u << uniform.number)) || active == program->getActiveUniforms().end()) continue;
        DarkUniform changed{active->second._location, componentsOf(active->second._type), {}};
        if (changed.components == 0) continue;
        gl.glGetUniformfv(program->getHandle(), changed.location, changed.value);
        const GLfloat black[4] = {};
        setUniform(gl, changed.location, changed.components, black);
        _changed.push_back(changed);
    }
}

void ProgramLightUse::restore() {
    for (const DarkUniform& uniform : _changed)
        setUniform(*_state.get<osg::GLExtensions>(), uniform.location, uniform.components, uniform.value);
    _changed.clear();
}

LeafReplay::LeafReplay(const CompositorStage& draw, const Overlay& overlay)
    : _draw(draw),
      _skipsUntouched(draw.options.skipsUntouched),
      _pattern(draw.pattern),
      _renderInfo(draw.renderInfo),
      _state(draw.state),
      _materials(draw.materials),
      _overlay(overlay),
      _lights(_state, _overlay.lightUniforms),
      _stackSize(static_cast<unsigned>(_state.getStateSetStackSize())) {
    _state.setActiveTextureUnit(0); // as drawables that draw themselves may take for granted
}

LeafReplay::~LeafReplay() {
    _state.popStateSetStackToSize(_stackSize);
    darken(0);
    leaveDefaults(_state);
    if (!_overlay.mirrored) return;
    glFrontFace(GL_CCW);
    _state.haveAppliedAttribute(osg::StateAttribute::FRONTFACE);
    glDisable(mirrorClipPlane);
    _state.haveAppliedMode(mirrorClipPlane, osg::StateAttribute::OFF);
}

namespace {

/// True if it leaves OpenGL's state as it finds it, but for arrays and the current colour.
bool keepsState(const osg::Drawable& drawable) {
    return typeid(drawable) == typeid(osg::Geometry) && !drawable.getDrawCallback();
}

} // namespace

/// Leaves that follow each other in one state, as most do, are drawn in a row.
void LeafReplay::draw(const DrawnLeaf& entry, unsigned lost) {
    if (_state.getAbortRendering()) return;
    const bool again = entry.bin == _bin && entry.leaf->_parent == _held && lost == _lost;
    _held = nullptr;
    apply(entry, again);
    if (!again) {
        layOver();
        _cuts = mayCut();
        const bool faded = lost && !_lights.canLose(lost);
        darken(faded ? 0 : lost);
        if (faded) return drawFaded(*entry.leaf);
    }
    _lights.darken(lost);
    const bool tested = _overlay.hidingOnly && _state.getLastAppliedMode(GL_BLEND) &&
                        !_state.getLastAppliedMode(GL_COLOR_LOGIC_OP); // which takes the place of blending
    if (tested) layAlphaOver();
    drawGeometry(*entry.leaf);
    if (tested) forgetAlpha();
    _lights.restore();
    if (tested || !keepsState(*entry.leaf->_drawable)) return;
    _held = entry.leaf->_parent;
    _lost = lost;
}

bool LeafReplay::canBeRelit(const DrawnLeaf& entry, unsigned lost) {
    _held = nullptr;
    apply(entry, false);
    return _lights.canLose(lost);
}

/// All of the leaf's own state. @param again  that of its state sets stands.
void LeafReplay::apply(const DrawnLeaf& entry, bool again) {
    if (entry.bin != _bin) enter(entry.bin);
    const osgUtil::RenderLeaf& leaf = *entry.leaf;
    _state.applyProjectionMatrix(leaf._projection.get());
    _state.applyModelViewMatrix(leaf._modelview.get());
    if (!again) {
        osgUtil::StateGraph* graph = leaf._parent;
        osgUtil::StateGraph::moveStateGraph(_state, _previous, graph->_parent);
        _previous = graph->_parent;
        _state.apply(graph->getStateSet());
    }
    _materials.leadTo(leaf);
    if (_state.getUseModelViewAndProjectionUniforms()) _state.applyModelViewAndProjectionUniformsIfRequired();
}

/// Programs may move vertices to where no cluster's box is; a restarted strip's corners do not alternate from its start.
bool LeafReplay::mayCut() const {
    constexpr GLenum vertexProgram = 0x8620, restart = 0x8F9D, restartFixedIndex = 0x8D69;
    return _skipsUntouched && !_state.getLastAppliedProgramObject() && !_state.getLastAppliedMode(vertexProgram) &&
           !_state.getLastAppliedMode(restart) && !_state.getLastAppliedMode(restartFixedIndex);
}

bool LeafReplay::canDrawClusters(const osgUtil::RenderLeaf& leaf, const osg::Geometry& geometry) {
    return _cuts && (_overlay.mark || TriangleClusters::isBig(geometry)) && isFilled(leaf) &&
           !_state.useVertexArrayObject(geometry.getUseVertexArrayObject());
}

void LeafReplay::drawGeometry(const osgUtil::RenderLeaf& leaf) {
    if (_overlay.shifts.empty()) return drawOnce(leaf);
    const auto [x, y, width, height] = pixelsOf(*_state.getCurrentViewport());
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, width, height);
    for (const glm::ivec2& shift : _overlay.shifts) {
        glViewport(x + shift.x, y + shift.y, width, height);
        drawOnce(leaf);
    }
    glViewport(x, y, width, height);
}

void LeafReplay::drawOnce(const osgUtil::RenderLeaf& leaf) {
    const osg::Geometry* geometry = leaf._drawable->asGeometry();
    const bool cut = geometry && canDrawClusters(leaf, *geometry);
    const Mark::BoxTest test = cut && _overlay.mark ? _overlay.mark->boxTest(modelviewOf(leaf)) : Mark::BoxTest();
    if (test && geometry->getBoundingBox().valid() && !test(geometry->getBoundingBox())) return;
    const osg::ref_ptr<const TriangleClusters> clusters = cut ? TriangleClusters::of(*geometry) : nullptr;
    if (!clusters) return leaf._drawable->draw(_renderInfo);
    TriangleClusters::draw(_renderInfo, *geometry,
                           clusters->touching(_overlay.bounds, modelviewOf(leaf) * projectionOf(leaf), test));
}

/// Its own colour times a factor, whatever colour stands; a leaf that itself reads what stands stays as it is.
void LeafReplay::drawFaded(const osgUtil::RenderLeaf& leaf) {
    _notRelit.push_back(&leaf);
    const bool fades = _overlay.color == Color::Replace && !_state.getLastAppliedMode(GL_BLEND) &&
                       !_state.getLastAppliedMode(GL_COLOR_LOGIC_OP);
    if (fades) {
        addBlended(_state, GL_CONSTANT_COLOR, GL_ZERO);
        setBlendColor(_overlay.unlit);
    }
    drawGeometry(leaf);
    if (!fades) return;
    glDisable(GL_BLEND);
    using A = osg::StateAttribute;
    for (A::Type type : {A::BLENDFUNC, A::BLENDCOLOR, A::BLENDEQUATION}) _state.haveAppliedAttribute(type);
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

/// The same for every leaf, so that osg::State need not know before the end.
void LeafReplay::layOver() {
    _pattern.test(_overlay.stencilFunction, _overlay.reference, _overlay.test);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilMask(_overlay.write);
    if (_overlay.equalDepth || _overlay.keepDepth) {
        glDepthMask(GL_FALSE);
        if (_overlay.equalDepth) glDepthFunc(GL_EQUAL);
    }
    if (_overlay.writesDepth) glDepthMask(GL_TRUE);
    if (_overlay.mirrored) layMirrorOver();
    layColorOver();
}

/// What the leaf's own test leaves of that. One that lets low alphas pass is there for what does not hide.
void LeafReplay::layAlphaOver() {
    using Test = osg::AlphaFunc;
    const bool tests = _state.getLastAppliedMode(GL_ALPHA_TEST);
    const auto* own =
        tests ? static_cast<const Test*>(_state.getLastAppliedAttribute(osg::StateAttribute::ALPHAFUNC)) : nullptr;
    const Test::ComparisonFunction function = own ? own->getFunction() : Test::ALWAYS;
    const bool takesHigh = function == Test::GREATER || function == Test::GEQUAL;
    const bool takesAll = function == Test::ALWAYS || function == Test::NOTEQUAL;
    glEnable(GL_ALPHA_TEST);
    if (takesHigh && own->getReferenceValue() >= hidingAlpha) return;
    glAlphaFunc(takesHigh || takesAll ? GL_GEQUAL : GL_NEVER, hidingAlpha);
}

void LeafReplay::forgetAlpha() {
    glDisable(GL_ALPHA_TEST);
    glAlphaFunc(GL_ALWAYS, 0.0f);
    _state.haveAppliedMode(GL_ALPHA_TEST, osg::StateAttribute::OFF);
    _state.haveAppliedAttribute(osg::StateAttribute::ALPHAFUNC);
}

void LeafReplay::layMirrorOver() {
    const auto* front =
        static_cast<const osg::FrontFace*>(_state.getLastAppliedAttribute(osg::StateAttribute::FRONTFACE));
    const bool clockwise = front && front->getMode() == osg::FrontFace::CLOCKWISE;
    glFrontFace(clockwise ? GL_CCW : GL_CW);
    glEnable(mirrorClipPlane);
}

void LeafReplay::layColorOver() {
    const auto blend = [this](GLenum source, GLenum destination) { addBlended(_state, source, destination); };
    switch (_overlay.color) {
    case Color::Replace:
        return;
    case Color::None:
        return glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    case Color::Factor:
        blend(GL_ZERO, GL_CONSTANT_COLOR);
        keepAlpha();
        return setBlendColor(_overlay.factor);
    case Color::Mix:
        blend(GL_ONE_MINUS_DST_ALPHA, GL_DST_ALPHA);
        return keepAlpha();
    case Color::Add:
        blend(GL_DST_ALPHA, GL_ONE);
        return keepAlpha();
    }
}

/// Where a leaf writes no colour, what others have drawn shows, and is darkened.
void LeafReplay::keepAlpha() {
    Channels open;
    const auto* mask = _state.getLastAppliedAttribute(osg::StateAttribute::COLORMASK);
    if (!openBy(static_cast<const osg::ColorMask*>(mask), open)) open = _draw.channels();
    glColorMask(open.red, open.green, open.blue, GL_FALSE);
}

void LeafReplay::setBlendColor(float grey) { _state.get<osg::GLExtensions>()->glBlendColor(grey, grey, grey, 1.0f); }

/// Again for each run of leaves: their state may have set the light's colours.
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

void writeWhereSeen(const CompositorStage& draw, const std::vector<ReplayedLeaf>& leaves, const StencilWrite& bits,
                    const ScreenRect& bounds) {
    std::vector<SeenStep> steps;
    for (const ReplayedLeaf& leaf : leaves) steps.push_back({leaf.entry, true});
    const bool overdrawn = bits.scratch && addDrawnOver(draw, steps);
    const StencilWrite now = overdrawn ? StencilWrite{bits.scratch, bits.scratch, 0} : bits;
    std::optional<LeafReplay> replay;
    LeafReplay::Overlay overlay;
    overlay.write = now.write;
    overlay.color = LeafReplay::Color::None;
    overlay.keepDepth = true;
    overlay.bounds = bounds;
    for (const SeenStep& step : steps) {
        const bool equal = writesDepth(step.entry.leaf->_parent);
        const unsigned reference = step.isSeen ? now.reference : 0;
        if (!replay || overlay.equalDepth != equal || overlay.reference != reference) {
            overlay.equalDepth = equal;
            overlay.reference = reference;
            replay.emplace(draw, overlay);
        }
        replay->draw(step.entry);
    }
    replay.reset();
    if (!overdrawn || bits.write == bits.scratch) return;
    draw.pass(bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bits.scratch | bits.reference, bits.scratch, bits.write);
        screen.drawQuad();
    });
    draw.clear(bits.scratch, wholeScreen); // leaves are not cut to the bounds
}

std::string drawHiding(const CompositorStage& draw, const ScreenRect& bounds, const LeafSet* moved) {
    std::string cause;
    draw.pass(bounds, [&](ScreenPass& screen) { cause = draw.since->frame->drawDepths(screen); });
    if (!cause.empty()) return cause;
    LeafReplay::Overlay overlay;
    overlay.reference = overlay.write = draw.hidingBit;
    overlay.color = LeafReplay::Color::None;
    overlay.hidingOnly = overlay.writesDepth = true;
    overlay.bounds = bounds;
    LeafReplay replay(draw, overlay);
    TouchTest touches(bounds, moved);
    for (const DrawnLeaf& entry : draw.since->hiding)
        if (touches(*entry.leaf)) replay.draw(entry);
    return "";
}

std::vector<ReplayedLeaf> notOfLens(const ShadowJob& job, const std::vector<DrawnLeaf>& leaves) {
    TouchTest touches(job.mark->screenBounds, job.moved.get());
    std::vector<ReplayedLeaf> result;
    bool stands = false; // something of the lens that writes depth
    for (const DrawnLeaf& entry : leaves) {
        const bool isOfLens = job.isOfLens(*entry.leaf);
        stands = stands || (isOfLens && writesDepth(entry.leaf->_parent));
        const auto hides = [&] { return stands || writesDepth(entry.leaf->_parent); };
        if (!isOfLens && touches(*entry.leaf) && hides()) result.push_back({entry});
    }
    return result;
}

std::vector<ReplayedLeaf> leavesToReplay(const CompositorStage& draw, const std::vector<const ShadowJob*>& jobs,
                                         const ScreenRect& bounds) {
    const std::vector<DrawnLeaf>& leaves = draw.leaves;
    const bool skips = draw.options.skipsUntouched;
    TouchTest touches(bounds, jobs.front()->moved.get());
    const std::size_t last = skips ? lastReceiver(leaves, jobs) : leaves.size();
    std::vector<ReplayedLeaf> result;
    const DrawnLeaf* selfDrawn = nullptr; // draws itself and is left out: it may have set the colour of what has none
    bool stands = draw.since;             // something that writes depth
    Catchers catchers(leaves);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        const osgUtil::RenderLeaf& leaf = *leaves[i].leaf;
        if (i > last && isPlain(leaf._parent)) continue;
        const osg::Geometry* geometry = leaf._drawable->asGeometry();
        const bool replayed = !skips || touches(leaf);
        if (selfDrawn && replayed && geometry && !geometry->getColorArray()) {
            result.push_back({*selfDrawn});
            selfDrawn = nullptr;
        }
        stands = stands || writesDepth(leaf._parent);
        if (replayed) {
            const bool colored = catchers.isColored(leaf), catches = !colored && catchers(leaf);
            const unsigned lost = stands && (colored || catches) ? lightsLostBy(&leaf, jobs) : 0;
            result.push_back({leaves[i], lost, !stands, catches});
        }
        if (!geometry) selfDrawn = replayed ? nullptr : &leaves[i];
    }
    return result;
}

} // namespace gnomon
