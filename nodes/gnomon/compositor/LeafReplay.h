// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LightUniform.h>
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/vec2.hpp>
#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/State>

#include <map>
#include <vector>

namespace gnomon {

/// Whether what is drawn in the state that is applied depends on lights, and so can lose one: by fixed function, by a
/// program that reads the colours of OpenGL's lights, or by uniforms that the user named.
class ProgramLightUse {
public:
    /// @param uniforms  of the user; must outlive this.
    ProgramLightUse(const osg::State& state, const std::vector<LightUniform>& uniforms)
        : _state(state), _uniforms(uniforms) {}

    /// True if it can lose all of `lost` (bit i: OpenGL light i).
    bool canLose(unsigned lost);

    /// Sets the named uniforms of these lights to 0 in the program in use.
    void darken(unsigned lost);
    /// Puts back what darken() changed.
    void restore();

private:
    using Program = osg::Program::PerContextProgram;
    struct DarkUniform {
        GLint location;
        int components;
        GLfloat value[4]; ///< that it had.
    };

    bool readsUniforms(const Program& program, unsigned lost) const;

    const osg::State& _state;
    const std::vector<LightUniform>& _uniforms;
    std::map<const Program*, bool> _readsColors;
    std::vector<DarkUniform> _changed;
};

/// A leaf to be drawn again, and the lights (bit i: light i) that it loses.
struct ReplayedLeaf {
    DrawnLeaf entry;
    unsigned lost = 0;
    bool isBehind = false;  ///< writes no depth, and nothing that does was drawn before it: it hides nothing.
    bool isCatcher = false; ///< writes depth and no colour: what shows there loses light in its place.
};

/// Draws render leaves of the frame once more, with what the compositor wants of stencil, depth and lights laid over
/// each leaf's own state.
///
/// Whatever a leaf's state sets, PROTECTED or not, what is laid over holds: it goes to OpenGL after the leaf's state
/// and before its draw. At the end osg::State is told what it can no longer take for granted. Of a big geometry only the
/// clusters that can touch `Overlay::bounds` are drawn, if neither a program nor a vertex array object draws it.
class LeafReplay {
public:
    /// What becomes of a leaf's colour.
    enum class Color {
        Replace, ///< as the leaf itself would have it.
        None,    ///< not written.
        Factor,  ///< what stands is multiplied by `Overlay::factor`.
        Mix,     ///< what stands times destination alpha, and the leaf's colour times the rest; alpha stays.
        Add      ///< the leaf's colour times destination alpha is added to what stands; alpha stays.
    };

    /// What is laid over each leaf.
    struct Overlay {
        GLenum stencilFunction = GL_ALWAYS; ///< compares (reference & test) with (stencil & test).
        unsigned reference = 0, test = 0;
        unsigned write = 0;             ///< bits that become those of `reference` where drawn.
        bool equalDepth = false;        ///< only where the leaf's depth is the one that stands; depth is not written.
        bool keepDepth = false;         ///< depth is not written.
        bool writesDepth = false;       ///< it is, whatever the leaf says.
        bool hidingOnly = false;        ///< what blends is drawn only where its alpha is a half or more.
        bool mirrored = false;          ///< fronts are seen as backs, and OpenGL's last clip plane cuts.
        std::vector<glm::ivec2> shifts; ///< pixels by which it is drawn, once each, cut to the viewport; empty: once.
        Color color = Color::Replace;
        float factor = 1.0f;
        float unlit =
            0.5f; ///< Replace: a leaf that should lose a light and cannot is drawn in its own colour times this.
        ScreenRect bounds = wholeScreen;         ///< nothing need be drawn outside.
        const Mark* mark = nullptr;              ///< nothing need be drawn where it marks nothing.
        std::vector<LightUniform> lightUniforms; ///< by which programs read lights.
    };

    /// The last clip plane that every OpenGL has; scenes rarely use it.
    static constexpr GLenum mirrorClipPlane = GL_CLIP_PLANE5;

