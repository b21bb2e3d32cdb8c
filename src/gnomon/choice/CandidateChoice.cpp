// SPDX-License-Identifier: MIT
#include <gnomon/choice/CandidateChoice.h>

#include <tuple>

namespace gnomon {
namespace {

constexpr double sameError = 1.05; // more accurate by less than that is no reason to take longer

/// The candidates, under one budget.
class Chooser {
public:
    Chooser(const std::vector<ChoiceCandidate>& all, const ChoiceBudget& budget) : _all(all), _budget(budget) {}

    bool keepsError(std::size_t i) const { return _all[i].error <= _budget.error; }
    bool keepsTime(std::size_t i) const { return _all[i].time <= _budget.time; }

    template <class Test>
    std::optional<std::size_t> cheapest(const Test& test) const {
        return least(test, [this](std::size_t i) { return std::make_tuple(_all[i].time, _all[i].error); });
    }
    /// Of those that are as accurate as the most accurate one, the cheapest.
    template <class Test>
    std::optional<std::size_t> mostAccurate(const Test& test) const {
        const auto best = least(test, [this](std::size_t i) { return std::make_tuple(_all[i].error, _all[i].time); });
        if (!best) return best;
        return cheapest([&](std::size_t i) { return test(i) && _all[i].error <= sameError * _all[*best].error; });
    }

private:
    template <class Test, class Measure>
    std::optional<std::size_t> least(const Test& test, const Measure& measure) const {
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < _all.size(); ++i)
            if (_all[i].usable && test(i) && (!best || measure(i) < measure(*best))) best = i;
        return best;
    }

    const std::vector<ChoiceCandidate>& _all;
    const ChoiceBudget _budget;
};

} // namespace

std::optional<CandidateChoice> chooseCandidate(const std::vector<ChoiceCandidate>& candidates,
                                               const ChoiceBudget& budget, std::optional<std::size_t> before) {
    const Chooser chooser(candidates, budget);
    const auto keepsAll = [&](std::size_t i) { return chooser.keepsError(i) && chooser.keepsTime(i); };
    const auto keepsTime = [&](std::size_t i) { return chooser.keepsTime(i); };
    const auto keepsError = [&](std::size_t i) { return chooser.keepsError(i); };
    const auto any = [](std::size_t) { return true; };
    if (const auto best = chooser.cheapest(keepsAll)) {
        const bool stays = before && candidates[*before].usable && keepsAll(*before) &&
                           candidates[*best].time >= (1.0 - leastGain) * candidates[*before].time;
        if (stays) return CandidateChoice{*before, *before == *best ? ChoiceReason::Cheapest : ChoiceReason::Kept};
        return CandidateChoice{*best, ChoiceReason::Cheapest};
    }
    const bool open = !(budget.error > 0.0);
    if (const auto best = chooser.mostAccurate(keepsTime))
        return CandidateChoice{*best, open ? ChoiceReason::MostAccurate : ChoiceReason::ErrorTooSmall};
    if (const auto best = chooser.cheapest(keepsError)) return CandidateChoice{*best, ChoiceReason::TimeTooShort};
    if (const auto best = chooser.cheapest(any)) return CandidateChoice{*best, ChoiceReason::TimeTooShort};
    return std::nullopt;
}

} // namespace gnomon
