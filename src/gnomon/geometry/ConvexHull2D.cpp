// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ConvexHull2D.h>

#include <algorithm>

namespace gnomon {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

} // namespace

std::vector<glm::dvec2> convexHull2D(std::vector<glm::dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    std::vector<glm::dvec2> hull;
    for (const bool back : {false, true}) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= start + 2 && !(cross(hull.back() - hull[hull.size() - 2], point - hull.back()) > 0.0))
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back(); // the other half begins with it
        if (!back) std::reverse(points.begin(), points.end());
    }
    return hull;
}

std::vector<glm::dvec2> grownOutline(const std::vector<glm::dvec2>& corners, const glm::dvec2& by) {
    std::vector<glm::dvec2> wider;
    for (const glm::dvec2& corner : corners)
        for (const double x : {-by.x, by.x})
            for (const double y : {-by.y, by.y}) wider.push_back(corner + glm::dvec2(x, y));
    return convexHull2D(std::move(wider));
}

} // namespace gnomon
