// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {

/// A box at a place in the scene.
struct PlacedBox {
    PlacedBox(const glm::dvec3& lowest, const glm::dvec3& highest, const glm::dmat4& toScene = glm::dmat4(1.0));

    glm::dvec3 low, high;
    glm::dmat4 sceneFromBox;
    glm::dvec3 middle; ///< in the scene.
    double radius;     ///< of a ball about it that holds the box; infinite if sceneFromBox has a perspective.
};

/// Half-spaces of the scene, each a row: what is within has 0 or more in all of them. See cutBox().
using HalfSpaces = std::vector<glm::dvec4>;
/// Those of both.
HalfSpaces both(HalfSpaces some, const HalfSpaces& others);

/// Corners, in the scene, of what of a box lies within all half-spaces, see cutBox(); empty if nothing does.
std::vector<glm::dvec4> cornersWithin(const PlacedBox& box, const HalfSpaces& halfSpaces);

/// The axis along which a box is flat, as grounds are: in the scene its shortest side is an eighth of the next, or less.
/// Nullopt for other boxes.
std::optional<int> flatAxis(const PlacedBox& box);

/// How a light sees a scene: homogeneous (x, y, z, w), in which whatever lies on one ray has one place (x/w, y/w), and
/// depth z/w grows away from the light, linear on planes.
///
/// Of a sun x, y and z are in the scene's unit, w is 1. Of a lamp w is the distance along the axis, and depth -1/w.
struct LightFrame {
    glm::dmat4 lightFromScene{1.0};
    bool isParallel = true;  ///< a sun, or a lamp so far off that its rays are as those of one.
    HalfSpaces halfSpaces{}; ///< what of the scene the frame can hold; none of a sun.
};

/// @param towardsSun  unit.
LightFrame sunFrame(const glm::dvec3& towardsSun);
/// What a lamp sees about `axis` (unit), up to `spread` times as far to either side as ahead.
LightFrame lampFrame(const glm::dvec3& lamp, const glm::dvec3& axis, double spread);

/// Half-space of the scene: what a lamp's frame has before a distance along its axis, or beyond it.
glm::dvec4 nearerThan(const LightFrame& frame, double distance);
glm::dvec4 fartherThan(const LightFrame& frame, double distance);

/// Where boxes lie as a light sees them: a convex outline and the depths between the nearest and the farthest.
class MapOutline {
public:
    explicit MapOutline(LightFrame frame) : _frame(std::move(frame)) {}

    /// Adds what of a box lies within all half-spaces and within the light's own.
    void addBox(const PlacedBox& box, const HalfSpaces& halfSpaces = {});

    bool empty() const { return corners.empty(); }
    /// True if whatever is behind the other outline, of the same frame, is behind this one.
    bool isBefore(const MapOutline& other) const;
    /// The longer side of the smallest rectangle about it, in x/w and y/w.
    double length() const;
    /// Half-spaces of the scene, the sides of the smallest rectangle about it: what is outside them has no place in it.
    HalfSpaces sides() const;
    /// The corners of all between nearest and farthest, homogeneous, in the scene.
    std::vector<glm::dvec4> corners3D() const;
    /// Becomes the convex outline of both, of the same frame.
    void merge(const MapOutline& other);
    /// Cuts this outline to the other one, of the same frame; depths stay. One that is all on a line cuts nothing.
    void cut(const MapOutline& other);
    /// Of a lamp: what is nearer than the farthest divided by `ratio` counts as if it were there, for depths of a map get
    /// coarse by what is near.
    void limitNearest(double ratio);
    /// Distance along a lamp's axis at which this is best divided between two maps, a power of 2, so that it seldom
    /// changes. 0: one map holds all well.
    double split() const;
    /// Grows to all sides, in x/w and y/w.
    void grow(double by);

    std::vector<glm::dvec2> corners; ///< counter-clockwise.
    double nearest = 0.0, farthest = 0.0;

private:
    bool surrounds(const glm::dvec2& at) const;
    bool covers(const glm::dvec4& inLight) const;
    bool coversAll(const PlacedBox& box) const;
    bool coversBall(const PlacedBox& box) const;

