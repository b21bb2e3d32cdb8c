// SPDX-License-Identifier: MIT
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/Vec4d>

#include <cstring>

/// Conversions between OpenSceneGraph's vectors and matrices and GLM's.
///
/// An osg::Matrixd and the glm::dmat4 of the same transform have the same bytes, so a conversion is a copy.
/// OpenSceneGraph multiplies row vectors and GLM column vectors: only the order of a product differs.
namespace gnomon {

/// Converts a transform. Copies its bytes.
inline glm::dmat4 toGlm(const osg::Matrixd& matrix) {
    glm::dmat4 result;
    std::memcpy(&result[0][0], matrix.ptr(), 16 * sizeof(double));
    return result;
}

/// Converts a transform. Copies its bytes.
inline osg::Matrixd toOsg(const glm::dmat4& matrix) { return osg::Matrixd(&matrix[0][0]); }

/// Converts a vector.
inline glm::dvec3 toGlm(const osg::Vec3d& v) { return {v.x(), v.y(), v.z()}; }
/// Converts a vector.
inline osg::Vec4 toOsg(const glm::vec4& v) { return {v.x, v.y, v.z, v.w}; }
/// Converts a vector, a plane or a homogeneous point.
inline glm::dvec4 toGlm(const osg::Vec4d& v) { return {v.x(), v.y(), v.z(), v.w()}; }

} // namespace gnomon
