// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>

#include <limits>
#include <optional>

namespace gnomon {

/// What the maps of one light in one view would be like, found without making any: for whoever chooses among settings.
struct MapForecast {
    int maps = 0;        ///< 0: none of the shadow can be seen.
    int most = 0;        ///< texels on a side of a map, by OpenGL's largest texture.
    double texels = 0.0; ///< on a side of the largest map, with one texel a pixel where pixels are smallest.
    double pixel = std::numeric_limits<double>::infinity(); ///< smallest side of a pixel, see TexelDensity.
    std::optional<ScreenRect> bounds;                       ///< where on the screen the shadow can be.
};

} // namespace gnomon