    LightFrame _frame;
};

/// A map: a rectangle of a light's outlines, turned at will, and a range of depths.
struct MapFit {
    glm::dmat4 mapFromLight{1.0}; ///< x, y and z of the rectangle 0 … 1, homogeneous.
    glm::dmat4 mapFromScene{1.0}; ///< the same of the scene's places.
    glm::dvec2 size{0.0};         ///< sides of the rectangle, in the light's x/w and y/w.
    double nearest = 0.0, farthest = 0.0;

    /// True if the outline, of the same frame, is `margin` (share of the sides) within the rectangle, and its depths
    /// within the range.
    bool covers(const MapOutline& outline, double margin) const;
    double area() const { return size.x * size.y; }
    double longer() const { return std::max(size.x, size.y); }
};

/// How much larger than what it must hold a map is.
struct MapRoom {
    double reserve; ///< share of the sides by which it is larger on each, so that it holds for a while.
    double margin;  ///< share of its own sides that is left on each.
    double thick;   ///< the least range of depths, scene's unit, where it is farthest: nothing gets finer with less.
};

/// The smallest rectangle about an outline that is not empty, and more.
/// @param most  the rectangle reaches no further than this outline: what lies outside is known to be lit.
/// Source: H. Freeman and R. Shapira, "Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed Curve",
///         CACM 18(7), 1975: a side of it lies along an edge of the hull.
MapFit fitMap(const LightFrame& frame, const MapOutline& outline, const MapOutline& most, const MapRoom& room);

/// The same map moved by whole texels, so that an outline that is not empty lies in its middle, and with the outline's depths.
/// Texels stay where they are in the scene, and shadows' edges with them. Whether it covers the outline is not asked.
/// @param frame, thick  as fitMap() had them. @param texels  on a side.
MapFit slidMap(MapFit fit, const LightFrame& frame, const MapOutline& outline, double thick, int texels);

/// How far from a place of an outline, in x/w and y/w, what softens an edge there can be.
/// @param nearest, farthest  depths between which shadows are cast, see MapOutline.
/// @param lightRadius  half the size of the light: of a sun the tangent of half the angle that it is seen under, of a lamp
///                     half its diameter, scene's unit; 0 is a point.
/// @param radius       of a disc about each place that is averaged, scene's unit.
double softReach(const LightFrame& frame, double nearest, double farthest, double lightRadius, double radius);

/// How wide soft edges are in a map, in texels along its sides.
struct MapSpread {
    glm::dvec2 penumbra{0.0}; ///< half of it, for each unit of depth between what casts a shadow and where it falls.
    glm::dvec2 nearest{0.0}, farthest{0.0}; ///< a disc's radius about a place at these depths.
};
/// @param lightRadius, radius  see softReach().
/// @param texels               on a side.
/// Source: R. Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH 2005 sketches: a penumbra by similar triangles; a lamp's
///         is linear in the map's depth, too, for that is -1/w.
MapSpread mapSpread(const LightFrame& frame, const MapFit& fit, double lightRadius, double radius, int texels);

/// How far off a map's depths and places may be, and what its comparison must allow for.
struct MapError {
    double depth = 0.0;    ///< in the map's depth.
    double texels = 0.0;   ///< in its texels, on either axis.
    double steepest = 0.0; ///< change of depth a texel from which on a surface counts as edge-on.
};

/// At a map's nearest and farthest depth, with linear change between.
struct MapErrors {
    MapError nearest, farthest;

    /// How many texels long, along the light, the depth may be off where that is the least.
    double texelsOff() const;
};

/// @param reach  half sides of the casters' bounds about the origin of the scene.
/// @param texels on a side.
MapErrors mapErrors(const LightFrame& frame, const MapFit& fit, const glm::dvec3& reach, int texels);

/// How small the smallest pixel is on what is seen, as a light sees it: a map with finer texels than that tells nothing
/// more.
class TexelDensity {
public:
    /// @param clipFromScene  of the view. @param pixels  of the view, across and up.
    TexelDensity(const LightFrame& frame, const glm::dmat4& clipFromScene, const glm::dvec2& pixels);

