// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <vector>

namespace gnomon {

/// How near and how far what is seen lies along the line of sight: clip space's w. Of an orthographic view all is 1.
class SeenRange {
public:
    /// @param clipFromScene  of the view.
    explicit SeenRange(const glm::dmat4& clipFromScene);

    /// Adds what of a box lies within all half-spaces (of the scene, see cutBox()).
    void addBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                const std::vector<glm::dvec4>& halfSpaces);

    bool empty() const { return !(nearest <= farthest); }

    double nearest = std::numeric_limits<double>::infinity(), farthest = -std::numeric_limits<double>::infinity();

private:
    glm::dvec4 _w; ///< row of the matrix.
};

constexpr int mostCascades = 4;

/// How many maps are worth while, 1 … mostCascades: so that where each part begins a texel of its map is at most three pixels
/// wide. That is where it is widest; of all edges 95 % are then within about a pixel, in a street of 2 km as on mountains, and
/// walls that the light grazes are dark beside what stands before them, within ten texels of it.
/// @param pixels  on a side of a texel, at the farthest that is seen, if there is one map.
/// @param before  how many there were, 0 … mostCascades; they stay where another count would hardly be better.
int cascadesFor(const SeenRange& seen, double pixels, int before);

/// Distances at which what is seen is divided among maps, nearest first: each part is as many times as far at its end as
/// at its beginning. A map's texels grow with the end of its part, and pixels are smallest at its beginning, so that the
/// most texels a pixel are then the least. A part whose end is less than twice as far as its beginning is not worth a map.
/// @param most  maps, at least 1.
/// @return one less than the maps that are of use; none where nothing is seen.
/// Source: F. Zhang et al., "Parallel-Split Shadow Maps for Large-Scale Virtual Environments", VRCIA 2006: its
///         logarithmic scheme, between what is seen nearest and farthest instead of the near and far planes.
std::vector<double> cascadeSplits(const SeenRange& seen, int most);

/// Half-spaces of the scene that hold a part of the view: its sides, and the splits before and behind it; near and far
/// planes of the view at the ends.
/// @param part  0 … splits.size().
std::vector<glm::dvec4> viewPart(const glm::dmat4& clipFromScene, const std::vector<double>& splits, std::size_t part);

} // namespace gnomon
