// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/mapfit/MapFit.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <optional>

namespace gnomon {

/// The axis along which a box is flat, as grounds are: in the scene its shortest side is an eighth of the next, or less.
/// Nullopt for other boxes.
std::optional<int> flatAxis(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox);

/// How small the smallest pixel is on what is seen, as a light sees it: a map with finer texels than that tells nothing
/// more.
class TexelDensity {
public:
    /// @param clipFromScene  of the view. @param pixels  of the view, across and up.
    TexelDensity(const LightFrame& frame, const glm::dmat4& clipFromScene, const glm::dvec2& pixels);

    /// Adds what of a box lies within all half-spaces (of the scene, see cutBox()) and within the light's own. A texel is
    /// stretched on what is turned away from the light: on a box that is flat, as grounds are, by its slope, up to eight
    /// times; on others twice, as on what is turned away by 60 degrees.
    void addBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                const std::vector<glm::dvec4>& halfSpaces);

    /// Side of the largest texel that is no larger than a pixel anywhere, in the light's x/w and y/w; infinite as long as
    /// nothing is seen, 0 where it can be seen from next to it.
    double side = std::numeric_limits<double>::infinity();

private:
    glm::dvec4 inLight(const glm::dvec4& place) const;
    double unstretched(const glm::dvec4& place) const;
    double stretch(const glm::dvec3& normal, const glm::dvec4& place) const;

    LightFrame _frame;
    glm::dvec4 _pixel; ///< row: side of a pixel at a place.
};

/// Texels on a map's side: hardly more than are of use, in steps, so that they seldom change.
/// @param wanted  how many would be.
/// @param most    at most.
/// @param before  how many there were; they stay while they are enough and not twice too many. 0: none.
int texelsFor(double wanted, int most, int before);

} // namespace gnomon
