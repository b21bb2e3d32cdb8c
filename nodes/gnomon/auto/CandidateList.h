// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/auto/CandidateFacts.h>
#include <gnomon/volume/VolumeForecast.h>

#include <optional>
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

/// Finds all that could draw one light's shadow in a view, in three parts of about the same length. Things may move between them.
/// A new technique is one more function in CandidateList.cpp.
class CandidateSearch {
public:
    /// Does the next part by the facts of this frame.
    /// @param receiver  that the technique names.
    /// @return the candidates after the last part; before, nullopt.
    std::optional<CandidateList> look(const ShadowInView& shadow, const Selection& receiver, AutoKnowledge& known);

private:
    friend class Lister;

    int _part = 0;
    osg::ref_ptr<const MapCasters> _boxes; ///< of the first part; they keep these casters until the last one.
    MapForecast _one;                      ///< of one map, or as few as there can be.
    VolumeForecast _volumes;
    std::optional<MapEdges> _edges;
};

/// Why a candidate that was right for another frame is wrong now; empty if it still is right.
std::string whyWrong(const AutoCandidate& candidate, const ShadowInView& shadow, const Selection& receiver,
                     AutoKnowledge& known);

} // namespace gnomon
