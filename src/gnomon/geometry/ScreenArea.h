// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

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
