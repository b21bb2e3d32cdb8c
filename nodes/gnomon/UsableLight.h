// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Convert.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace gnomon {

/// A light about `origin`, with a w of 0 and a direction of length 1, or a w of 1; nullopt if it is nowhere.
inline std::optional<glm::dvec4> usableLight(const osg::Vec4d& inGroup, const osg::Vec3d& origin) {
    const glm::dvec4 given = toGlm(inGroup);
    const glm::dvec4 light = given.w == 0.0 ? glm::dvec4(glm::normalize(glm::dvec3(given)), 0.0)
                                            : glm::dvec4(glm::dvec3(given) / given.w - toGlm(origin), 1.0);
    if (!(std::isfinite(given.w) && std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z)))
        return std::nullopt;
    return light;
}

} // namespace gnomon
