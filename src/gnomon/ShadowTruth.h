// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/RayScene.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace gnomon {

/// A view and a light to trace. Rays go from the near to the far plane.
struct TruthView {
    glm::dmat4 clipFromWorld{1.0}; ///< Perspective or orthographic. World is the frame of the scenes' rays.
    int width = 0;                 ///< Width of the picture, pixels.
    int height = 0;                ///< Height of the picture, pixels.
    glm::dvec4 light{0.0};         ///< Homogeneous: w = 0 is the direction towards a sun, w = 1 a lamp's position.
};

/// The true shadow at one pixel. A surface that faces away from the light is not lit.
struct TruthPixel {
    unsigned receiver = RayHit::none; ///< Triangle seen at the pixel's centre; `none` in the background.
    bool litCentre = false;           ///< T_c: true if the surface at the pixel's centre is lit.
    /// True if an edge of the shadow comes within 1/16 px of the centre, in the picture or in the plane of the surface. A
    /// rasteriser, or a depth buffer's step, may then decide otherwise than T_c. Not of soft shadows.
    bool undecided = false;
    std::array<bool, 4> litBeside{}; ///< T at four places diagonally beside the centre, 1/16 px along each axis. Not of
                                     ///< soft shadows.
    float lit = 0.0f;                ///< T_a: lit share of the 16 rays, background rays left out. 0 without any.
    glm::dvec3 position{0.0};        ///< Surface point at the centre, world.
    glm::dvec3 normal{0.0};          ///< Geometric unit normal towards the eye.
    double facing = 0.0;             ///< N_g·L: cosine between normal and light. <= 0 faces away.
    /// First triangle of the casters on the way to the light. Of what faces away, beyond its own: a single sheet has none.
    unsigned blocker = RayHit::none;
    double blockerDistance = 0.0; ///< t_b: distance to the blocker, world units. 0 without a blocker.

    /// True if the pixel's centre shows a surface.
    bool seen() const { return receiver != RayHit::none; }
    /// True if an edge of a shadow, a silhouette or a terminator runs through the pixel: 0 < T_a < 1.
    bool isEdge() const { return lit > 0.0f && lit < 1.0f; }
};

/// The true shadows of a picture. Pixels stand row by row, the bottom row first, as in OpenGL.
struct GNOMON_EXPORT TruthImage {
    int width = 0;                  ///< Width, pixels.
    int height = 0;                 ///< Height, pixels.
    std::vector<TruthPixel> pixels; ///< width * height of them.

    /// The pixel in column x of row y.
    const TruthPixel& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * std::size_t(width) + std::size_t(x)];
    }
    /// Error of a technique with one perfect sample a pixel: the share of pixels whose T_c and T_a >= 1/2 differ.
    /// It counts pixels that show a surface facing the light. 0 if there are none.
    double floor() const;
};

/// Traces the true hard shadow of a sun or lamp without extent, to measure techniques against.
///
/// Each pixel gets 16 rays in a 4×4 grid and one through its centre, (x + 1/2, y + 1/2). Another ray goes from each hit
/// to the light. RayScene is the only code that it shares with a technique.
///
/// @param seen     the visible scene, receivers and casters alike.
/// @param casters  the triangles that block light. It may be the same scene. Both have one frame of rays.
/// @param view     the view and the light.
///
/// Cost
/// - 34 rays a pixel, 8 more where an edge of a shadow runs through it, and 4 more where the surface bends in it:
///   seconds for a megapixel.
/// Needs
/// - No OpenGL.
/// Limits
/// - Loses objects thinner than 10⁻⁶ of the coordinates about the scene's origin, or nearer than that to a surface.
/// - Normals are geometric: a facet near the terminator may shadow itself where smooth shading would light it.
/// Threads
/// - Uses all cores.
GNOMON_EXPORT TruthImage shadowTruth(const RayScene& seen, const RayScene& casters, const TruthView& view);

/// Traces the true soft shadow of a sun with a disc. Use it as shadowTruth(), for penumbras.
///
/// `lit` is the mean over 16 places of the pixel and strata² stratified places of the disc for each. litCentre, blocker
/// and blockerDistance are those of the disc's centre. A lamp stays a point.
///
/// @param degrees  angular diameter of the sun; 0.533 for the sun in the sky.
/// @param strata   rows and columns of places on the disc, at least 1.
GNOMON_EXPORT TruthImage softShadowTruth(const RayScene& seen, const RayScene& casters, const TruthView& view,
                                         double degrees, int strata);

} // namespace gnomon
