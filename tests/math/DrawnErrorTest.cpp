// SPDX-License-Identifier: MIT
// How far floats draw a point from its place, against floats that do as OpenGL does.
#include "Compare.h"

#include <gnomon/geometry/DrawnError.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

using gnomon::DrawnError;
using gnomon::test::Random;

namespace {

constexpr double width = 480.0;

/// Matrices and their product in floats, as Mesa has them.
glm::dvec3 drawn(const glm::dmat4& projection, const glm::dmat4& view, const glm::dvec3& point) {
    const glm::vec4 clip = (glm::mat4(projection) * glm::mat4(view)) * glm::vec4(glm::vec3(point), 1.0f);
    return glm::dvec3(clip) / double(clip.w);
}

glm::dvec3 exact(const glm::dmat4& projection, const glm::dmat4& view, const glm::dvec3& point) {
    return gnomon::test::dehomogenized(projection * view * glm::dvec4(point, 1.0));
}

/// A telescope that shows 10 m about the origin, with planes that hold just this.
TEST(DrawnError, HoldsWhatTheMatricesOfATelescopeLose) {
    for (const double degrees : {30.0, 3.0, 0.3, 0.1, 0.03}) {
        const double distance = 5.0 / std::tan(glm::radians(degrees / 2.0));
        double most = 0.0, allowed = 0.0;
        Random random(1);
        for (int turn = 0; turn < 40; ++turn) {
            const glm::dvec3 eye = distance * random.direction();
            const glm::dmat4 view = glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0.1, 0.2, 1.0));
            const glm::dmat4 projection =
                glm::perspective(glm::radians(degrees), 4.0 / 3.0, distance - 4.0, distance + 17.0);
            const double rounding = std::ldexp(3.0, -24); // of coordinates up to 3
            const DrawnError error = gnomon::drawnError(projection * view, projection, width, rounding, 0.0);
            for (int i = 0; i < 100; ++i) {
                const glm::dvec3 point(glm::vec3(random.inCube(2.0)));
                const glm::dvec3 off = glm::abs(drawn(projection, view, point) - exact(projection, view, point));
                const double w = distance - glm::dot(point, eye) / distance;
                EXPECT_LE(0.5 * off.z, error.depth / w) << degrees;
                EXPECT_LE(0.5 * width * off.x, error.pixels / w) << degrees;
                most = std::max(most, 0.5 * off.z);
                allowed = std::max(allowed, error.depth / w);
            }
        }
        EXPECT_GT(most, 0.02 * allowed) << degrees << ": or what is seen is given up for nothing";
    }
}

} // namespace
