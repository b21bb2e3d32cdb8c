// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/metrics/BoundaryDistance.h>
#include <gnomon/metrics/CauseSplit.h>
#include <gnomon/metrics/Confusion.h>
#include <gnomon/metrics/Intensity.h>
#include <gnomon/metrics/Visibility.h>

namespace gnomon::metrics {

/// M8, as far as a picture shows it: counted, never averaged. Errors of OpenGL, crashes and hangs are the runner's.
struct Catastrophes {
    std::size_t notFinite = 0; ///< pixels with NaN or infinity in a picture
    bool allShadowed = false;  ///< every pixel of R+ is shadowed, and should not be
    bool allLit = false;       ///< every pixel of R+ is lit, and should not be
    bool lostShadow = false;   ///< intersection over union on Rc < 0.2

    bool any() const { return notFinite > 0 || allShadowed || allLit || lostShadow; }
};

/// Everything one view of one light says: metrics M1 to M6 and M8. M7 needs a sequence: FlickerMeter.
struct ShadowMetrics {
    std::size_t agreeing = 0, facing = 0, certain = 0; ///< pixels of R, R+, Rc
    std::size_t unmeasured = 0;                        ///< lit surface's pixels without a V
    double droppedShare = 0.0;                         ///< see PixelSets
    bool sound = true;                                 ///< see PixelSets::sound()
    Confusion headline, raw;                           ///< on Rc, on R+
    Confusion terminator, selfShadowed;                ///< reported apart
    std::optional<BoundaryDistance> boundary;
    CauseSplit causes;
    IntensityError pointSun, discSun; ///< the second is empty without truth.litByDisc
    IntensityError thin;              ///< of a point sun, both filtered by 4 x 4 px
    Catastrophes catastrophes;
};

/// All of it. About 0.1 s for a picture of 800 x 600; up to 2 s where half of all pixels are noise.
/// @throws std::invalid_argument if sizes differ, or a grid that is not optional is missing.
ShadowMetrics shadowMetrics(const Visibility& visibility, const TruthMaps& truth, const CauseLimits& limits = {});

} // namespace gnomon::metrics
