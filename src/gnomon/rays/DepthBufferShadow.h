// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gnomon {

/// Part of a picture's depth buffer.
struct DepthPicture {
    int viewportWidth = 0, viewportHeight = 0; ///< pixels.
    int x = 0, y = 0, width = 0, height = 0;   ///< the part, counted from the viewport's lower left corner.
    std::vector<float> depths;        ///< window depths of the part, row by row, 0 (near) … 1 (far, or nothing).
    double step = 1.0 / (1 << 24);    ///< between two depths that the buffer can tell apart.
    double subpixel = 1.0 / (1 << 8); ///< part of a pixel to which the rasteriser snaps corners.
    glm::dvec2 place{0.5};            ///< where in its pixel a depth was taken, 0 … 1.
    double offPlace = 0.0;            ///< how far from there it may have been, pixels along either axis.
    int neighbour = 1;        ///< pixels to the next of the same surface; 2 where those between are another eye's.
    double drawnDepth = 0.0;  ///< how far off a surface may be drawn, in depth: see DrawnError.
    double drawnPixels = 0.0; ///< the same along either axis.
};

/// A box in the frame of the rays.
struct RayBox {
    glm::dvec3 low, high;
};

/// An earlier answer under the same matrix and light, of which only what may have changed is found anew.
struct FormerShadow {
    const DepthPicture& picture;           ///< of the same part of the same viewport, in depths of the same kind.
    const std::vector<std::uint8_t>& bits; ///< the answer.
    std::vector<RayBox> changed;           ///< what casts elsewhere now, or no more, or is new: before and now.
};

/// Rows of bits, each row filled up to whole bytes, the first pixel in the highest bit, as glBitmap takes them.
struct TracedBits {
    std::vector<std::uint8_t> bits; ///< set where something is seen that the light does not reach.
    std::size_t traced = 0;         ///< pixels that rays were cast for.
};

/// Which pixels a light does not reach: where the depth buffer says a surface is, one ray to the light.
///
/// A depth is not exact. It is taken to be right to 4 steps of the buffer, to what twice the rasteriser's snapping moves it
/// and a sample's place, by its slope to the nearer of the neighbours on either side, and to DrawnError. The ray starts as much nearer to the eye, and a few steps of a float more (RayScene::margin()). Between surface
/// and eye nothing can be, or it would be seen: so the start is never behind a thing, nothing leaks at contacts, and needs
/// no normal; and it is always on the seen side of its own surface, so that what is flat does not shadow itself. What is
/// seen from behind, and faces away from the light, is in shadow if anything but its own surface is between: solids
/// are, a single sheet is not, for OpenGL lights both its sides alike. Where the start would move by more than an eighth of a pixel, one more
/// ray finds the caster's surface between the two ends of what the depth may mean, and the ray to the light starts there.
/// That is so over kilometres of terrain, on a quad of more than 1,200 near planes, and where large coordinates are in the
/// vertices. Where no caster is found there, what is seen does not cast, and cannot shadow itself.
///
/// @param clipFromScene  of the picture, as drawn; scene is the frame of the rays.
/// @param light          homogeneous, w = 0 the way towards a sun, w = 1 a lamp's position.
/// @param former         may be null.
///
/// Cost    a ray a pixel that shows anything, on all cores: of one core 0.11 µs over a sphere, 0.19 in a town of 400 boxes,
///         0.22 to 0.28 in one of 3,000,000 triangles, 0.35 on a terrain of as many (AMD EPYC, 2026).
///         With a former answer, a comparison where nothing has changed.
/// Limits  depths drawn with an offset or a depth range of their own are taken for what they say.
TracedBits depthBufferShadow(const RayScene& scene, const DepthPicture& picture, const glm::dmat4& clipFromScene,
                             const glm::dvec4& light, const FormerShadow* former = nullptr);

/// What share of a light reaches pixels, 0 … 255, row by row: all of it or nothing as depthBufferShadow() says, but where one of the
/// four neighbours is otherwise. There by 16 rays from places in the pixel, on the surface that is seen in its middle: nothing comes from beyond the edge of what is seen.
///
/// @param bits  as depthBufferShadow() has found them of the same picture.
///
/// Cost    32 rays for a pixel at an edge, half of them short, on all cores.
/// Limits  a shadow thinner than a pixel, which no neighbour's ray meets, is no edge. Steps of 1/16.
std::vector<std::uint8_t> depthBufferShares(const RayScene& scene, const DepthPicture& picture,
                                            const glm::dmat4& clipFromScene, const glm::dvec4& light,
                                            const std::vector<std::uint8_t>& bits);

} // namespace gnomon
