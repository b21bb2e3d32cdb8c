// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gnomon {

/// What is to be looked at. Rays go from the near to the far plane, as what OpenGL draws lies between them.
struct TruthView {
    glm::dmat4 clipFromWorld{1.0}; ///< perspective or orthographic; world is the frame of the scenes' rays.
    int width = 0, height = 0;     ///< pixels.
    glm::dvec4 light{0.0};         ///< homogeneous: w = 0 the way towards a sun, w = 1 a lamp's position.
};

/// What rays say about one pixel. "Lit" is whether the light's rays arrive at the surface; a surface that faces away
/// from the light is not lit.
struct TruthPixel {
    unsigned receiver = RayHit::none; ///< triangle seen at the pixel's centre; `none` where nothing is.
    bool litCentre = false;           ///< T_c: of the ray through the centre.
    float lit = 0.0f;                 ///< T_a: share of those of the 16 rays that meet anything; 0 if none does.
    glm::dvec3 position{0.0};         ///< world, at the centre.
    glm::dvec3 normal{0.0};           ///< geometric, unit, towards the eye.
    double facing = 0.0;              ///< N_g·L, cosine between normal and light; <= 0 faces away.
    unsigned blocker = RayHit::none;  ///< triangle of the casters that is met first on the way to the light.
    double blockerDistance = 0.0;     ///< t_b, world units; 0 where there is no blocker.

    bool seen() const { return receiver != RayHit::none; }
    /// A shadow's edge, a silhouette or a terminator runs through the pixel: 0 < T_a < 1.
    bool isEdge() const { return lit > 0.0f && lit < 1.0f; }
};

/// Pixels row by row, the bottom row first, as OpenGL has them.
struct TruthImage {
    int width = 0, height = 0;
    std::vector<TruthPixel> pixels;

    const TruthPixel& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * std::size_t(width) + std::size_t(x)];
    }
    /// Share of the pixels that are seen and face the light in which the centre ray falls on the other side of
    /// T_a = 1/2: the error of a technique that takes one perfect sample a pixel. 0 if there are no such pixels.
    double floor() const;
};

/// The hard shadow of a point light or a sun without extent, as exact as rays tell it: 16 rays a pixel in a 4×4 grid and
/// one through its centre, each with one ray on to the light.
///
/// @param seen     what is looked at, receivers and casters alike.
/// @param casters  what blocks light; may be the same scene. With a frame of rays in common.
///
/// Cost    34 rays a pixel: for a megapixel 3.5 s on 2 cores in a town of 3,000,000 triangles, 2 s over a sphere, 4.3 s on
///         a terrain.
/// Limits  those of RayScene: what is thinner than 2·10⁻⁵ of the coordinates about the scene's origin, or stands nearer to
///         a surface than that, is lost. Geometric normals: a facet near the terminator is in its own mesh's shadow where
///         a smooth shading would light it.
/// Threads uses all cores.
/// Pixels' centres are OpenGL's, (x + 1/2, y + 1/2). Shares no code with any technique but RayScene.
TruthImage shadowTruth(const RayScene& seen, const RayScene& casters, const TruthView& view);

/// As shadowTruth(), with a sun of angular diameter `degrees` (the sky's: 0.533) in place of one without extent: `lit` is
/// the mean over 16 places of the pixel and `strata`² of the disc each, stratified; litCentre, blocker and its distance
/// stay those of the disc's middle. A lamp stays a point.
TruthImage softShadowTruth(const RayScene& seen, const RayScene& casters, const TruthView& view, double degrees,
                           int strata);

} // namespace gnomon
