// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/auto/CandidateFacts.h>
#include <gnomon/volume/VolumeForecast.h>

#include <string>
#include <vector>

namespace gnomon {

/// What is known of a group's casters and receivers, from earlier decisions.
struct AutoKnowledge {
    TerrainKnowledge terrain;
    OpenCasters open;
};

/// All that could draw one light's shadow in a view.
struct CandidateList {
    std::vector<AutoCandidate> all;
    std::string nothing; ///< why no shadow is needed; empty: one is. `all` is then the only candidate, none.
};

/// @param receiver  that the technique names.
/// A new technique is one more function in CandidateList.cpp.
CandidateList listCandidates(const ShadowInView& shadow, const Selection& receiver, AutoKnowledge& known);

/// Why a candidate that was right for another frame is wrong now; empty if it still is right.
std::string whyWrong(const AutoCandidate& candidate, const ShadowInView& shadow, const Selection& receiver,
                     AutoKnowledge& known);

} // namespace gnomon
