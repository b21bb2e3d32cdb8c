// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/ShadowJob.h>

#include <functional>
#include <vector>

namespace gnomon {

using Jobs = std::vector<const ShadowJob*>;

/// Each further light doubles the passes.
constexpr std::size_t mostRelitLights = 3;

/// The cause of what cannot be drawn without a scratch bit.
constexpr const char* oneBitLeft =
    "a named receiver, a second technique for the same light or a receiver that writes no colour needs two stencil "
    "bits, "
    "but only one is left. Leave at least two out of CompositorOptions::reservedStencilBits.";

/// A cause for all their techniques.
void reportAll(const Jobs& jobs, const std::string& cause);
/// True if marks of both fall on the same leaves: then a share of one is a share of the other.
bool areOnTheSame(const ShadowJob& a, const ShadowJob& b);
/// Where all the jobs' marks can fall.
ScreenRect screenBoundsOf(const Jobs& jobs);
/// Those of all the jobs' groups.
std::vector<LightUniform> lightUniformsOf(const Jobs& jobs);

/// One light that is taken away in a view: the jobs that mark where, and the stencil bits of their marks.
struct MarkedLight {
    int number = 0; ///< OpenGL's.
    Jobs hard;      ///< a pixel gets all of the light or nothing.
    Jobs fading;    ///< of the same receivers all, see areOnTheSame().
    unsigned hardBit = 0, fadingBit = 0;

    unsigned bits() const { return hardBit | fadingBit; }
    bool isMixed() const { return hardBit && fadingBit; }
    Jobs jobs() const;
};
using MarkedLights = std::vector<MarkedLight>;

unsigned bitsOf(const MarkedLights& lights);
Jobs jobsOf(const MarkedLights& lights);
/// Those of `subset`: bit i means lights[i].
MarkedLights subsetOf(const MarkedLights& lights, unsigned subset);
/// Where pixels can lose all of these lights.
ScreenRect commonBounds(const MarkedLights& lights);

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

/// How many bits StencilMarks shares out to these jobs, where they are free: one a relit light, and one for all that blends, or two
/// with hard and with fading marks; one more where marks are put together or several lights are marked; two where marks fade.
std::size_t stencilBitsFor(const std::vector<ShadowJob>& jobs);

/// Shares out the free stencil bits of a stage to lights, and draws the marks of jobs into them, each cut to its receiver.
///
/// Marks live in the stencil of the frame itself. They are drawn by tests against its depths, to the bit: sides of volumes that
/// end in a surface, leaves that are drawn again at the depth that stands. OpenGL copies depths bit for bit only between buffers
/// of one sample and one format, and not by every driver (see WorkBuffers::DepthCopy). Anywhere else all leaves would be drawn
/// once more before the first mark, which takes as long as the frame.
///
/// Shares of a light need no depths that are exact. So they are in textures of the kit's own, see LightShares.
class StencilMarks {
public:
    /// Sets a bit where not all of the light of a job that fades arrives, in passes of its own. Where there is none, the edge is
    /// hard: those that less than half of the light reaches are marked.
    using MarkFading = std::function<void(const ShadowJob&, unsigned bit)>;

    /// @param draw   with one stencil bit at least; must outlive this.
    /// @param fades  jobs that fade have bits of their own; else their edges are hard.
    StencilMarks(const CompositorStage& draw, bool fades);

    /// For marks that need no other bit.
    unsigned firstBit() const { return _lightBits.front(); }
    /// 0 before and after each step; 0 if there is none.
    unsigned scratchBit() const { return _scratch; }
    /// For what cannot be mixed; 0 if there is none.
    unsigned fadedBit() const { return _faded; }

    /// Lights as far as there are bits for them, by their numbers; reports those that are left out.
    MarkedLights lightsOf(const Jobs& wanted) const;
    /// Draws all marks into their lights' bits, which are 0.
    void mark(const MarkedLights& lights, const MarkFading& fading = {}) const;
    /// Adds a job's marks to those in `bit`.
    /// @param fresh  none are in it yet.
    void add(const ShadowJob& job, unsigned bit, bool fresh, const MarkFading& fading = {}) const;
    /// Into a bit that is 0, whatever the receiver.
    void addUngated(const ShadowJob& job, unsigned bit, const MarkFading& fading = {}) const;
    /// Before marks: in this bit, and in those that add() takes.
    void clearLeftovers(unsigned bits) const { _draw.clearLeftovers(bits | _scratch | _faded); }

private:
    unsigned takeLast();
    bool assignBits(MarkedLight& light, std::vector<unsigned>& unused) const;
    void gate(const ShadowJob& job, unsigned bit) const;
    void transfer(const ShadowJob& job, unsigned from, unsigned bit) const;

    const CompositorStage& _draw;
    const bool _fades;
    std::vector<unsigned> _lightBits;
    unsigned _scratch, _faded; ///< 0 before and after; 0 if there is none.
};

} // namespace gnomon
