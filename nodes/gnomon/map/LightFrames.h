// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/mapfit/MapFit.h>
#include <gnomon/mapfit/SpotCone.h>

#include <glm/vec4.hpp>

#include <optional>
#include <vector>

namespace gnomon {

/// Of a sun one; of a lamp that sees all casters to one side one, else those of a cube, a little larger so that what is
/// on an edge is in both. Of a spot one about its cone, unless that is nearly flat.
///
/// A lamp is a sun where that moves no shadow by more than an eighth of a texel: else its depths would be rounded off.
///
/// @param light, cone  about the casters' origin. @param texels  on a map's side.
std::vector<LightFrame> framesOf(const glm::dvec4& light, const std::optional<SpotCone>& cone,
                                 const CasterLayers& casters, int texels);

bool areSame(const std::vector<LightFrame>& a, const std::vector<LightFrame>& b);

} // namespace gnomon
