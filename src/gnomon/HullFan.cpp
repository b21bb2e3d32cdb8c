// SPDX-License-Identifier: MIT
#include <gnomon/HullFan.h>

#include <algorithm>

namespace gnomon {
namespace {

/// Twice the area in plan, counter-clockwise positive.
double doubleArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Where a point's shadow falls; the ground over it, if it is not above the ground.
std::optional<glm::dvec3> shadowOf(const glm::dvec3& point, const Ground& ground, const glm::dvec4& light) {
    const auto height = ground.height(point.x, point.y);
    if (height && point.z <= *height) return glm::dvec3(point.x, point.y, *height);
    return ground.hit(point, light.w * point - glm::dvec3(light));
}

/// From the corner that sees all others; empty if none does.
Drape fanOf(const std::vector<glm::dvec3>& rim) {
    for (std::size_t start = 0; start < rim.size(); ++start) {
        Drape fan;
        double least = 0.0;
        for (std::size_t i = 1; i + 1 < rim.size(); ++i) {
            const glm::dvec3 &a = rim[start], &b = rim[(start + i) % rim.size()],
                             &c = rim[(start + i + 1) % rim.size()];
            const double area = doubleArea(a, b, c);
            least = std::min(least, area);
            if (area > 0.0) fan.insert(fan.end(), {a, b, c});
        }
        if (least == 0.0) return fan;
    }
    return {};
}

} // namespace

std::optional<Drape> hullFan(const Ground& ground, const ConvexShadow& shadow, const glm::dvec4& light) {
    std::vector<glm::dvec3> rim;
    for (const glm::dvec3& corner : shadow.silhouette) {
        const auto place = shadowOf(corner, ground, light);
        if (!place) return std::nullopt;
        rim.push_back(*place);
    }
    Drape fan = fanOf(rim);
    if (fan.empty()) return std::nullopt;
    return fan;
}

} // namespace gnomon
