// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/auto/CandidateFacts.h>
#include <gnomon/auto/FlatReceivers.h>
#include <gnomon/volume/VolumeForecast.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// What is known of a group's casters and receivers, from earlier decisions.
struct AutoKnowledge {
    CasterShapes shapes;
    TerrainKnowledge terrain;
    CasterSplits splits;
    OpenCasters open;
    std::optional<FlatReceivers> flat; ///< of the view that is asked about now; nullopt: nobody has looked for them.

    /// Looks for them unless that was done.
    const FlatReceivers& flatIn(const AutoView& view);
};

/// All that could draw one light's shadow in a view.
struct CandidateList {
    std::vector<AutoCandidate> all;
    std::string nothing; ///< why no shadow is needed; empty: one is. `all` is then the only candidate, none.
};

/// @param receiver  that the technique names.
/// A new technique is one more function in CandidateList.cpp.
CandidateList listCandidates(const AutoView& view, const Selection& receiver, AutoKnowledge& known);

/// Why a candidate that was right for another frame is wrong now; empty if it still is right.
std::string whyWrong(const AutoCandidate& candidate, const AutoView& view, const Selection& receiver,
                     AutoKnowledge& known);

} // namespace gnomon
