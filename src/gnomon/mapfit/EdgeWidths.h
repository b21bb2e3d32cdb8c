// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/mapfit/SeenEdges.h>

#include <array>
#include <functional>
#include <map>

namespace gnomon {

/// How far edges are off in the picture if they are off in a map: edges in all directions, spread evenly over what is seen.
class EdgeWidths {
public:
    /// @param clipFromScene  of the view. @param pixels  of the view, across and up.
    EdgeWidths(const glm::dmat4& clipFromScene, const glm::dvec2& pixels);

    /// Edges at a place, looked up in a map.
    /// @param mapFromScene  homogeneous, x/w and y/w of the map.
    void add(const SeenPlace& place, const glm::dmat4& mapFromScene);

    bool empty() const { return _edges.empty(); }

    /// Edges that are much alike.
    struct Edge {
        double width = 0.0;   ///< pixels for one of the map's x/w and y/w.
        double length = 0.0;  ///< in the picture.
        double across = 0.0;  ///< see SeenPlace.
        double rise = 0.0;    ///< from one pixel to the next, along a row or a column, 0 to 1.
        bool folded = false;  ///< see SeenPlace.
        bool slanted = false; ///< Pixels are so long on the surface that map.frag takes them for shorter.
    };

    /// Pixels that edges of a kind are off, at most.
    using Off = std::function<double(const Edge&)>;
    /// How far edges are off that, if all had it, would be off like these: where each is off by any share of `off` alike, this
    /// share of all is off by no more than that share of the result.
    double usual(double share, const Off& off) const;

private:
    void addEdge(const Edge& edge);
    glm::dmat2 facing(const glm::dvec4& clip, const glm::dmat4& mapFromScene) const;

    glm::dmat4 _clipFromScene, _sceneFromClip;
    glm::dvec2 _pixels;
    std::map<std::array<int, 5>, Edge> _edges; ///< by what they are like.
};

/// How texels are compared, as ShadowMapOptions::Filter and its edges have it.
struct EdgeFilter {
    double spread;   ///< share of a texel within which 95 % of the edges stay.
    double pixel;    ///< the same of a pixel, where texels are so small that they do not count.
    double compared; ///< comparisons of 2 × 2 texels a pixel.
    bool mean;       ///< what falls into a pixel is averaged; else one place of it decides.
};

/// One ray or one fragment a pixel decides: 95 % of such edges are within so many pixels of the true one.
constexpr double sampledEdge = 0.40;

/// The same of edges that rise by so much of a pixel from one pixel to the next, 0 to 1: along a row of pixels or a column an edge
/// is off by half a pixel at most, whatever its place; others are off by less, as pixels decide in turn to either side.
double sampledEdgeOf(double rise);

/// Pixels that an edge is off where one place a pixel decides. A shadow, or a gap in one, that is narrower than a pixel is lost
/// here and there, and as wide as a pixel elsewhere: it is off by a pixel.
double sampledError(const EdgeWidths::Edge& edge);

/// The same of an edge that is looked up in a map. What is narrower than a texel is lost, or as wide as a texel. So no map keeps
/// what one place a pixel loses, unless it averages, and its texels are finer.
/// @param texels  on the map's side.
double mapError(const EdgeWidths::Edge& edge, const EdgeFilter& filter, double texels);

/// The same where nothing is known of the edges. @param pixelsATexel  on a side of a texel, where it is widest on the screen.
double mapError(const EdgeFilter& filter, double pixelsATexel);

/// The same of edges that are drawn as polygons whose place is off by up to so many pixels.
double polygonError(double pixelsOff);

} // namespace gnomon
