// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/LightShares.h>
#include <gnomon/compositor/StencilMarks.h>

#include <vector>

namespace gnomon {

/// Composes jobs of which one at least fades, as smooth edges and penumbras do: visibility goes through destination alpha, which is 1
/// afterwards where something stands; the background keeps its own.
///
/// Relight: a pixel's colour is the sum of what it would be under each set of lights, weighted by the share of it that
/// sees just these; with one light that is one mix. Each leaf is drawn again at the depth that stands. A leaf that blends,
/// writes no depth or cannot lose its light is darkened by the factor instead, and reported.
class FadingCompositor {
public:
    /// @param draw  with alpha bits and at least one stencil bit; must outlive this.
    explicit FadingCompositor(const CompositorStage& draw);

    void relight(const Jobs& wanted) const;
    void blend(const Jobs& jobs, float dark) const;

private:
    using Leaves = std::vector<ReplayedLeaf>;
    /// Lights, and what shares of them arrive.
    struct Weights {
        const MarkedLights& lights;
        const LightShares& shares;
        bool areInAlpha; ///< alpha is already the share of the one light there is.
    };

    Leaves setAside(Leaves& leaves, const Jobs& jobs) const;
    void darkenAside(const Leaves& aside, const Weights& weights, const Jobs& jobs) const;
    void multiplyByFactor(const Weights& weights, float factor, const ScreenRect& bounds) const;
    void mix(const Leaves& leaves, const Weights& weights, const Jobs& jobs) const;
    void replay(const Leaves& leaves, const MarkedLights& lights, unsigned lost, const ScreenRect& bounds,
                const Jobs& jobs) const;
    ScreenRect boundsWithout(const MarkedLights& lights, unsigned lost) const;
    /// Multiplies alpha by the share of each.
    StencilMarks::MarkFading markWeighed() const;
    void addBlended(const Jobs& jobs, const LightShares& shares, unsigned bit) const;
    void weigh(const Weights& weights, unsigned lost, const ScreenRect& bounds) const;

    const CompositorStage& _draw;
    const StencilMarks _marks;
};

} // namespace gnomon
