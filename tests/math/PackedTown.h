// SPDX-License-Identifier: MIT
#pragma once
#include "GroundTriangles.h"
#include "Houses.h"

#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/onterrain/PackedShadows.h>

namespace test {

/// Of a ground's side.
constexpr int posts = 160;

/// Of packed shadows' corners.
const glm::dvec3 origin(800.0, 800.0, 20.0);

inline std::vector<gnomon::ConvexPart> townOn(const gnomon::Ground& ground, int count) {
    std::vector<gnomon::ConvexPart> parts;
    for (const Prism& prism : prismsOn(ground, glm::dvec2(300.0), glm::dvec2(1290.0), count, 1))
        for (gnomon::ConvexPart& part : prism.parts()) parts.push_back(std::move(part));
    return parts;
}

inline glm::dvec4 sun(double azimuth, double elevation) { return glm::dvec4(sunAt(azimuth, elevation), 0.0); }

inline gnomon::PackedShadows found(const gnomon::Ground& ground, const gnomon::PackedParts& parts,
                                   const glm::dvec4& light, gnomon::TerrainMethod method = gnomon::TerrainMethod::hull,
                                   double error = 0.1, const gnomon::ShadowKernel* kernel = nullptr) {
    gnomon::PackedShadows shadows;
    packedShadows(ground, parts, light, method, error, origin, shadows, kernel);
    return shadows;
}

} // namespace test
