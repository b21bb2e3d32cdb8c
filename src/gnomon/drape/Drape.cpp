// SPDX-License-Identifier: MIT
#include <gnomon/drape/Drape.h>

#include <algorithm>

namespace gnomon {

double heightError(double error, double tangent, double slope) { return std::max(0.0, error * (tangent - slope)); }

Drape drape(const Ground& ground, const ConvexShadow& shadow, double error) {
    Drape result;
    Clipper clipper;
    ground.cover(shadow.planes, error, [&](const GroundTriangle& triangle, PlaneSet inside) {
        const Clipper::Polygon polygon = clipper.clip(triangle, shadow.planes, inside);
        for (std::size_t i = 2; i < polygon.size; ++i)
            for (const std::size_t k : {std::size_t(0), i - 1, i}) result.push_back(polygon.corners[k].place);
    });
    return result;
}

} // namespace gnomon
