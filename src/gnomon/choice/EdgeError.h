// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// How texels are compared, as ShadowMapOptions::Filter and its edges have it.
struct EdgeFilter {
    double spread;   ///< share of a texel within which 95 % of the edges stay.
    double pixel;    ///< the same of a pixel, where texels are so small that they do not count.
    double gaps;     ///< pixels that edges are off whose shadow, or the gap between two, is half a pixel to one wide.
    double compared; ///< comparisons of 2 × 2 texels a pixel.
};

/// One ray or one fragment a pixel decides: 95 % of such edges are within so many pixels of the true one.
constexpr double sampledEdge = 0.40;

/// The same of edges that rise by so much of a pixel from one pixel to the next, 0 to 1: along a row of pixels or a column an edge
/// is off by half a pixel at most, whatever its place; others are off by less, as pixels decide in turn to either side.
double sampledEdgeOf(double rise);

/// The same as EdgeFilter::gaps.
constexpr double sampledGaps = 3.0;

/// Where a shadow is no wider than this, it covers less than half of each pixel.
constexpr double halfCovered = 0.5; // pixels

/// The same of edges of shadows at most so wide: they have no outline, but some pixels are met. These are off by as much as the
/// nearest outline is apart.
/// @param apart  pixels to the nearest edge of a wider shadow.
double missedEdgeError(double apart);

/// 95th percentile of the distance between an edge looked up in a map and the true one, pixels.
/// @param pixelsATexel  on a side of a texel, where it is widest on the screen.
double mapEdgeError(const EdgeFilter& filter, double pixelsATexel);

/// The same of edges that are drawn as polygons whose place is off by up to so many pixels.
double polygonEdgeError(double pixelsOff);

} // namespace gnomon
