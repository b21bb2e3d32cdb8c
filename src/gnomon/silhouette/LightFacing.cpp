// SPDX-License-Identifier: MIT
#include <gnomon/silhouette/LightFacing.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace gnomon {
namespace {

constexpr double grazing = 1e-5;       // radians
constexpr std::size_t block = 1 << 14; // triangles that are worth a task

using Part = SilhouetteMesh::Part;

/// The weights of a triangle that faces the light, of one that is edge-on to it, and of one that is turned away.
struct Weights {
    std::int8_t facing, edgeOn, turned;
};

/// What a lamp lies in, as in a ceiling, takes no light from it.
Weights weightsOf(const Part& part, const glm::dvec4& light) {
    if (light.w != 0.0 && part.boundsHold(glm::dvec3(light))) return {1, 0, -1};
    if (!part.closed) return {1, 1, -1};
    return part.inward ? Weights{0, 0, -1} : Weights{1, 1, 0};
}

/// How far a light may be off a plane that it grazes.
double toleranceOf(const Part& part, const glm::dvec4& light) {
    if (light.w == 0.0) return grazing;
    const glm::dvec3 at(light), low(part.low), high(part.high);
    return grazing * glm::length(glm::max(glm::abs(at - low), glm::abs(high - at)));
}

double sideOf(double x, double y, double z, double d, const glm::dvec4& light) {
    return x * light.x + y * light.y + z * light.z + d * light.w;
}

void faceLight(const SilhouetteMesh& mesh, const Part& part, const glm::dvec4& light, std::size_t first,
               std::size_t end, std::int8_t* weights) {
    const Weights of = weightsOf(part, light);
    const double least = toleranceOf(part, light);
    // By pointers of its own: weights are chars, and a write of these might change the mesh's.
    const double *x = mesh.planeX.data(), *y = mesh.planeY.data(), *z = mesh.planeZ.data(), *d = mesh.planeD.data();
    for (std::size_t i = first; i < end; ++i) {
        const double side = sideOf(x[i], y[i], z[i], d[i], light);
        weights[i] = side > least ? of.facing : side >= -least ? of.edgeOn : of.turned;
    }
}

} // namespace

void faceLight(const SilhouetteMesh& mesh, const glm::dvec4& light, FacingWeights& weights) {
    weights.resize(mesh.triangles() + 1);
    weights.back() = 0;
    const auto faceParts = [&](const tbb::blocked_range<std::size_t>& parts) {
        for (std::size_t p = parts.begin(); p < parts.end(); ++p) {
            const Part& part = mesh.parts[p];
            const std::size_t end = std::size_t(part.firstTriangle) + part.triangles;
            if (part.triangles <= block) {
                faceLight(mesh, part, light, part.firstTriangle, end, weights.data());
                continue;
            }
            tbb::parallel_for(tbb::blocked_range<std::size_t>(part.firstTriangle, end, block), [&](const auto& some) {
                faceLight(mesh, part, light, some.begin(), some.end(), weights.data());
            });
        }
    };
    const std::size_t grain = 1 + mesh.parts.size() * block / (mesh.triangles() + 1);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.parts.size(), grain), faceParts);
    for (const SilhouetteMesh::Thin& thin : mesh.thin) weights[thin.triangle] = weights[thin.like];
}

bool grazes(const SilhouetteMesh& mesh, const Part& part, const glm::dvec4& light, std::size_t triangle) {
    const glm::dvec3 normal(mesh.planeX[triangle], mesh.planeY[triangle], mesh.planeZ[triangle]);
    const double side = sideOf(normal.x, normal.y, normal.z, mesh.planeD[triangle], light);
    return normal != glm::dvec3(0.0) && std::abs(side) <= toleranceOf(part, light);
}

} // namespace gnomon
