// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/FlatBox.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon {

std::optional<int> flatAxis(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox) {
    constexpr double flat = 1.0 / 8.0;
    glm::dvec3 length;
    for (int axis = 0; axis < 3; ++axis)
        length[axis] = glm::length(glm::dvec3(sceneFromBox[axis])) * (high[axis] - low[axis]);
    const int thin = length.x <= length.y && length.x <= length.z ? 0 : length.y <= length.z ? 1 : 2;
    if (length[thin] > flat * std::min(length[(thin + 1) % 3], length[(thin + 2) % 3])) return std::nullopt;
    return thin;
}

} // namespace gnomon
