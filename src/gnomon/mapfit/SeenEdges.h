// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/mapfit/RayBins.h>

#include <glm/geometric.hpp>

#include <limits>
#include <vector>

namespace gnomon {

/// A place of a surface, in the scene.
struct SeenPlace {
    glm::dvec3 place;
    glm::dvec3 normal;    ///< of any length, towards the viewer.
    glm::dvec2 edge{0.0}; ///< which way the edge goes in the picture, normalised device coordinates; 0: any way.
    /// Pixels that the shadow, or a gap in it, is wide; infinite if that is more than two.
    double across = std::numeric_limits<double>::infinity();
    double apart = 0.0;  ///< of a thin one: pixels to the nearest other edge.
    double share = 1.0;  ///< of the outline that others stand for.
    bool folded = false; ///< The surface bends between the place and one beside it.
};

/// Where edges of shadows are seen: at the cells of a grid over the picture beside which the same surface is lit on one hand
/// and dark on the other. Receivers and casters are triangles, or their boxes where that is enough. A box about the eye, a room
/// for one, is seen from inside, and casts nothing on what is in it.
///
/// Cost  of triangles see RayBins, twice for the grid and twice for the pixels about thin shadows.
class SeenEdges {
public:
    struct Box {
        glm::dvec3 low, high;
    };

    /// @param clipFromScene  of the view. @param within  what of the picture the grid covers.
    /// @param light          in the scene: w = 0, or w = 1.
    SeenEdges(const glm::dmat4& clipFromScene, const ScreenRect& within, const glm::dvec4& light);

    /// What a box that is flat, as that of hills is, counts as.
    enum class Relief {
        HalfWay, ///< its middle level: where most of it is.
        Whole,   ///< its sides, nearer to the viewer than most of it.
    };
    void addReceiver(const Box& box, const glm::dmat4& sceneFromBox, Relief relief = Relief::HalfWay);
    /// Triangles, once and last.
    using Meshes = std::vector<PlacedTriangles>;
    void addReceivers(const Meshes& meshes);

    /// Boxes of the scene, after all receivers. They darken what is seen within a map: x/w and y/w are 0 to 1 there.
    void addCasters(const std::vector<Box>& boxes, const glm::dmat4& mapFromScene);
    /// Triangles, once. @param pixels  of the view, across and up.
    void addCasters(const Meshes& meshes, const std::vector<glm::dmat4>& mapsFromScene, const glm::dvec2& pixels);

    /// The places on either side of each edge.
    std::vector<SeenPlace> edges() const;

    /// All places that face the light.
    std::vector<SeenPlace> facing() const;

private:
    static constexpr int columns = 64, rows = 48;
    struct Cell {
        glm::dvec2 at;                                          ///< in the grid, 0 to 1.
        glm::dvec3 from, way;                                   ///< of the line of sight.
        double reach = std::numeric_limits<double>::infinity(); ///< to what is seen, in lengths of `way`.
        glm::dvec3 normal{0.0};
        int side = -1; ///< of the boxes and objects that receive.
        bool dark = false;
        bool left = false; ///< out: a pixel beside it shows something else.
        double across = std::numeric_limits<double>::infinity(), apart = 0.0, share = 1.0; ///< see SeenPlace.

        SeenPlace place() const { return {from + reach * way, normal}; }
        bool isInGrid() const { return at.x >= 0.0 && at.y >= 0.0 && at.x < 1.0 && at.y < 1.0; }
        double least() const { return 1e-6 * reach * glm::length(way); } ///< what is as near is the surface itself.
    };
    void look(const Meshes& meshes, std::vector<Cell>& cells) const;
    void darken(std::vector<Cell>& cells, const Meshes& meshes, const std::vector<glm::dmat4>& mapsFromScene) const;
    void narrow(const Meshes& meshes, const std::vector<glm::dmat4>& mapsFromScene, const glm::dvec2& pixels);
    Cell cellAt(const glm::dvec2& inGrid) const;
    glm::dvec2 pixelOf(const glm::dvec2& pixels) const;
    static double reachOf(const Cell& cell, const Cell& plane);
    bool isOfMesh(const Cell& cell) const { return cell.side >= _firstOfMeshes; }
    const Cell& at(int column, int row) const { return _cells[std::size_t(row) * columns + column]; }
    bool faces(const Cell& cell) const;
    bool isEdgeTo(const Cell& cell, int right, int up) const;
    int edgesBeside(const Cell& cell) const;
    bool isAlone(const Cell& cell) const;
    bool isThin(const Cell& cell) const { return cell.across <= 1.0 && edgesBeside(cell) > 0; }
    void weighThin(const glm::dvec2& pixel);
    bool bends(const Cell& one, const Cell& other) const;
    bool isEdge(const Cell& one, const Cell& other) const;
    glm::dvec2 wayAt(int column, int row) const;

    glm::dmat4 _clipFromScene, _sceneFromClip;
    ScreenRect _within;
    glm::dvec4 _light;
    std::vector<Cell> _cells; ///< row by row.
    int _sides = 0, _firstOfMeshes = std::numeric_limits<int>::max();
};

} // namespace gnomon
