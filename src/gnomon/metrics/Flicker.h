// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <gnomon/metrics/TruthMaps.h>
#include <optional>

namespace gnomon::metrics {

/// One frame of a sequence. All of one size.
struct FlickerFrame {
    Picture visibility;            ///< V
    TruthMaps truth;               ///< lit, litCentre, receiver and position are used. Positions are in a frame that
                                   ///< moves with the scene: a point of a surface keeps its own.
    Mask facing;                   ///< R+
    glm::dmat4 clipFromPosition{}; ///< the camera, as OpenGL's projection * modelview
};

/// M7: what changes from frame to frame though it should not. Give it frames in order; it keeps the last one only.
///
/// e(p) = max(0, |V_k(p) - V_{k-1}(p')| - max over 3 x 3 of |T_k - T_{k-1}|), where p' is the same point of the surface
/// one frame before, fetched bilinearly; known where all fetched pixels were R+ of the same receiver. T's change is the
/// greater of T_a's and T_c's, so that a perfect picture is still whether its edges are smooth or hard.
class FlickerMeter {
public:
    void add(FlickerFrame frame);

    std::size_t frames() const { return _frames; }
    /// Mean e, 0 to 1 and above; nullopt before two frames share a point.
    std::optional<double> energy() const;
    /// Share of R+ (of all frames but the first) with e > 0.25.
    std::optional<double> share() const;
    /// Standard deviation over frames of M4's signed mean, px; nullopt before two frames have a boundary.
    std::optional<double> crawl() const;

private:
    void compare(const FlickerFrame& frame);

    FlickerFrame _last;
    std::size_t _frames = 0, _facing = 0, _known = 0, _flickering = 0;
    double _sum = 0.0;
    std::vector<double> _offsets;
};

} // namespace gnomon::metrics
