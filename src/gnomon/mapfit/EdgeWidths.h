// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/mapfit/SeenEdges.h>

#include <vector>

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

    /// The width of edges that, if all had it, would be off like these: where each is off by any share of its own width
    /// alike, this share of all is off by no more than that share of the result. Pixels for one of the map's x/w and y/w.
    double usual(double share) const;

private:
    struct Edge {
        double width;  ///< pixels for one of the map's.
        double length; ///< in the picture.
    };

    glm::dmat4 _clipFromScene;
    glm::dvec2 _pixels;
    std::vector<Edge> _edges;
};

} // namespace gnomon
