// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace gnomon {

/// Names a uniform that carries a light's colour into the shader programs of receivers.
///
/// Use it if a program reads a light from its own uniform and not from OpenGL's lights.
/// RELIGHT sets the uniform to 0 while it draws shadowed pixels again. See ShadowCasterGroup::addLightUniform().
struct LightUniform {
    int number = 0;   ///< OpenGL light number, 0 … 7, as ShadowLight::number.
    std::string name; ///< Name of a float, vec2, vec3 or vec4 that scales all of the light. Not an array element.

    /// True if number and name are equal.
    bool operator==(const LightUniform& other) const { return number == other.number && name == other.name; }
};

} // namespace gnomon
