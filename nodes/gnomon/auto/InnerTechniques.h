// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/base/RecentCache.h>

#include <functional>

namespace gnomon {

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
