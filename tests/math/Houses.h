// SPDX-License-Identifier: MIT
#pragma once
#include "support/Drawn.h"
#include "support/TerrainTrial.h"

#include <gnomon/ground/HeightPyramid.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace test {

/// A house: its middle, half sides, turn and roof; it goes down as far as there is ground.
struct House {
    glm::dvec2 middle, half;
    double turn, roof;

    glm::dvec2 local(const glm::dvec2& v) const {
        return {v.x * std::cos(turn) + v.y * std::sin(turn), v.y * std::cos(turn) - v.x * std::sin(turn)};
    }
    std::vector<glm::dvec3> corners() const {
        std::vector<glm::dvec3> result;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec2 c(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y);
            result.emplace_back(middle.x + c.x * std::cos(turn) - c.y * std::sin(turn),
                                middle.y + c.x * std::sin(turn) + c.y * std::cos(turn), i & 4 ? roof : -200.0);
        }
        return result;
    }
    /// Whether a ray enters the box, by slabs in its own frame.
    bool blocks(const glm::dvec3& from, const glm::dvec3& sun) const {
        const glm::dvec2 p = local(glm::dvec2(from) - middle), d = local(glm::dvec2(sun));
        double enter = 0.0, leave = (roof - from.z) / sun.z;
        for (int axis = 0; axis < 2; ++axis) {
            const double a = (-half[axis] - p[axis]) / d[axis], b = (half[axis] - p[axis]) / d[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        return enter <= leave;
    }
};

constexpr double pitch = 10.0;

/// Ground over a square of posts × posts, by its height.
inline gnomon::HeightPyramid groundOf(double (*height)(double, double), int posts, double base = 0.0) {
    std::vector<float> heights;
    for (int j = 0; j < posts; ++j)
        for (int i = 0; i < posts; ++i) heights.push_back(static_cast<float>(height(i * pitch, j * pitch)));
    return gnomon::HeightPyramid({posts, posts, {0.0, 0.0}, {pitch, pitch}, heights, base});
}

inline std::vector<House> houses(int count, const gnomon::Ground& ground) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit;
    std::vector<House> result;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 at = 300.0 + 700.0 * test::drawn(unit, random);
        result.push_back({at,
                          {4.0 + 8.0 * unit(random), 4.0 + 8.0 * unit(random)},
                          180.0 * degree * unit(random),
                          *ground.height(at.x, at.y) + 5.0 + 25.0 * unit(random)});
    }
    return result;
}

/// Of triangles; those that are clockwise count as less than nothing.
inline double areaInPlan(const gnomon::BoxTriangles& triangles) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const glm::dvec2 a(triangles[i]), b(triangles[i + 1]), c(triangles[i + 2]);
        sum += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    return sum;
}

} // namespace test
