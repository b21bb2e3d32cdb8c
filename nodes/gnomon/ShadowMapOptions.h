// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Values of the settings below, under the names that ShadowMapOptions and ShadowMapTechnique share.
struct ShadowMapNames {
    /// How many texels of the map a pixel is compared with. Later filters are more accurate in general, and slower.
    enum Filter : int {
        NEAREST,  ///< One texel: stepped edges.
        BILINEAR, ///< 2 × 2 texels, weighted.
        BICUBIC,  ///< 4 × 4 texels, weighted by cubic B-splines: rounded edges. SMOOTH edges: 4 times 2 × 2 texels,
                  ///< spread over the pixel.
        FINE      ///< SMOOTH edges: 16 times 2 × 2 texels, in maps of twice the resolution, within size. Other
                  ///< edges: as BICUBIC.
    };

    /// How much of a light a pixel at a shadow's edge gets.
    enum Edges : int {
        HARD,   ///< All or nothing: nothing if less than half of the light arrives.
        SMOOTH, ///< The lit share of the pixel: a hard edge without steps. With NEAREST as HARD.
        SOFT    ///< The share of the light that arrives: penumbras. See sunAngle, lampSize and radius.
    };

    /// Debug views, drawn over the finished picture.
    enum View : int {
        NOTHING, ///< No debug view.
        MAP,     ///< Each light's maps in the lower left corner. Near casters are bright, empty texels blue.
        TEXELS,  ///< Width of the first light's texels: blue ¼ pixel, green 1, yellow 3, red 8 or more. A chequerboard
                 ///< shows texels wider than two pixels.
        CASCADES ///< The map of the first light that answers: red (the finest), green, blue, yellow, purple or cyan.
    };
};

/// Settings of a ShadowMapTechnique, with their defaults.
///
/// Use it to set several at once, or to keep them apart from a node. A technique's setters change one each.
///
///     gnomon::ShadowMapOptions options;
///     options.size = 2048;
///     options.edges = gnomon::ShadowMapOptions::SMOOTH;
///     shadow->setOptions(options);
struct GNOMON_EXPORT ShadowMapOptions : ShadowMapNames {
    static constexpr int leastSize = 16;      ///< Range of size, texels.
    static constexpr int mostSize = 16384;    ///< Range of size, texels.
    static constexpr int mostCascades = 4;    ///< Range of cascades.
    static constexpr double mostAngle = 20.0; ///< Range of sunAngle, degrees. Wider suns are no small light.
    static constexpr double mostLength = 1e6; ///< Range of lampSize and radius, scene's unit.
    static constexpr int mostUnit = 31;       ///< Range of programUnit.

    /// Most texels on a side of a map, 16 … 16384. Default 1024: hard edges gain nothing above a picture's height.
    /// A map has fewer if the view cannot show more. Above OpenGL's limit there is no shadow, and diagnose() says so.
    int size = 1024;
    /// Filter of the comparisons. Default BICUBIC: the most accurate one that does not need larger maps.
    Filter filter = BICUBIC;
    /// Most cascades (maps) of a sun, 0 … 4. Default 0: as many as keep texels within three pixels.
    /// Cascades divide a view that reaches from near to far, such as a street or a landscape. Their depths grow by a
    /// constant ratio. A ratio below two gives fewer cascades. Orthographic views and lamps have one.
    int cascades = 0;
    /// Kind of edges. Default HARD: it needs no alpha bits.
    Edges edges = HARD;
    /// SOFT edges: angular diameter of suns, degrees, 0 (a point) … 20. Default 0.533, the sun as seen from the earth.
    double sunAngle = 0.533;
    /// SOFT edges: diameter of lamps and spots, scene's unit, 0 … 1e6. Default 0: a point, as OpenGL has it.
    double lampSize = 0.0;
    /// SOFT edges: blur radius, scene's unit, 0 … 1e6. Default 0: the filter alone.
    /// It averages a disc across the light's direction. Every edge then has the same width, for looks.
    double radius = 0.0;
    /// Debug view. Default NOTHING.
    /// MAP needs the OpenGL that penumbras need. Pixels without a map stay unchanged. With programUnit there is no
    /// debug view.
    View view = NOTHING;
    /// Texture unit, 0 … 31, where the scene's own shader programs find the maps of the first light. Default -1: off.
    /// With a unit, the technique marks no pixels: only programs with ShadowMapTechnique::programFunction() show
    /// shadows. Give other drawables a technique of their own.
    int programUnit = -1;

    /// Options that can be used. Numbers are clamped to their ranges, and NaN becomes 0. An unknown filter, kind of
    /// edges, view or unit becomes the default.
    ShadowMapOptions usable() const;
    /// True if edges have shades between lit and dark, for which the framebuffer needs alpha bits: SOFT, and SMOOTH but with
    /// NEAREST.
    bool fades() const { return edges == SOFT || (edges == SMOOTH && filter != NEAREST); }
};

} // namespace gnomon
