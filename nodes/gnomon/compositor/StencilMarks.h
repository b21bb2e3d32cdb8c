// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/ReplaySelection.h>
#include <gnomon/compositor/ShadowJob.h>

#include <vector>

namespace gnomon {

using Jobs = std::vector<const ShadowJob*>;

/// Each further light doubles the passes.
constexpr std::size_t mostRelitLights = 3;

/// Where all the jobs' marks can fall.
ScreenRect boundsOf(const Jobs& jobs);
/// Those of all the jobs' groups.
std::vector<LightUniform> lightUniformsOf(const Jobs& jobs);

/// Draws the marks of jobs into stencil bits, each cut to its receiver.
class StencilMarks {
public:
    /// Which pixels of a job that fades are marked.
    enum class Pixels {
        Half,    ///< those that less than half of the light reaches: a hard edge.
        Touched, ///< those that not all of the light reaches.
        Weighed  ///< the same, and alpha is multiplied by the share that does.
    };

    /// @param scratch  a stencil bit that is 0 before and after; 0 if there is none.
    StencilMarks(const CompositorStage& draw, unsigned scratch) : _draw(draw), _scratch(scratch) {}

    /// Adds a job's marks to those in `bit`.
    /// @param fresh  none are in it yet.
    void add(const ShadowJob& job, unsigned bit, bool fresh, Pixels pixels = Pixels::Half) const;
    /// Into a bit that is 0, whatever the receiver.
    void addUngated(const ShadowJob& job, unsigned bit, Pixels pixels = Pixels::Half) const;

private:
    void gate(const ShadowJob& job, unsigned bit) const;
    void transfer(const ShadowJob& job, unsigned bit) const;

    const CompositorStage& _draw;
    const unsigned _scratch;
};

} // namespace gnomon
