// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/TriangleGround.h>

#include <gnomon/ground/HeightField.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <numeric>

namespace test {

/// Up to 25 degrees steep.
inline double steepHills(double x, double y) {
    return 25.0 * std::sin(x * 0.011) * std::cos(y * 0.013) + 4.0 * std::sin(x * 0.05);
}

/// As a mesh file has them: no vertex shared.
struct LooseTriangles {
    std::vector<glm::dvec3> vertices;
    std::vector<unsigned> indices;

    explicit LooseTriangles(const std::vector<gnomon::GroundTriangle>& triangles) {
        for (const gnomon::GroundTriangle& t : triangles) vertices.insert(vertices.end(), t.begin(), t.end());
        indices.resize(vertices.size());
        std::iota(indices.begin(), indices.end(), 0u);
    }
    gnomon::TriangleGround ground() const { return {vertices, indices}; }
};

/// Every cell that is no hole, moved by `offset`, each second triangle clockwise.
inline std::vector<gnomon::GroundTriangle> trianglesOf(const gnomon::HeightField& field,
                                                       const glm::dvec3& offset = {}) {
    std::vector<gnomon::GroundTriangle> triangles;
    for (int y = 0; y + 1 < field.rows(); ++y)
        for (int x = 0; x + 1 < field.columns(); ++x) {
            if (field.isHole(x, y)) continue;
            const auto [a, b] = field.triangles(x, y);
            triangles.push_back({a[0] + offset, a[1] + offset, a[2] + offset});
            triangles.push_back({b[0] + offset, b[2] + offset, b[1] + offset});
        }
    return triangles;
}

} // namespace test
