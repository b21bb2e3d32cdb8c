// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <vector>

namespace gnomon {

/// A mesh of others, at a place in the scene.
struct PlacedTriangles {
    const glm::vec3* corners;
    std::size_t cornerCount;
    const unsigned* indices; ///< three a triangle.
    std::size_t count;       ///< of the triangles.
    glm::dmat4 sceneFromMesh;
    std::vector<std::size_t> parts; ///< the first triangle of each object, ascending.
    std::vector<bool> oneSided{};   ///< of each object: the back of its triangles is not drawn; empty: of none.
};

/// Some thousand rays that are points in a picture, so that a triangle is tested only with those that may meet it. It is for
/// a look at casters that are seen once: a tree over them would take longer to make.
///
/// Cost  some 50 ns a triangle, and as much for each ray in its rectangle.
class RayBins {
public:
    /// In the scene.
    struct Ray {
        glm::dvec3 from, way;
        glm::dvec2 at; ///< in the picture; rays outside 0 to 1 meet nothing.
    };

    /// @param pictureFromScene  homogeneous; takes all that a ray meets to the ray's point.
    RayBins(const glm::dmat4& pictureFromScene, std::vector<Ray> rays);

    /// A ray on a surface.
    struct Met {
        std::size_t ray;
        std::size_t side;     ///< number of the triangle; of a box twice the axis, and 1 for its far end.
        double reach;         ///< in lengths of the ray's way; below 0 behind its start.
        glm::dvec3 normal;    ///< of any length, to either side.
        bool inside = false;  ///< of a box: the ray starts in it.
        double through = 0.0; ///< of a box: the reach of its far side.
    };
    using Hit = std::function<void(const Met&)>;
    /// Calls `hit` for each ray and each triangle that it meets.
    void meet(const PlacedTriangles& triangles, const Hit& hit) const;
    /// Calls `hit` for each ray that meets the box: where it goes in, or out, if it starts inside.
    void meet(const PlacedBox& box, const Hit& hit) const;

private:
    static constexpr int side = 64; ///< of the picture, in bins.
    static int binOf(double at);
    template <class Visit>
    void eachIn(const ScreenRect& rect, const Visit& visit) const;

    glm::dmat4 _pictureFromScene, _clipFromScene; ///< the second: of the picture's rectangle.
    std::vector<Ray> _rays;
    std::vector<std::vector<std::size_t>> _bins; ///< numbers of the rays, row by row.
};

/// A place of a surface, in the scene.
struct SeenPlace {
    glm::dvec3 place;
    glm::dvec3 normal;    ///< of any length, towards the viewer.
    glm::dvec2 edge{0.0}; ///< which way the edge goes in the picture, normalised device coordinates; 0: any way.
    /// Pixels that the shadow, or a gap in it, is wide; infinite if that is more than some.
    double across = std::numeric_limits<double>::infinity();
    double share = 1.0;  ///< of the outline that others stand for.
    bool folded = false; ///< The surface bends between the place and one beside it.
};

/// A place of a shadow, with shadow of the same surface a pixel and a half about it, that nearly touches what casts it: under a bowl
/// on its table, say. A map compares by its texels, and lets light through there where they are larger.
struct Contact {
    glm::dvec3 place, way; ///< in the scene; to the light, of any length.
    double texel = 0.0;    ///< side of the largest that keeps the shadow, scene's unit.
};

/// Where edges of shadows are seen: at the cells of a grid over the picture beside which the same surface is lit on one hand
/// and dark on the other. Receivers and casters are triangles, or their boxes where that is enough. A box about the eye, a room
/// for one, is seen from inside, and casts nothing on what is in it.
///
/// Shadows and gaps that are narrower than a cell are met as seldom as they are narrow. Each that is met counts for those that
/// are not.
///
/// Cost  of triangles see RayBins, twice for the grid and twice for the pixels about narrow shadows.
class SeenEdges {
public:
    /// @param clipFromScene  of the view. @param pixels  of the view, across and up.
    /// @param within         what of the picture the grid covers.
    /// @param light          in the scene: w = 0, or w = 1.
    SeenEdges(const glm::dmat4& clipFromScene, const glm::dvec2& pixels, const ScreenRect& within,
              const glm::dvec4& light);

