// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>

#include <limits>
#include <vector>

namespace gnomon {

/// A place of a surface, in the scene.
struct SeenPlace {
    glm::dvec3 place;
    glm::dvec3 normal;    ///< of any length, towards the viewer.
    glm::dvec2 edge{0.0}; ///< which way the edge goes in the picture, normalised device coordinates; 0: any way.
};

/// Where edges of shadows are seen, if receivers and casters are their boxes: at the cells of a grid over the picture beside
/// which the same side of a box is lit on one hand and dark on the other. A box about the eye, a room for one, is seen from
/// inside, and casts nothing on what is in it.
class SeenEdges {
public:
    struct Box {
        glm::dvec3 low, high;
    };

    /// @param clipFromScene  of the view. @param within  what of the picture the grid covers.
    /// @param light          in the scene: w = 0, or w = 1.
    SeenEdges(const glm::dmat4& clipFromScene, const ScreenRect& within, const glm::dvec4& light);

    /// One that is flat, as hills are, counts as the level half-way up.
    void addReceiver(const Box& box, const glm::dmat4& sceneFromBox);

    /// Boxes of the scene, after all receivers. They darken what is seen within a map: x/w and y/w are 0 to 1 there.
    void addCasters(const std::vector<Box>& boxes, const glm::dmat4& mapFromScene);

    /// The places on either side of each edge.
    std::vector<SeenPlace> edges() const;

    /// All places that face the light.
    std::vector<SeenPlace> facing() const;

private:
    static constexpr int columns = 64, rows = 48;
    struct Cell {
        glm::dvec3 from, way;
        double reach = std::numeric_limits<double>::infinity(); ///< to the nearest box, in lengths of `way`.
        glm::dvec3 normal{0.0};
        int side = -1; ///< of the boxes that receive.
        bool dark = false;

        SeenPlace place() const { return {from + reach * way, normal, {}}; }
    };
    bool faces(const Cell& cell) const;
    bool isEdge(const Cell& one, const Cell& other) const;
    glm::dvec2 wayAt(int column, int row) const;

    glm::dmat4 _clipFromScene;
    ScreenRect _within;
    glm::dvec4 _light;
    std::vector<Cell> _cells; ///< row by row.
    int _receivers = 0;
};

} // namespace gnomon
