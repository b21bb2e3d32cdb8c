// SPDX-License-Identifier: MIT
#include <gnomon/choice/CandidateChoice.h>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr double sameError = 1.05; // more accurate by less than that is no reason to take longer

/// The least time, or error, of candidates; infinite without any.
double leastOf(double ChoiceCandidate::*what, const std::vector<ChoiceCandidate>& candidates) {
    double least = std::numeric_limits<double>::infinity();
    for (const ChoiceCandidate& each : candidates)
        if (each.usable) least = std::min(least, each.*what);
    return least;
}

/// Rules those out that take longer, or err more, than that.
void limit(std::vector<ChoiceCandidate>& candidates, double ChoiceCandidate::*what, double most) {
    for (ChoiceCandidate& each : candidates) each.usable = each.usable && each.*what <= most;
}

struct ProcessorCost {
    double ShadowWork::*count;
    double thousands; ///< of instructions, for each.
};
/// Fitted to what bench_processor --instructions counts where Mesa draws nothing: 100 frames of ten scenes, from three
/// drawables to 4,000 and to 70,000 triangles, with volumes, maps and hulls, still, under a moving camera, light or body. Rays
/// are processor time of all threads.
constexpr ProcessorCost processorCosts[] = {
    {&ShadowWork::calls, 23.0}, {&ShadowWork::casters, 1.7}, {&ShadowWork::leaves, 4.2}, {&ShadowWork::relit, 0.01},
    {&ShadowWork::fits, 2.2},   {&ShadowWork::volumes, 2.6}, {&ShadowWork::faced, 0.2},  {&ShadowWork::sides, 0.6},
    {&ShadowWork::hulls, 9.0},  {&ShadowWork::rays, 1.45},
};

} // namespace

double processorTime(const ShadowWork& work, const RendererRates& rates) {
    double thousands = 0.0;
    for (const ProcessorCost& cost : processorCosts) thousands += work.*cost.count * cost.thousands;
    return thousands * 1e3 / rates.instructions;
}

double rendererTime(const ShadowWork& work, const RendererRates& rates) {
    return work.calls * rates.call + work.triangles * rates.triangle + work.texels * rates.texel +
           work.pixels * rates.pixel + work.taps * rates.tap + work.relit * rates.relit + work.filled * rates.filled;
}

double timeOf(const ShadowWork& work, const RendererRates& rates) {
    return processorTime(work, rates) + rendererTime(work, rates);
}

std::optional<CandidateChoice> chooseCandidate(const std::vector<ChoiceCandidate>& candidates, double error,
                                               std::optional<std::size_t> before, double little) {
    std::vector<ChoiceCandidate> left = candidates;
    const bool keepsError = leastOf(&ChoiceCandidate::error, candidates) <= error;
    if (keepsError) limit(left, &ChoiceCandidate::error, error);
    const auto isFlawless = [](const ChoiceCandidate& each) { return each.usable && !each.flawed; };
    if (keepsError && std::any_of(left.begin(), left.end(), isFlawless))
        for (ChoiceCandidate& each : left) each.usable = isFlawless(each);
    if (before) {
        left[*before].time *= favour;
        left[*before].error *= favour;
    }
    const double cheapest = leastOf(&ChoiceCandidate::time, left);
    if (keepsError) limit(left, &ChoiceCandidate::time, std::max(hardlyDearer * cheapest, cheapest + little));
    limit(left, &ChoiceCandidate::error, sameError * leastOf(&ChoiceCandidate::error, left));
    const double time = leastOf(&ChoiceCandidate::time, left);
    const auto chosen = std::find_if(left.begin(), left.end(),
                                     [time](const ChoiceCandidate& each) { return each.usable && each.time == time; });
    if (chosen == left.end()) return std::nullopt;
    const auto index = std::size_t(chosen - left.begin());
    if (!keepsError) return CandidateChoice{index, ChoiceReason::ErrorTooSmall};
    if (index == before && chooseCandidate(candidates, error, {}, little)->index != index)
        return CandidateChoice{index, ChoiceReason::Kept};
    return CandidateChoice{index, time > cheapest ? ChoiceReason::MoreAccurate : ChoiceReason::Cheapest};
}

} // namespace gnomon
