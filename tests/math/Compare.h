// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace gnomon::test {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Every component of two vectors within `tolerance`; both are printed when one is not. NaN fails.
template <class Vector>
::testing::AssertionResult near(const Vector& got, const Vector& expected, double tolerance) {
    bool same = true;
    for (int i = 0; i < Vector::length(); ++i) same = same && std::abs(got[i] - expected[i]) <= tolerance;
    if (same) return ::testing::AssertionSuccess();
    auto failure = ::testing::AssertionFailure() << "got ";
    for (int i = 0; i < Vector::length(); ++i) failure << got[i] << ' ';
    failure << "expected ";
    for (int i = 0; i < Vector::length(); ++i) failure << expected[i] << ' ';
    return failure << "within " << tolerance;
}

inline ::testing::AssertionResult near(const glm::dmat4& got, const glm::dmat4& expected, double tolerance) {
    for (int column = 0; column < 4; ++column)
        if (const auto result = near(got[column], expected[column], tolerance); !result)
            return ::testing::AssertionFailure() << "column " << column << ": " << result.message();
    return ::testing::AssertionSuccess();
}

inline glm::dvec3 dehomogenized(const glm::dvec4& point) { return glm::dvec3(point) / point.w; }
inline glm::dvec3 flattened(const glm::dmat4& matrix, const glm::dvec3& point) {
    return dehomogenized(matrix * glm::dvec4(point, 1.0));
}

/// Repeatable random numbers: the same seed, the same test.
class Random {
public:
    explicit Random(unsigned seed) : _engine(seed) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(_engine); }
    glm::dvec3 inCube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 candidate = inCube(1.0);
            const double length = glm::length(candidate);
            if (length > 0.1 && length <= 1.0) return candidate / length;
        }
    }

private:
    std::mt19937_64 _engine;
};

} // namespace gnomon::test