    /// What a box that is flat, as that of hills is, counts as.
    enum class Relief {
        HalfWay, ///< its middle level: where most of it is.
        Whole,   ///< its sides, nearer to the viewer than most of it.
    };
    void addReceiver(const PlacedBox& box, Relief relief = Relief::HalfWay);
    void addCaster(const PlacedBox& box) { _casters.push_back(box); }
    /// They receive and cast.
    void addMesh(const PlacedTriangles& mesh) { _meshes.push_back(mesh); }
    /// Places within it may be dark: x/w and y/w are 0 to 1 there.
    void addMap(const glm::dmat4& mapFromScene) { _maps.push_back(mapFromScene); }

    /// The places on either side of each edge.
    /// @param contacts  where not null, places at cells of the grid where light may leak.
    std::vector<SeenPlace> edges(std::vector<Contact>* contacts = nullptr) const;
    /// All places that face the light.
    std::vector<SeenPlace> facing() const;

    static constexpr int columns = 64, rows = 48; ///< of the grid.

private:
    struct Cell {
        glm::dvec2 at;                                          ///< in the grid, 0 to 1.
        glm::dvec3 from, way;                                   ///< of the line of sight.
        double reach = std::numeric_limits<double>::infinity(); ///< to what is seen, in lengths of `way`.
        glm::dvec3 normal{0.0};
        int side = -1; ///< of the boxes and objects that receive.
        bool dark = false;
        bool left = false; ///< out: a pixel beside it shows something else.
        double across = std::numeric_limits<double>::infinity(), share = 1.0; ///< see SeenPlace.
        double texel = 0.0;                                                   ///< see Contact; of what is dark.

        SeenPlace place() const { return {from + reach * way, normal}; }
        double least() const { return 1e-6 * reach * glm::length(way); } ///< what is as near is the surface itself.
    };
    using Cells = std::vector<Cell>; ///< of the grid: row by row.
    Cell cellAt(const glm::dvec2& inGrid) const;
    Cells grid() const;
    void look(Cells& cells) const;
    void darken(Cells& cells) const;
    void narrow(Cells& cells) const;
    void weighNarrow(Cells& cells) const;
    std::vector<Contact> contactsOf(const Cells& cells) const;
    static double reachOf(const Cell& cell, const Cell& plane);
    bool faces(const Cell& cell) const;
    bool bends(const Cell& one, const Cell& other) const;
    bool isEdge(const Cell& one, const Cell& other) const;
    bool isEdgeTo(const Cells& cells, std::size_t index, int right, int up) const;
    glm::dvec2 wayAt(const Cells& cells, int column, int row) const;

    glm::dmat4 _clipFromScene, _sceneFromClip;
    glm::dvec2 _pixel; ///< in the grid.
    ScreenRect _within;
    glm::dvec4 _light;
    std::vector<PlacedBox> _receivers, _casters;
    std::vector<PlacedTriangles> _meshes;
    std::vector<glm::dmat4> _maps;
};

/// How far edges are off in the picture if they are off in a map: edges in all directions, spread evenly over what is seen.
class EdgeWidths {
public:
    /// @param clipFromScene  of the view. @param pixels  of the view, across and up.
    EdgeWidths(const glm::dmat4& clipFromScene, const glm::dvec2& pixels);

    /// Edges at a place, looked up in a map.
    /// @param mapFromScene  homogeneous, x/w and y/w of the map.
    void add(const SeenPlace& place, const glm::dmat4& mapFromScene);

    bool empty() const { return _edges.empty(); }

    /// A place that stands for so many pixels of a shadow, looked up in a map.
    void addContact(const Contact& contact, double pixels, const glm::dmat4& mapFromScene);
    /// Pixels across, if they were one, of the places that let light through in a map of so many texels on its side.
    double leak(double texels) const;

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
    std::multimap<double, double> _contacts;   ///< pixels that leak in a map of fewer texels on its side.
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
