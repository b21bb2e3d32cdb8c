// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/AutoShadowOptions.h>
#include <gnomon/ShadowDecision.h>
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/choice/CandidateChoice.h>

#include <functional>
#include <string>
#include <vector>

namespace gnomon {

/// Shares of the frames in which things move. Where several do, the first of these counts.
struct AutoMotion {
    double light = 0.0, casters = 0.0, view = 0.0;

    bool isAny() const { return light > 0.0 || casters > 0.0 || view > 0.0; }
};

/// A way to draw a shadow, with what it is expected to come to.
struct AutoCandidate {
    enum class Kind { Nothing, Terrain, Map, Volume, Traced };

    Kind kind = Kind::Nothing;
    ShadowMapOptions map = {};
    bool smooth = false;                            ///< edges are, of what is no map.
    double error = 0.0;                             ///< pixels.
    bool flawed = false;                            ///< see ChoiceCandidate.
    ShadowWork still = {};                          ///< in every frame.
    ShadowWork light = {}, casters = {}, view = {}; ///< besides, in a frame in which these move; see AutoMotion.
    std::string why = {};                           ///< the facts that it suits, in a few words.
    std::string obstacle = {};                      ///< why it cannot be used.

    /// Specification string without composite and receiver.
    std::string spec() const;
    /// True if it is drawn alike.
    bool isSame(const AutoCandidate& other) const;
    /// Milliseconds a frame, over many frames.
    double time(const RendererRates& rates, const AutoMotion& motion) const;
    ShadowCandidate judged(const RendererRates& rates, const AutoMotion& motion) const;
};

/// The techniques that draw what was chosen: made when they are needed, and let go when no view has chosen them lately.
/// Each has its own settings, which never change.
///
/// Threads one at a time; what it gives out is good for any number.
class InnerTechniques {
public:
    /// Null for no shadow. @param round  rises with each frame.
    osg::ref_ptr<const ShadowTechnique> of(const AutoCandidate& candidate, const Selection& receiver, unsigned round);
    /// Lets all go.
    void clear();
    /// Calls `visit` with each that is there.
    void forEach(const std::function<void(ShadowTechnique&)>& visit) const;
    /// ShadowTechnique::passes() of all, those included that were let go.
    unsigned passes() const;

private:
    struct Made {
        AutoCandidate candidate;
        Selection receiver;
        osg::ref_ptr<ShadowTechnique> technique;
        unsigned lastRound;
    };
    RecentCache<Made> _made;
    unsigned _passesOfGone = 0;
};

} // namespace gnomon
