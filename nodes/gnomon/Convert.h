// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/Vec4d>

#include <cstring>

/// OpenSceneGraph's types to GLM's. A transform's osg::Matrixd (row vectors, row by row) and its glm::dmat4
/// (column vectors, column by column) have the same bytes; only the order of a product turns round.
namespace gnomon {

inline glm::dmat4 toGlm(const osg::Matrixd& matrix) {
    glm::dmat4 result;
    std::memcpy(&result[0][0], matrix.ptr(), 16 * sizeof(double));
    return result;
}

inline osg::Matrixd toOsg(const glm::dmat4& matrix) { return osg::Matrixd(&matrix[0][0]); }

inline glm::dvec3 toGlm(const osg::Vec3d& v) { return {v.x(), v.y(), v.z()}; }
inline glm::dvec4 toGlm(const osg::Vec4d& v) { return {v.x(), v.y(), v.z(), v.w()}; }

} // namespace gnomon
