// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <metrics/TruthMaps.h>
#include <optional>
#include <vector>

namespace gnomon::metrics {

/// How far the edges of a shadow wander to and fro over frames, beyond what a picture of rays does.
///
/// A picture of one exact ray a pixel (T_c) crawls too, for its edges cannot lie within a pixel. So its crawl is the
/// floor.
///
/// Edges are sorted by direction: by the quarter of the plane that the slope of T_a, over 5 x 5 pixels of the same
/// receiver, points to. A quarter's offset in a frame is the area of shadow beyond the true one, over the true edges'
/// length. Each pixel is shadowed or not. A shadow that moves sideways therefore crawls as one that grows does.
///
/// Pixels that the truth leaves undecided, and pixels more than 2 px from a true edge, do not count.
///
/// Limits
/// - An edge that jumps by more than 2 px counts as one that jumps by 2. FlickerMeter::share() shows such jumps.
/// - Few frames or short edges leave noise: for edges of 200 px about 0.01 px.
class EdgeCrawl {
public:
    /// Adds the next frame. All grids have one size; V is finite in `facing`.
    ///
    /// @param visibility  V.
    /// @param truth       uses lit, litCentre, undecided and receiver.
    /// @param facing      R+.
    void add(const Picture& visibility, const TruthMaps& truth, const Mask& facing);

    /// The lesser of two, px; nullopt before two frames have an edge:
    /// - The root of the difference of the variances of V's offsets and of T_c's. It is about 0 for a steady edge that
    ///   lies beside the true one. Its pixels turn as often as those of rays, but in other frames.
    /// - The standard deviation of the difference of both offsets. It is 0 for an exact picture.
    std::optional<double> beyondRays() const;
    /// The standard deviation of T_c's offsets, px.
    std::optional<double> ofRays() const;

private:
    /// By direction.
    using Areas = std::array<double, 4>;
    struct Frame {
        Areas drawn{}, rays{}; ///< of shadow beyond the true one, px².
        Areas length{};        ///< of true edges, px.
    };

    template <typename AreaOf>
    double variance(AreaOf areaOf) const;

    std::vector<Frame> _frames;
};

} // namespace gnomon::metrics
