// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/ReplaySelection.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/WorkFramebuffer.h>

#include <optional>
#include <vector>

namespace gnomon {

using Jobs = std::vector<const ShadowJob*>;

/// Each further light doubles the passes.
constexpr std::size_t mostRelitLights = 3;

/// Where all the jobs' marks can fall.
ScreenRect boundsOf(const Jobs& jobs);
/// Those of all the jobs' groups.
std::vector<LightUniform> lightUniformsOf(const Jobs& jobs);

/// Sets the bits of `write` to those of `reference` where one sees these leaves; where they write no depth, wherever they
/// pass their own test.
void writeWhereSeen(const CompositorStage& draw, const std::vector<ReplayedLeaf>& leaves, unsigned reference,
                    unsigned write, const ScreenRect& bounds);

/// While it lives, the depths of a stage's vast leaves are right: their triangles, cut in double, are drawn where the leaf is
/// what one sees. Afterwards the leaf's own depths stand there again, to the bit. Nothing is done in stages without any.
class TrueDepths {
public:
    TrueDepths(const CompositorStage& draw, const ScreenRect& bounds);
    ~TrueDepths();
    TrueDepths(const TrueDepths&) = delete;
    TrueDepths& operator=(const TrueDepths&) = delete;

private:
    const CompositorStage& _draw;
    const ScreenRect _bounds;
};

/// Draws the marks of jobs into stencil bits, each cut to its receiver.
class StencilMarks {
public:
    /// Which pixels of a soft job are marked.
    enum class Soft {
        Half,    ///< those that less than half of the light reaches: a hard edge.
        Touched, ///< those that not all of the light reaches.
        Weighed  ///< the same, and alpha is multiplied by the share that does.
    };

    /// @param scratch  a stencil bit that is 0 before and after; 0 if there is none.
    StencilMarks(const CompositorStage& draw, unsigned scratch) : _draw(draw), _scratch(scratch) {}

    /// Adds a job's marks to those in `bit`.
    /// @param fresh  none are in it yet.
    void add(const ShadowJob& job, unsigned bit, bool fresh, Soft soft = Soft::Half) const;
    /// Into a bit that is 0, whatever the receiver.
    void addUngated(const ShadowJob& job, unsigned bit, Soft soft = Soft::Half) const;

private:
    void gate(const ShadowJob& job, unsigned bit) const;
    void transfer(const ShadowJob& job, unsigned bit) const;

    const CompositorStage& _draw;
    const unsigned _scratch;
};

/// What composing needs of the framebuffer that it is done in.
struct TargetNeeds {
    ScreenRect bounds = wholeScreen; ///< nothing is drawn outside.
    unsigned reserved = 0;           ///< stencil bits that are the application's.
    std::size_t stencilBits = 0;     ///< beside those.
    bool alpha = false;
    bool ownStencil = false; ///< nobody else's marks may be touched.
};

/// The needs of these jobs alone.
TargetNeeds needsOf(const std::vector<ShadowJob>& jobs);

/// What the compositor draws into, while it does: the framebuffer that is bound, its first colour buffer alone; or where
/// that lacks what is needed, one of its own in that one's place (WorkFramebuffer).
class CompositorTarget {
public:
    /// Call where no state set is on the stack, in a compatibility profile.
    CompositorTarget(osg::State& state, const osg::Viewport& viewport, const TargetNeeds& needs);

    /// True if it is one of its own: no stencil bit is anyone else's, and all are 0.
    bool isOwn() const { return _own && _own->isBound(); }
    /// True if depths are to be drawn first.
    bool lacksDepth() const { return isOwn() && !_own->hasDepth(); }

private:
    const FirstColorBuffer _colors;
    std::optional<WorkFramebuffer> _own;
};

} // namespace gnomon
