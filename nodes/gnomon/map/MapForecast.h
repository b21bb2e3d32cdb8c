// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace gnomon {

/// What the maps of one light in one view would be like, found without making any: for whoever chooses among settings.
struct MapForecast {
    int maps = 0;        ///< 0: none of the shadow can be seen.
    int most = 0;        ///< texels on a side of a map, by OpenGL's largest texture.
    double texels = 0.0; ///< on a side of the largest map, with one texel a pixel where pixels are smallest.
    double pixel = std::numeric_limits<double>::infinity(); ///< smallest side of a pixel, see TexelDensity.
    std::optional<ScreenRect> bounds;                       ///< where on the screen the shadow can be.
    /// One of the maps.
    struct Map {
        glm::dmat4 mapFromScene;            ///< what it holds is within 0 and 1, homogeneous.
        std::vector<glm::dvec4> halfSpaces; ///< of the scene: what is looked up in it.
    };
    std::vector<Map> each{};
};

} // namespace gnomon
