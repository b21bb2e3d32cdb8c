// SPDX-License-Identifier: MIT
#include <gnomon/Drape.h>

#include <algorithm>

namespace gnomon {

double heightError(double error, double tangent, double slope) { return std::max(0.0, error * (tangent - slope)); }

Drape drape(const Ground& ground, const ConvexShadow& shadow, double error) {
    Drape result;
    Clipper clipper;
    ground.cover(shadow.planes, error, [&](const GroundTriangle& triangle, PlaneSet inside) {
        const std::vector<glm::dvec3>& polygon = clipper.clip(triangle, shadow.planes, inside);
        for (std::size_t i = 2; i < polygon.size(); ++i)
            result.insert(result.end(), {polygon[0], polygon[i - 1], polygon[i]});
    });
    return result;
}

} // namespace gnomon