    /// Adds what of a box lies within all half-spaces and within the light's own. A texel is stretched on what is turned away
    /// from the light: on a box that is flat, as grounds are, by its slope, up to eight times; on others twice, as on what is
    /// turned away by 60 degrees.
    void addBox(const PlacedBox& box, const HalfSpaces& halfSpaces);

    /// Side of the largest texel that is no larger than a pixel anywhere, in the light's x/w and y/w; infinite as long as
    /// nothing is seen, 0 where it can be seen from next to it.
    double side = std::numeric_limits<double>::infinity();

private:
    glm::dvec4 inLight(const glm::dvec4& place) const;
    double unstretched(const glm::dvec4& place) const;
    double stretch(const glm::dvec3& normal, const glm::dvec4& place) const;

    LightFrame _frame;
    glm::dvec4 _pixel;  ///< row: side of a pixel at a place.
    double _pixelAUnit; ///< how much that is larger a unit on, at most.
};

/// Texels on a map's side: hardly more than are of use, in steps, so that they seldom change.
/// @param wanted  how many would be.
/// @param most    at most.
/// @param before  how many there were; they stay while they are enough and not twice too many. 0: none.
int texelsFor(double wanted, int most, int before);

/// How near and how far what is seen lies along the line of sight: clip space's w. Of an orthographic view all is 1.
class SeenRange {
public:
    /// @param clipFromScene  of the view.
    explicit SeenRange(const glm::dmat4& clipFromScene);

    /// Adds what of a box lies within all half-spaces.
    void addBox(const PlacedBox& box, const HalfSpaces& halfSpaces);

    bool empty() const { return !(nearest <= farthest); }

    double nearest = std::numeric_limits<double>::infinity(), farthest = -std::numeric_limits<double>::infinity();

private:
    glm::dvec4 _w;  ///< row of the matrix.
    double _wAUnit; ///< how much that is larger a unit on, at most.
};

constexpr int mostCascades = 4;

/// How many maps are worth while, 1 … mostCascades: so that where each part begins a texel of its map is at most three pixels
/// wide. That is where it is widest; of all edges 95 % are then within about a pixel, in a street of 2 km as on mountains, and
/// walls that the light grazes are dark beside what stands before them, within ten texels of it.
/// @param pixels  on a side of a texel, at the farthest that is seen, if there is one map.
/// @param before  how many there were, 0 … mostCascades; they stay where another count would hardly be better.
int cascadesFor(const SeenRange& seen, double pixels, int before);

/// Distances at which what is seen is divided among maps, nearest first: each part is as many times as far at its end as
/// at its beginning. A map's texels grow with the end of its part, and pixels are smallest at its beginning, so that the
/// most texels a pixel are then the least. A part whose end is less than twice as far as its beginning is not worth a map.
/// @param most  maps, at least 1.
/// @return one less than the maps that are of use; none where nothing is seen.
/// Source: F. Zhang et al., "Parallel-Split Shadow Maps for Large-Scale Virtual Environments", VRCIA 2006: its
///         logarithmic scheme, between what is seen nearest and farthest instead of the near and far planes.
std::vector<double> cascadeSplits(const SeenRange& seen, int most);

/// Half-spaces of the scene that hold a part of the view: its sides, and the splits before and behind it; near and far
/// planes of the view at the ends.
/// @param part  0 … splits.size().
HalfSpaces viewPart(const glm::dmat4& clipFromScene, const std::vector<double>& splits, std::size_t part);

/// What a spot lights: all about a way from where it stands.
struct SpotCone {
    glm::dvec3 axis{0.0, 0.0, -1.0}; ///< unit.
    double cutoff = 0.0;             ///< from the axis to the cone's side, radians, 0 … π/2.

    bool operator==(const SpotCone& other) const { return axis == other.axis && cutoff == other.cutoff; }
};

/// Takes points of the scene (w of 1, or more than 0) to where the cone stands at the origin: within it is what has a z of
/// 0 or more, and x² + y² of z² or less.
glm::dmat4 coneFromScene(const glm::dvec3& apex, const SpotCone& cone);

} // namespace gnomon
