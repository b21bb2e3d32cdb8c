// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon {

/// Work that a shadow adds to a frame, as counted before it is done.
struct ShadowWork {
    double calls = 0.0;     ///< draws and full-screen steps.
    double triangles = 0.0; ///< drawn without colour: casters into a map, flattened ones, polygons on terrain.
    double texels = 0.0;    ///< of maps that are cleared and filled, and of stencil counts.
    double pixels = 0.0;    ///< whose depth is copied or compared.
    double taps = 0.0;      ///< comparisons of 2 × 2 texels, over all pixels.
    double relit = 0.0;     ///< triangles of the scene that are drawn once more.
    double filled = 0.0;    ///< pixels that those cover, or that are blended.
    double rays = 0.0;      ///< cast by the processor.
    double objects = 0.0;   ///< shadows found on terrain, or sides of shadow volumes.

    ShadowWork& operator+=(const ShadowWork& other);
};

/// What a unit of each kind of work costs, milliseconds. Only the ratios decide.
struct CostRates {
    double call, triangle, texel, pixel, tap, relit, filled, ray, object;
};

/// Processor time where a processor draws: measured with llvmpipe on one core of an AMD EPYC.
constexpr CostRates processorRates = {0.05, 8e-5, 1.3e-6, 7e-6, 3.4e-6, 2.1e-4, 6e-6, 2e-4, 2.5e-4};
/// Where a graphics processor draws: 24 µs a call with its state, as map and volume take on an NVIDIA H200. The rest are estimates:
/// 10⁹ triangles, 3·10¹⁰ texels and 10¹⁰ blended pixels a second. Rays and outlines are the processor's.
constexpr CostRates graphicsRates = {0.024, 1e-6, 3e-8, 2e-7, 5e-8, 2e-6, 1e-7, 2e-4, 2.5e-4};

/// Milliseconds.
double timeOf(const ShadowWork& work, const CostRates& rates);

/// What a way to draw shadows is expected to come to.
struct ChoiceCandidate {
    bool usable = true; ///< else the shadow would be wrong, or missing.
    double error = 0.0; ///< pixels.
    double time = 0.0;  ///< milliseconds a frame.
};

enum class ChoiceReason {
    Cheapest,     ///< of those that keep the error.
    Kept,         ///< it was chosen before, keeps the error, and another would hardly be cheaper.
    ErrorTooSmall ///< none keeps the error: the most accurate.
};

/// A candidate by its place.
struct CandidateChoice {
    std::size_t index;
    ChoiceReason reason;
};

/// Another candidate takes the place of the one before only if it saves more than this share of the time.
constexpr double leastGain = 0.2;

/// Chooses; the same candidates and error give the same choice.
/// @param error   pixels, at most.
/// @param before  the one that is drawn now: it stays where it keeps the error, until another gains leastGain.
/// @return nullopt if none is usable.
std::optional<CandidateChoice> chooseCandidate(const std::vector<ChoiceCandidate>& candidates, double error,
                                               std::optional<std::size_t> before = {});

} // namespace gnomon
