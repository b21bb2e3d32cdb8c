// SPDX-License-Identifier: MIT
#include <gnomon/choice/EdgeError.h>

#include <algorithm>
#include <cmath>

namespace gnomon {

double mapEdgeError(const EdgeFilter& filter, double pixelsATexel) {
    return std::hypot(filter.pixel, filter.spread * pixelsATexel);
}

/// Between two columns the drawn edge goes on level, or rises by a pixel. So above or below the true one it is off by any amount
/// between e and e - rise, or e and e + 1 - rise, with e at random: by more than a in (0.5 - a)^2 / (rise (1 - rise)) of its length.
/// The nearest place is nearer than that above or below, as if more of it were beyond: fitted to stripes.
double sampledEdgeOf(double rise) {
    constexpr double beyond = 0.05, ofNearest = 0.12;
    const double most = 0.5 - std::max(0.5 * beyond, std::sqrt(ofNearest * rise * (1.0 - rise)));
    return most / std::hypot(1.0, rise);
}

double missedEdgeError(double apart) {
    constexpr double spread = 1.5; // what is off by one distance, as what is off by any up to a limit
    return std::max(sampledEdge, spread * apart);
}

double polygonEdgeError(double pixelsOff) { return std::hypot(sampledEdge, pixelsOff); }

} // namespace gnomon
