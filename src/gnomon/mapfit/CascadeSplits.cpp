// SPDX-License-Identifier: MIT
#include <gnomon/mapfit/CascadeSplits.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double leastRatio = 2.0; // of a part's end to its beginning
constexpr double mostRatio = 1e6;  // of all: what is nearer than that is a rounded zero

constexpr double mostPixels = 3.0; // on a side of a texel where it is widest

/// Of the farthest to the nearest.
double ratioOf(const SeenRange& seen) {
    if (seen.empty() || !(seen.farthest > 0.0)) return 1.0;
    return seen.farthest / std::max(seen.nearest, seen.farthest / mostRatio);
}

} // namespace

SeenRange::SeenRange(const glm::dmat4& clipFromScene) : _w(glm::row(clipFromScene, 3)) {}

void SeenRange::addBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& sceneFromBox,
                       const std::vector<glm::dvec4>& halfSpaces) {
    const auto known = [this](const glm::dvec4& corner) {
        const double w = glm::dot(_w, corner);
        return nearest <= w && w <= farthest;
    };
    const std::vector<glm::dvec4> all = cornersWithin(low, high, sceneFromBox, {});
    if (std::all_of(all.begin(), all.end(), known)) return;
    for (const glm::dvec4& corner : cornersWithin(low, high, sceneFromBox, halfSpaces)) {
        nearest = std::min(nearest, glm::dot(_w, corner));
        farthest = std::max(farthest, glm::dot(_w, corner));
    }
}

int cascadesFor(const SeenRange& seen, double pixels, int before) {
    const double partRatio = std::max(leastRatio, mostPixels / pixels);
    const double asked = std::log(ratioOf(seen)) / std::log(partRatio);
    if (before > 0 && asked <= before + 0.125 && asked > before - 1.25) return before;
    return static_cast<int>(std::clamp(std::ceil(asked), 1.0, double(mostCascades)));
}

std::vector<double> cascadeSplits(const SeenRange& seen, int most) {
    const double ratio = ratioOf(seen);
    const int maps = std::clamp(static_cast<int>(std::log(ratio) / std::log(leastRatio)), 1, most);
    std::vector<double> splits;
    for (int i = 1; i < maps; ++i) splits.push_back(seen.farthest * std::pow(ratio, double(i) / maps - 1.0));
    return splits;
}

std::vector<glm::dvec4> viewPart(const glm::dmat4& clipFromScene, const std::vector<double>& splits, std::size_t part) {
    const glm::dvec4 w = glm::row(clipFromScene, 3), depth = glm::row(clipFromScene, 2), here(0.0, 0.0, 0.0, 1.0);
    std::vector<glm::dvec4> result;
    for (const int axis : {0, 1})
        for (const double sign : {1.0, -1.0}) result.push_back(w + sign * glm::row(clipFromScene, axis));
    result.push_back(part == 0 ? w + depth : w - splits[part - 1] * here);
    result.push_back(part == splits.size() ? w - depth : splits[part] * here - w);
    return result;
}

} // namespace gnomon
