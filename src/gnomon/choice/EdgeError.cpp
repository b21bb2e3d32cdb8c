// SPDX-License-Identifier: MIT
#include <gnomon/choice/EdgeError.h>

#include <cmath>

namespace gnomon {

double mapEdgeError(const EdgeFilter& filter, double pixelsATexel) {
    return std::hypot(filter.pixel, filter.spread * pixelsATexel);
}

double polygonEdgeError(double pixelsOff) { return std::hypot(sampledEdge, pixelsOff); }

} // namespace gnomon
