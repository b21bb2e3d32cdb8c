// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenRect.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon {

/// The eight corners of a box, homogeneous, in another frame: low and high x in turn, then y, then z.
std::array<glm::dvec4, 8> boxCorners(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& frameFromBox);

/// Corners of the convex body that is left of a box [low, high] after cutting it by half-spaces
/// (a point is kept where dot(halfSpace, (x, y, z, 1)) >= 0). A superset of its corners within the body is allowed.
/// Empty if nothing is left, low > high anywhere, or anything is not finite. A half-space (0, 0, 0, c) keeps all or
/// nothing. Source: I. Sutherland and G. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974, a face at a time.
std::vector<glm::dvec3> cutBox(const glm::dvec3& low, const glm::dvec3& high,
                               const std::vector<glm::dvec4>& halfSpaces);

/// Bounds, on the screen, of the convex hull of homogeneous points in clip space, as far as it lies in front of the
/// eye (clip w > 0). Conservative: never smaller than what is drawn, also where the hull passes behind the eye.
/// Near and far planes do not count, so that it holds under depth clamp. Exact in double precision: whoever draws in
/// single precision adds a pixel for the rounding of vertices.
/// nullopt if nothing of it can be seen. Points that are not finite make the whole screen the answer.
std::optional<ScreenRect> screenBounds(const glm::dvec4* clipPoints, std::size_t count);
inline std::optional<ScreenRect> screenBounds(const std::vector<glm::dvec4>& clipPoints) {
    return screenBounds(clipPoints.data(), clipPoints.size());
}
template <std::size_t count>
std::optional<ScreenRect> screenBounds(const std::array<glm::dvec4, count>& clipPoints) {
    return screenBounds(clipPoints.data(), count);
}

/// As screenBounds() the convex outline, in normalised device coordinates, grown by `by` to each side; may reach beyond the
/// screen. Empty where that is not known: some of it is behind the eye.
std::vector<glm::dvec2> screenOutline(const std::vector<glm::dvec4>& clipPoints, const glm::dvec2& by);

/// The point all lines of sight go through, homogeneous, w >= 0: the eye, or for an orthographic view the direction
/// towards it. Not finite if the matrix cannot be inverted.
glm::dvec4 eyeIn(const glm::dmat4& clipFromFrame);

/// Corners of the convex hull of points in a plane, counter-clockwise; of points on a line its ends, of fewer than three
/// places those.
/// Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", IPL 9(5), 1979.
std::vector<glm::dvec2> convexHull2D(std::vector<glm::dvec2> points);

/// What an outline covers that is grown by `by` to each side.
std::vector<glm::dvec2> grownOutline(const std::vector<glm::dvec2>& corners, const glm::dvec2& by);

/// What a polygon covers of the screen.
struct ScreenArea {
    double area = 0.0;   ///< pixels.
    double around = 0.0; ///< length of its outline, pixels.
};

/// @param quad    convex, in clip space; corners may be behind the eye, or at infinity. Near and far planes do not count.
/// @param pixels  of the whole screen.
/// Source: I. Sutherland and G. Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974.
ScreenArea screenArea(const std::array<glm::dvec4, 4>& quad, const glm::dvec2& pixels);

} // namespace gnomon
