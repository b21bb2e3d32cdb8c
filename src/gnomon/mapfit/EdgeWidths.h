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
        double apart = 0.0;   ///< see SeenPlace.
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
    std::map<std::array<int, 6>, Edge> _edges; ///< by what they are like.
};

} // namespace gnomon
