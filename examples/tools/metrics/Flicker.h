// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <metrics/PixelSets.h>

#include <array>
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

/// One frame of a sequence. All frames and grids have one size.
struct FlickerFrame {
    Picture visibility;            ///< V.
    TruthMaps truth;               ///< Uses lit, litCentre, undecided, receiver and position. A surface point must keep
                                   ///< its position, even if the object moves.
    Mask facing;                   ///< R+.
    glm::dmat4 clipFromPosition{}; ///< The camera, as OpenGL's projection * modelview.
};

/// Two frames in turn, and the change that the truth does not have.
struct FlickerChange {
    Picture before; ///< V of the first frame.
    Picture after;  ///< V of the second frame.
    Picture beyond; ///< e, see FlickerMeter; 0 where it is not known.
};

/// M7: flicker, the change between frames that the truth does not have.
///
/// Add the frames in order. The meter keeps only the last one.
///
///     e(p) = max(0, |V_k(p) - V_{k-1}(p')| - max over 3 x 3 of |T_k - T_{k-1}|)
///
/// p' is the same surface point one frame before, fetched bilinearly. It is known if all fetched pixels were R+ of
/// the same receiver. Pixels that the truth leaves undecided are left out, in both frames. The change of T is the
/// greater one of T_a and T_c. A perfect picture therefore has no flicker, whether its edges are smooth or hard.
class FlickerMeter {
public:
    /// Adds the next frame.
    void add(FlickerFrame frame);

    /// Number of frames added.
    std::size_t frames() const { return _frames; }
    /// Mean e, 0 or more. nullopt before two frames share a point.
    std::optional<double> energy() const;
    /// Share of the pixels of R+ with e > 0.25, over all frames but the first.
    std::optional<double> share() const;
    /// Edge crawl: standard deviation over frames of M4's signed mean, px. nullopt before two frames have a boundary.
    std::optional<double> crawl() const;
    /// Edge crawl beyond that of a picture of rays, px. See EdgeCrawl.
    std::optional<double> crawlBeyondRays() const { return _edges.beyondRays(); }
    /// Edge crawl of a picture of one exact ray a pixel, px.
    std::optional<double> rayCrawl() const { return _edges.ofRays(); }
    /// The two frames between which the sum of e is largest. Empty pictures if e is 0 everywhere.
    const FlickerChange& worst() const { return _worst; }

private:
    void compare(const FlickerFrame& frame);

    FlickerFrame _last;
    FlickerChange _worst;
    std::size_t _frames = 0, _facing = 0, _known = 0, _flickering = 0;
    double _sum = 0.0, _worstSum = 0.0;
    std::vector<double> _offsets; // M4's signed mean
    EdgeCrawl _edges;
};

} // namespace gnomon::metrics
