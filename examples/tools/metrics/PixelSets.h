// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>
#include <metrics/Grid.h>

#include <array>
#include <optional>

namespace gnomon::metrics {

/// The truth at each pixel of one view with one light: the input that all metrics share.
///
/// shadowTruth() traces one. All grids have one size. Optional grids may be empty. Where N_g.L is not above 0, t_b is to what
/// else is between than the surface itself, and 0 if nothing is, as of a single sheet.
struct TruthMaps {
    Picture lit;             ///< T_a: share, 0 … 1, of a pixel's rays (16 in a 4 x 4 grid) that reach the light.
    Mask litCentre;          ///< T_c: 1 if the ray from the pixel's centre reaches the light.
    Picture blockerDistance; ///< t_b: metres along the centre ray to its blocker. Ignored where T_c is 1.
    Grid<int> receiver;      ///< Id of the surface at the pixel's centre; 0 is the background.
    Picture facing;          ///< N_g.L, -1 … 1: cosine between geometric normal and direction to the light.
    Grid<int> drawn;         ///< Optional: the receiver id as the renderer drew it.
    Picture litByDisc;       ///< Optional: T_a for the sun's disc, 0.533 degrees across.
    Grid<int> blocker;       ///< Optional: id of the object that blocks the centre ray; 0 is none.
    Picture edgeLength;      ///< Optional: metres, longest edge of the receiver's triangle.
    Mask undecided;          ///< Optional: 1 where an edge of the shadow comes so close to the pixel's centre that a
                             ///< rasteriser may decide otherwise than T_c.
    std::array<Mask, 4> litBeside; ///< Optional: the same as T_c, of rays from places that close to the pixel's centre.
    Grid<glm::dvec3> position;     ///< Optional: metres, surface point at the pixel's centre.
    glm::dvec3 towardsLight{0.0};  ///< Optional: direction to the light, any length; zero is unknown.
    glm::dvec3 up{0.0, 0.0, 1.0};  ///< Unit vector upwards.
    /// Optional: light without shadows, 0 … 1, where a convex body is seen and nothing else casts; 0 elsewhere. See teeth().
    Picture smoothLight;
};

/// The sets of pixels that metrics look at. No set has pixels whose visibility is unmeasured. Of the pixels turned away, those
/// within 2 px of a shadow's edge on the back of a single sheet are left out, too.
struct PixelSets {
    Mask agreeing;             ///< R: the pixel and its 4 neighbours are one surface, in the truth and as drawn.
    Mask facing;               ///< R+: pixels of R with N_g.L > 0.05.
    Mask certain;              ///< Rc: pixels of R+ whose rays all agree (T_a is 0 or 1). The headline set.
    Mask turnedAway;           ///< Pixels of R with N_g.L <= 0 whose 24 neighbours lie on the same plane, by N_g.L.
    Mask terminator;           ///< Pixels of R with 0 < N_g.L <= 0.05. Reported apart.
    Mask selfShadowed;         ///< Pixels of R+ that their own object blocks within 2 edge lengths. Reported apart.
    double droppedShare = 0.0; ///< Share of surface pixels that R leaves out because of their ids, 0 … 1.

    /// True if the picture may be judged: at most 5 % of the surface pixels are dropped.
    bool sound() const { return droppedShare <= 0.05; }
};

/// Sorts the pixels of a picture into sets.
///
/// Without TruthMaps::drawn, only silhouettes are dropped. Without blocker ids or edge lengths, selfShadowed is empty.
/// A pixel whose N_g.L is NaN is in R alone.
///
/// @param visibility  V, NaN at unmeasured pixels. Same size as the truth.
PixelSets pixelSets(const TruthMaps& truth, const Picture& visibility);

/// Counts of rightly and wrongly shadowed pixels: metrics M1, M2 and M3.
///
/// s is true for a pixel that is drawn shadowed (V < 0.5), t for a pixel that is truly shadowed (T_c is 0).
/// A share is nullopt if it would be of no pixels.
struct Confusion {
    std::size_t shadow = 0;      ///< Pixels with s & t.
    std::size_t falseShadow = 0; ///< FS: pixels with s & !t.
    std::size_t falseLit = 0;    ///< FL: pixels with !s & t.
    std::size_t lit = 0;         ///< Pixels with !s & !t.

    /// Number of pixels counted.
    std::size_t pixels() const { return shadow + falseShadow + falseLit + lit; }
    /// M1: (FS + FL) / all, 0 … 1. Do not use it alone: it is small if the shadow is small.
    std::optional<double> misclassified() const;
    /// A half of M2: FS / !t, 0 … 1.
    std::optional<double> falseShadowShare() const;
    /// The other half of M2: FL / t, 0 … 1.
    std::optional<double> falseLitShare() const;
    /// M2: mean of the two halves, 0 … 1. If the truth is all lit or all shadow, the half that exists.
    std::optional<double> balancedError() const;
    /// M3: |s & t| / |s | t|, 0 … 1. It is 1 if no pixel is shadowed or should be.
    double intersectionOverUnion() const;
};

/// True if a pixel of this visibility counts as shadowed.
constexpr bool isShadowed(double visibility) { return visibility < 0.5; }

/// Counts the pixels of `within`. V must be measured there.
Confusion confusion(const Picture& visibility, const TruthMaps& truth, const Mask& within);

} // namespace gnomon::metrics
