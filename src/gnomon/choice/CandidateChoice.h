// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon {

/// Work that a shadow adds to a frame, as counted before it is done.
struct ShadowWork {
    // The processor's, in OpenSceneGraph, in Gnomon and in OpenGL's driver:
    double calls = 0.0;   ///< full-screen steps and draws of many triangles, with the state that they need.
    double casters = 0.0; ///< that are compared with the frame before, or whose outline is found.
    double leaves = 0.0;  ///< of the scene that are drawn once more.
    double fits = 0.0;    ///< see MapForecast::fits.
    double volumes = 0.0; ///< that are placed in a view.
    double faced = 0.0;   ///< triangles that are asked whether they face the light.
    double sides = 0.0;   ///< of volumes, with what closes them, that are made and handed to OpenGL.
    double hulls = 0.0;   ///< shadows that are found on terrain.
    double rays = 0.0;    ///< that are cast.
    // The renderer's, besides what it takes for each call:
    double triangles = 0.0; ///< drawn without colour: casters into a map, volumes, polygons on terrain.
    double texels = 0.0;    ///< of maps that are cleared and filled, and of stencil counts.
    double pixels = 0.0;    ///< whose depth is copied or compared.
    double taps = 0.0;      ///< comparisons of 2 × 2 texels, over all pixels.
    double relit = 0.0;     ///< triangles of the scene that are drawn once more.
    double filled = 0.0;    ///< pixels that those cover, or that are blended.
};

/// A renderer, and the processor beside it.
struct RendererRates {
    double instructions; ///< that the processor executes in a millisecond.
    /// What the renderer takes for a unit of each kind of work, milliseconds.
    double call, triangle, texel, pixel, tap, relit, filled;
    double little; ///< milliseconds that nobody minds, see chooseCandidate().
};

/// llvmpipe on one core of an AMD EPYC of 14.5 instructions a nanosecond: fitted to processor time, less what the processor takes
/// where Mesa draws nothing, of 102 frames of seven scenes.
constexpr RendererRates llvmpipeRates = {14.5e6, 0.012, 1.6e-4, 1.04e-6, 1.4e-5, 1.7e-6, 2.4e-4, 7e-7, 0.0};
/// Graphics processors. A call took 24 µs on an NVIDIA H200 beside a processor of some 3 instructions a nanosecond, of which 8 are
/// the processor's. The others are estimates: 10⁹ triangles, 3·10¹⁰ texels and 10¹⁰ blended pixels a second. A display shows a frame
/// for 16 ms: half of one more is not seen.
constexpr RendererRates graphicsRates = {3e6, 0.016, 1e-6, 3e-8, 2e-7, 5e-8, 2e-6, 1e-7, 0.5};

/// Milliseconds of the processor in OpenSceneGraph, in Gnomon and in OpenGL's driver.
double processorTime(const ShadowWork& work, const RendererRates& rates);
/// Milliseconds of the renderer.
double rendererTime(const ShadowWork& work, const RendererRates& rates);
/// Both together. Where a processor draws it does one after the other. Beside a graphics processor a frame takes as long as the
/// slower of the two, but which one that is depends on the rest of the scene: the sum counts both alike.
double timeOf(const ShadowWork& work, const RendererRates& rates);

/// What a way to draw shadows is expected to come to.
struct ChoiceCandidate {
    bool usable = true;  ///< else the shadow would be wrong, or missing.
    double error = 0.0;  ///< pixels.
    double time = 0.0;   ///< milliseconds a frame.
    bool flawed = false; ///< has specks where no edge is: taken only if no other keeps the error.
};

enum class ChoiceReason {
    Cheapest,     ///< of those that keep the error.
    MoreAccurate, ///< than the cheapest of those that keep the error, and hardly dearer.
    Kept,         ///< it was chosen before, and keeps the error.
    ErrorTooSmall ///< none keeps the error: the most accurate.
};

/// A candidate by its place.
struct CandidateChoice {
    std::size_t index;
    ChoiceReason reason;
};

/// Candidates that take up to so many times what the cheapest takes are hardly dearer: the most accurate of them is chosen.
constexpr double hardlyDearer = 1.25;
/// The candidate that is drawn now is judged as if it took, and erred, so many times what it does: two that are much alike do not
/// take turns.
constexpr double favour = 0.9;

/// Chooses among those that keep the error; the same arguments give the same choice.
/// @param error   pixels, at most.
/// @param before  the one that is drawn now.
/// @param little  what takes so many milliseconds more than the cheapest is hardly dearer, too.
/// @return nullopt if none is usable.
std::optional<CandidateChoice> chooseCandidate(const std::vector<ChoiceCandidate>& candidates, double error,
                                               std::optional<std::size_t> before = {}, double little = 0.0);

} // namespace gnomon
