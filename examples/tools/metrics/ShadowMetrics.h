// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/BoundaryDistance.h>
#include <metrics/CauseSplit.h>
#include <metrics/PixelSets.h>
#include <metrics/Visibility.h>

namespace gnomon::metrics {

/// M8: catastrophes that a picture shows. Count them; do not average them.
///
/// The program that renders counts OpenGL errors, crashes and hangs.
struct Catastrophes {
    std::size_t notFinite = 0; ///< Number of pixels with NaN or infinity in a picture.
    bool allShadowed = false;  ///< True if every pixel of R+ is shadowed, wrongly.
    bool allLit = false;       ///< True if every pixel of R+ is lit, wrongly.
    bool lostShadow = false;   ///< True if the intersection over union on Rc is below 0.2.

    /// True if there is a catastrophe.
    bool any() const { return notFinite > 0 || allShadowed || allLit || lostShadow; }
};

/// The errors of one picture with one light: metrics M1 to M6 and M8.
///
/// Use FlickerMeter for M7, which needs a sequence of pictures.
struct ShadowMetrics {
    std::size_t agreeing = 0;                 ///< Number of pixels in R, see PixelSets.
    std::size_t facing = 0;                   ///< Number of pixels in R+.
    std::size_t certain = 0;                  ///< Number of pixels in Rc.
    std::size_t unmeasured = 0;               ///< Number of pixels facing the light without a V.
    double droppedShare = 0.0;                ///< See PixelSets::droppedShare.
    bool sound = true;                        ///< See PixelSets::sound().
    Confusion headline;                       ///< On Rc.
    Confusion raw;                            ///< On R+.
    Confusion terminator;                     ///< On the set of this name, reported apart.
    Confusion selfShadowed;                   ///< On the set of this name, reported apart.
    std::size_t turnedAwayWrong = 0;          ///< See the function turnedAwayWrong().
    std::optional<std::size_t> teeth;         ///< See the function teeth(). nullopt without TruthMaps::smoothLight.
    std::optional<BoundaryDistance> boundary; ///< M4; nullopt without both boundaries.
    CauseSplit causes;                        ///< M5.
    IntensityError pointSun;                  ///< M6 for a point sun.
    IntensityError discSun;                   ///< M6 for the sun's disc. Empty without TruthMaps::litByDisc.
    IntensityError thin;                      ///< M6 for a point sun, after a filter of 4 x 4 px.
    Catastrophes catastrophes;                ///< M8.
};

/// The number of pixels of PixelSets::turnedAway that are bright, or striped; on the back of a single sheet, those that are dark.
///
/// Where N_g.L is below -0.01, a pixel is wrong that is lit, or, if nothing but its own surface is between it and the light,
/// dark: OpenGL lights both sides of a sheet alike, and it does not shadow itself. Nearer to the light's plane a depth buffer
/// does not tell to which side a surface turns: it may be lit there as a whole, and a pixel is wrong that differs from one of
/// its 4 neighbours. Pixels of TruthMaps::smoothLight are left out: teeth() judges them.
std::size_t turnedAwayWrong(const Picture& visibility, const TruthMaps& truth, const Mask& turnedAway);

/// True if a shadow takes more than leastContrast of what the light gives to TruthMaps::smoothLight.
bool isTooth(const Picture& visibility, const TruthMaps& truth, std::size_t pixel);

/// The number of pixels of a convex body with smooth normals that its own shadow darkens. The right number is 0.
///
/// Such a body lies in no shadow of its own. Its shading ends at the terminator. A renderer that shadows it by its
/// facets darkens a zigzag of pixels there, because some facets turn away before the normals do.
///
/// @param within  pixels to look at: R, or a part of it.
/// @return nullopt without TruthMaps::smoothLight.
std::optional<std::size_t> teeth(const Picture& visibility, const TruthMaps& truth, const Mask& within);

/// Measures one picture by all these metrics. The functions for single metrics stand in the other headers.
///
/// @param visibility  V, by the function visibility().
/// @param truth       truth of the same size.
/// @param limits      distances that sort errors by cause.
/// @throws std::invalid_argument if sizes differ or a required grid is missing.
///
/// Cost
/// - A fraction of a second for a picture of 800 x 600, and seconds if half of its pixels are noise.
ShadowMetrics shadowMetrics(const Visibility& visibility, const TruthMaps& truth, const CauseLimits& limits = {});

} // namespace gnomon::metrics
