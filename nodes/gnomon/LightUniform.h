// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace gnomon {

/// A uniform by which shader programs read a light's colour: 0 while that light is taken away.
struct LightUniform {
    int number = 0;   ///< OpenGL light number, as ShadowLight::number.
    std::string name; ///< of a float, vec2, vec3 or vec4 that all a light gives is multiplied by.

    bool operator==(const LightUniform& other) const { return number == other.number && name == other.name; }
};

} // namespace gnomon
