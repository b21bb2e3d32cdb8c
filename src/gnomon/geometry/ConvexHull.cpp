// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ConvexHull.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <libqhullcpp/Qhull.h>
#include <libqhullcpp/QhullError.h>
#include <libqhullcpp/QhullFacetList.h>
#include <libqhullcpp/QhullVertexSet.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double flatness = 1e-12; // of the size: what is thinner is a plate, or a line

using Points = std::vector<glm::dvec3>;

bool isFinite(const glm::dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Points about their middle, so that far from the origin nothing is lost.
struct Cloud {
    Points points;
    glm::dvec3 middle{0.0};
    double size = 0.0;
};

Cloud cloudOf(const Points& given) {
    Cloud cloud;
    std::copy_if(given.begin(), given.end(), std::back_inserter(cloud.points), isFinite);
    if (cloud.points.empty()) return cloud;
    glm::dvec3 low = cloud.points.front(), high = low;
    for (const glm::dvec3& p : cloud.points) low = glm::min(low, p), high = glm::max(high, p);
    cloud.middle = 0.5 * (low + high);
    cloud.size = glm::length(high - low);
    for (glm::dvec3& p : cloud.points) p -= cloud.middle;
    return cloud;
}

template <typename Measure>
const glm::dvec3& farthest(const Points& points, const Measure& measure) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const auto& a, const auto& b) { return measure(a) < measure(b); });
}

/// Two directions in the points' plane, if it is one, and how far the points lie off it.
struct Frame {
    glm::dvec3 along{0.0}, across{0.0};
    double width = 0.0, thickness = 0.0;
};

Frame frameOf(const Cloud& cloud) {
    const Points& points = cloud.points;
    const glm::dvec3 start = farthest(points, [](const auto& p) { return glm::length(p); });
    const glm::dvec3 end = farthest(points, [&](const auto& p) { return glm::length(p - start); });
    Frame frame;
    frame.along = glm::normalize(end - start);
    const auto aside = [&](const glm::dvec3& p) {
        return (p - start) - glm::dot(p - start, frame.along) * frame.along;
    };
    const glm::dvec3 side = aside(farthest(points, [&](const auto& p) { return glm::length(aside(p)); }));
    frame.width = glm::length(side);
    if (!(frame.width > flatness * cloud.size)) return frame;
    frame.across = side / frame.width;
    const glm::dvec3 normal = glm::cross(frame.along, frame.across);
    for (const glm::dvec3& p : points)
        frame.thickness = std::max(frame.thickness, std::abs(glm::dot(p - start, normal)));
    return frame;
}

class Builder {
public:
    Builder(const Cloud& cloud) : _cloud(cloud), _place(cloud.points.size(), ~0u) {}

    unsigned vertex(int point) {
        unsigned& place = _place[static_cast<std::size_t>(point)];
        if (place == ~0u) {
            place = static_cast<unsigned>(hull.vertices.size());
            hull.vertices.push_back(_cloud.points[static_cast<std::size_t>(point)] + _cloud.middle);
        }
        return place;
    }

    /// @param normal  unit, outwards; the plane goes through the first corner.
    void face(std::vector<unsigned> corners, const glm::dvec3& normal) {
        const glm::dvec4 plane(normal, -glm::dot(normal, hull.vertices[corners.front()]));
        hull.faces.push_back({std::move(corners), plane});
    }

    ConvexHull hull;

private:
    const Cloud& _cloud;
    std::vector<unsigned> _place; ///< of a point among the hull's vertices.
};

ConvexHull solid(const Cloud& cloud) {
    orgQhull::Qhull qhull;
    qhull.runQhull("", 3, static_cast<int>(cloud.points.size()), &cloud.points.front().x, "Qt Pp"); // Pp: no warnings
    Builder builder(cloud);
    for (const orgQhull::QhullFacet& facet : qhull.facetList()) {
        std::vector<unsigned> corners;
        for (const orgQhull::QhullVertex& vertex : facet.vertices())
            corners.push_back(builder.vertex(vertex.point().id()));
        const double* n = facet.hyperplane().coordinates();
        const glm::dvec3 normal(n[0], n[1], n[2]);
        const Points& v = builder.hull.vertices;
        if (glm::dot(glm::cross(v[corners[1]] - v[corners[0]], v[corners[2]] - v[corners[0]]), normal) < 0.0)
            std::swap(corners[1], corners[2]);
        builder.face(corners, normal);
    }
    return builder.hull;
}

/// Corners of the plate in order, found by turning round its middle.
ConvexHull plate(const Cloud& cloud, const Frame& frame) {
    std::vector<double> flat;
    for (const glm::dvec3& p : cloud.points)
        flat.insert(flat.end(), {glm::dot(p, frame.along), glm::dot(p, frame.across)});
    orgQhull::Qhull qhull;
    qhull.runQhull("", 2, static_cast<int>(cloud.points.size()), flat.data(), "Pp");
    std::vector<int> outline;
    double x = 0.0, y = 0.0;
    for (const orgQhull::QhullVertex& vertex : qhull.vertexList()) {
        outline.push_back(vertex.point().id());
        x += vertex.point()[0], y += vertex.point()[1];
    }
    x /= double(outline.size()), y /= double(outline.size());
    const auto angle = [&](int i) {
        return std::atan2(flat[2 * std::size_t(i) + 1] - y, flat[2 * std::size_t(i)] - x);
    };
    std::sort(outline.begin(), outline.end(), [&](int a, int b) { return angle(a) < angle(b); });
    Builder builder(cloud);
    std::vector<unsigned> corners;
    for (const int point : outline) corners.push_back(builder.vertex(point));
    const glm::dvec3 normal = glm::cross(frame.along, frame.across);
    builder.face(corners, normal);
    builder.face({corners.rbegin(), corners.rend()}, -normal);
    return builder.hull;
}

} // namespace

std::optional<ConvexHull> convexHull(const std::vector<glm::dvec3>& points) {
    const Cloud cloud = cloudOf(points);
    if (!(cloud.size > 0.0)) return std::nullopt;
    const Frame frame = frameOf(cloud);
    if (!(frame.width > flatness * cloud.size)) return std::nullopt;
    try {
        return frame.thickness > flatness * cloud.size ? solid(cloud) : plate(cloud, frame);
    } catch (const orgQhull::QhullError&) {
        return std::nullopt; // a needle, too thin for its precision
    }
}

} // namespace gnomon
