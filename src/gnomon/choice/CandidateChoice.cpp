// SPDX-License-Identifier: MIT
#include <gnomon/choice/CandidateChoice.h>

#include <algorithm>
#include <tuple>

namespace gnomon {
namespace {

constexpr double sameError = 1.05; // more accurate by less than that is no reason to take longer

} // namespace

ShadowWork& ShadowWork::operator+=(const ShadowWork& other) {
    for (double ShadowWork::*count :
         {&ShadowWork::calls, &ShadowWork::triangles, &ShadowWork::texels, &ShadowWork::pixels, &ShadowWork::taps,
          &ShadowWork::relit, &ShadowWork::filled, &ShadowWork::rays, &ShadowWork::objects})
        this->*count += other.*count;
    return *this;
}

double timeOf(const ShadowWork& work, const CostRates& rates) {
    return work.calls * rates.call + work.triangles * rates.triangle + work.texels * rates.texel +
           work.pixels * rates.pixel + work.taps * rates.tap + work.relit * rates.relit + work.filled * rates.filled +
           work.rays * rates.ray + work.objects * rates.object;
}

std::optional<CandidateChoice> chooseCandidate(const std::vector<ChoiceCandidate>& candidates, double error,
                                               std::optional<std::size_t> before) {
    const auto least = [&](const auto& test, const auto& measure) {
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < candidates.size(); ++i)
            if (candidates[i].usable && test(candidates[i]) &&
                (!best || measure(candidates[i]) < measure(candidates[*best])))
                best = i;
        return best;
    };
    const auto cost = [](const ChoiceCandidate& one) { return std::make_tuple(one.time, one.error); };
    const auto keeps = [error](const ChoiceCandidate& one) { return one.error <= error; };
    if (const auto best = least(keeps, cost)) {
        const bool stays = before && candidates[*before].usable && keeps(candidates[*before]) &&
                           candidates[*best].time >= (1.0 - leastGain) * candidates[*before].time;
        if (stays && *before != *best) return CandidateChoice{*before, ChoiceReason::Kept};
        return CandidateChoice{*best, ChoiceReason::Cheapest};
    }
    const auto finest = least([](const auto&) { return true; }, [](const auto& one) { return one.error; });
    if (!finest) return std::nullopt;
    const double most = sameError * candidates[*finest].error;
    return CandidateChoice{*least([most](const auto& one) { return one.error <= most; }, cost),
                           ChoiceReason::ErrorTooSmall};
}

} // namespace gnomon
