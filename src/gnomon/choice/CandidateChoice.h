// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon {

/// What a way to draw shadows is expected to come to.
struct ChoiceCandidate {
    bool usable = true; ///< else the shadow would be wrong, or missing.
    double error = 0.0; ///< pixels.
    double time = 0.0;  ///< milliseconds a frame.
};

/// What shadows may come to. Infinite: no limit.
struct ChoiceBudget {
    double error; ///< pixels; 0: as little as the time allows.
    double time;  ///< milliseconds a frame.
};

enum class ChoiceReason {
    Cheapest,      ///< of those that keep the budget.
    MostAccurate,  ///< of those that keep the time, for no error was set.
    Kept,          ///< it was chosen before, keeps the budget, and another would hardly be cheaper.
    ErrorTooSmall, ///< none keeps the error: the most accurate of those that keep the time.
    TimeTooShort,  ///< none keeps the time: the cheapest of those that keep the error, or of all.
};

/// A candidate by its place.
struct CandidateChoice {
    std::size_t index;
    ChoiceReason reason;
};

/// Another candidate takes the place of the one before only if it saves more than this share of the time.
constexpr double leastGain = 0.2;

/// Chooses; the same candidates and budget give the same choice.
/// @param before  the one that is drawn now: it stays where it keeps the budget, until another gains leastGain.
/// @return nullopt if none is usable.
std::optional<CandidateChoice> chooseCandidate(const std::vector<ChoiceCandidate>& candidates,
                                               const ChoiceBudget& budget, std::optional<std::size_t> before = {});

} // namespace gnomon