    LeafReplay(const CompositorStage& draw, const Overlay& overlay);
    ~LeafReplay(); ///< puts lights and state back; the stack of state sets is as it was.
    LeafReplay(const LeafReplay&) = delete;
    LeafReplay& operator=(const LeafReplay&) = delete;

    /// @param lost  bit i: draw it without the diffuse and specular of OpenGL light i.
    void draw(const DrawnLeaf& entry, unsigned lost = 0);

    /// True if the leaf can lose all lights of `lost`, see ProgramLightUse. Draws nothing.
    bool canBeRelit(const DrawnLeaf& entry, unsigned lost);

    /// Leaves drawn so far that could not lose a light.
    const std::vector<const osgUtil::RenderLeaf*>& notRelit() const { return _notRelit; }

private:
    void apply(const DrawnLeaf& entry, bool again);
    void enter(osgUtil::RenderBin* bin);
    void layOver();
    void layAlphaOver();
    void forgetAlpha();
    void layMirrorOver();
    void layColorOver();
    void keepAlpha();
    void setBlendColor(float grey);
    void darken(unsigned lights);
    bool mayCut() const;
    bool canDrawClusters(const osgUtil::RenderLeaf& leaf, const osg::Geometry& geometry);
    void drawGeometry(const osgUtil::RenderLeaf& leaf);
    void drawOnce(const osgUtil::RenderLeaf& leaf);
    void drawFaded(const osgUtil::RenderLeaf& leaf);

    const CompositorStage& _draw;
    const bool _skipsUntouched;
    const StencilPattern _pattern;
    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    MaterialHistory& _materials;
    const Overlay _overlay;
    ProgramLightUse _lights;
    const unsigned _stackSize;
    unsigned _dark = 0; ///< lights that are lost in OpenGL now.
    std::vector<const osgUtil::RenderLeaf*> _notRelit;
    osgUtil::RenderBin* _bin = nullptr;
    osgUtil::StateGraph* _previous = nullptr; ///< whose state sets are on the stack.
    const osgUtil::StateGraph* _held =
        nullptr;        ///< whose state stands in OpenGL, and what is laid over it; null: none's.
    unsigned _lost = 0; ///< with that.
    bool _cuts = false; ///< in that state a part of a geometry may be drawn.
};

/// Bits of the stencil buffer to be written: those of `write` become those of `reference`.
struct StencilWrite {
    unsigned reference, write;
    unsigned scratch; ///< a bit that is 0 before, and after unless it is to be written; 0: there is none.
};

/// Writes stencil bits where one sees these leaves: where their depth stands; where they write none, wherever they pass their
/// own test and nothing that is drawn later hides them.
///
/// Cost  these leaves, once more; those drawn over one that writes no depth or no colour as well, if there is a scratch bit.
void writeWhereSeen(const CompositorStage& draw, const std::vector<ReplayedLeaf>& leaves, const StencilWrite& bits,
                    const ScreenRect& bounds);

/// Writes depths of what hides what stood when the frame was saved, over those that were saved, and the stencil bit for it.
/// @param moved  leaves that a program moves, wherever; null: none.
/// @return why that cannot be, as a cause for diagnose(); empty if all is well.
///
/// Cost  all of these leaves within the bounds, once more.
std::string drawHiding(const CompositorStage& draw, const ScreenRect& bounds, const LeafSet* moved);

/// Which leaves must be drawn again so that marked pixels get exactly what a full redraw would give them.
///
/// Left out: leaves whose screen bounds miss `bounds`. If every job names its receiver, marks lie only where a receiver
/// is what one sees; then a plain leaf (see isPlain()) drawn after the last receiver cannot show there and is left out
/// too.
std::vector<ReplayedLeaf> leavesToReplay(const CompositorStage& draw, const std::vector<const ShadowJob*>& jobs,
                                         const ScreenRect& bounds);

/// Leaves that a nested camera lays over what is seen through the lens of a job: no shadow of that job falls on them. What
/// writes no depth can hide only what was drawn before it.
std::vector<ReplayedLeaf> notOfLens(const ShadowJob& job, const std::vector<DrawnLeaf>& leaves);

} // namespace gnomon
