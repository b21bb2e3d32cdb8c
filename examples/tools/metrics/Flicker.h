// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <metrics/EdgeCrawl.h>
#include <optional>
#include <vector>

namespace gnomon::metrics {

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
