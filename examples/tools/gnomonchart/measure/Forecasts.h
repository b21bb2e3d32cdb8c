// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"
#include "Contender.h"

#include <gnomon/ShadowDecision.h>
#include <gnomon/ShadowSpec.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::examples {

/// What auto's model expects of fixed settings in one scene: auto draws it with the same composite and receiver, and its
/// candidates are asked for.
///
/// The chart measures the shadow on everything. So no error is expected of a setting that names its receiver.
///
/// Cost  a fresh viewer and two frames for each composite and receiver; the first ever measures the renderer besides.
class Forecasts {
public:
    explicit Forecasts(const ChartScene& scene) : _scene(scene) {}

    /// nullopt if auto has no such candidate in this scene, or if its shadow would be wrong here.
    std::optional<ChartPrediction> of(const Contender& contender);

private:
    using Way = std::pair<bool, Receives>; ///< whether it blends, and what receives.
    const std::vector<ShadowCandidate>& candidates(const Way& way);

    const ChartScene& _scene;
    std::map<Way, std::vector<ShadowCandidate>> _candidates;
};

/// The candidate that draws as a specification of a fixed technique does; null if there is none that can be used.
const ShadowCandidate* candidateOf(const std::vector<ShadowCandidate>& candidates, const ShadowSpec& spec);

} // namespace gnomon::examples
