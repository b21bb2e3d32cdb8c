// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

namespace gnomon {

/// How a light sees a scene: homogeneous (x, y, z, w), in which whatever lies on one ray has one place (x/w, y/w), and
/// depth z/w grows away from the light, linear on planes.
///
/// Of a sun x, y and z are in the scene's unit, w is 1. Of a lamp w is the distance along the axis, and depth -1/w.
struct LightFrame {
    glm::dmat4 lightFromScene{1.0};
    bool sun = true;
    std::vector<glm::dvec4> halfSpaces{}; ///< of the scene: what of it the frame can hold; none of a sun.
};

/// @param towardsSun  unit.
LightFrame sunFrame(const glm::dvec3& towardsSun);
/// What a lamp sees about `axis` (unit), up to `spread` times as far to either side as ahead.
LightFrame lampFrame(const glm::dvec3& lamp, const glm::dvec3& axis, double spread);

/// Half-space of the scene: what a lamp's frame has before a distance along its axis, or beyond it.
glm::dvec4 nearerThan(const LightFrame& frame, double distance);
glm::dvec4 fartherThan(const LightFrame& frame, double distance);

/// Corners, in the scene, of what of a box lies within all half-spaces of the scene, see cutBox(); empty if nothing does.
std::vector<glm::dvec4> cornersWithin(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                                      const std::vector<glm::dvec4>& halfSpaces);

/// Where boxes lie as a light sees them: a convex outline and the depths between the nearest and the farthest.
class MapOutline {
public:
    explicit MapOutline(LightFrame frame) : _frame(std::move(frame)) {}

    /// Adds what of a box lies within all half-spaces (of the scene, see cutBox()) and within the light's own.
    void addBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                const std::vector<glm::dvec4>& halfSpaces = {});

    bool empty() const { return corners.empty(); }
    /// True if whatever is behind the other outline, of the same frame, is behind this one.
    bool isBefore(const MapOutline& other) const;
    /// The longer side of the smallest rectangle about it, in x/w and y/w.
    double length() const;
    /// Half-spaces of the scene, the sides of the smallest rectangle about it: what is outside them has no place in it.
    std::vector<glm::dvec4> sides() const;
    /// The corners of all between nearest and farthest, homogeneous, in the scene.
    std::vector<glm::dvec4> body() const;
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
};

/// The smallest rectangle about an outline that is not empty, and more.
/// @param most     the rectangle reaches no further than this outline: what lies outside is known to be lit.
/// @param reserve  share of the sides by which it is larger on each, so that it holds for a while.
/// @param margin   share of its own sides that is left on each.
/// @param thick    the least range of depths, scene's unit, where it is farthest: nothing gets finer with less.
/// Source: H. Freeman and R. Shapira, "Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed Curve",
///         CACM 18(7), 1975: a side of it lies along an edge of the hull.
MapFit fitMap(const LightFrame& frame, const MapOutline& outline, const MapOutline& most, double reserve, double margin,
              double thick);

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
};

/// @param reach  half sides of the casters' bounds about the origin of the scene.
/// @param texels on a side.
MapErrors mapErrors(const LightFrame& frame, const MapFit& fit, const glm::dvec3& reach, int texels);

} // namespace gnomon
