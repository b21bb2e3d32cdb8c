// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace gnomon {

/// Names a uniform that carries a view's projection into the shader programs of casters.
///
/// Use it if a program projects by a matrix of its own and not by OpenGL's. ShadowMapTechnique sets the uniform to the light's
/// matrix while the program draws into a map. See ShadowCasterGroup::addMatrixUniform().
struct MatrixUniform {
    /// Which matrix the application sets. GLSL multiplies a column vector by it from the left, as by gl_ProjectionMatrix.
    enum Kind : int {
        MODEL_VIEW_PROJECTION, ///< From the drawable's own frame to clip space.
        PROJECTION,            ///< From the eye's frame to clip space.
        VIEW_PROJECTION        ///< From the world's frame to clip space.
    };
    std::string name;                  ///< Name of a mat4. Not an array element, nor in a uniform block.
    Kind kind = MODEL_VIEW_PROJECTION; ///< What the application sets it to.

    /// True if name and kind are equal.
    bool operator==(const MatrixUniform& other) const { return name == other.name && kind == other.kind; }
};

} // namespace gnomon
