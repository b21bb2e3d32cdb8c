// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/group/ViewFrame.h>

#include <glm/vec4.hpp>

namespace gnomon {

/// What the volumes of all casters behind a light would come to in a view.
struct VolumeForecast {
    double sides = 0.0; ///< of the volumes that can be seen; each two triangles.
    double pixels =
        0.0; ///< that they cover, each for itself. Narrow ones count as wide as OpenGL's rasteriser takes them.
};

/// Found from the casters' bounds and numbers of triangles alone: no edge is looked at.
///
/// A mesh of n triangles has some n^0.8 edges on its outline, and flat ones fewer (M. McGuire, "Observations on Silhouette
/// Sizes", Journal of Graphics Tools, 2004). So an estimate may be off by a factor of 2 and more.
///
/// @param light  group frame; w is 0 and the direction has length 1, or w is 1.
///
/// Cost  a look at each drawable's bounds.
VolumeForecast forecastVolumes(const ViewFrame& view, const CasterDrawables& casters, const glm::dvec4& light);

} // namespace gnomon
