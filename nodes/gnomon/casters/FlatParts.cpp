// SPDX-License-Identifier: MIT
#include <gnomon/FlatParts.h>
#include <gnomon/casters/CasterExtraction.h>

#include <osg/Vec3d>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace gnomon {
namespace {

/// A triangle about a local origin.
struct Facet {
    std::array<osg::Vec3d, 3> corners;
    osg::Vec3d normal;
    double area = 0.0;
    double altitude = 0.0; ///< the least of the three: how well the corners fix the plane.

    osg::Vec3d centre() const { return (corners[0] + corners[1] + corners[2]) / 3.0; }
};

/// Triangles of one plane. The first is the one of the largest altitude, whose plane stands for all while they are
/// gathered.
struct Part {
    Facet first;
    osg::Vec3d areaVector;
    osg::Vec3d moment; ///< area × centre.
    double area = 0.0;

    void add(const Facet& facet) {
        areaVector += facet.normal * facet.area;
        moment += facet.centre() * facet.area;
        area += facet.area;
    }
};

Facet facetOf(const std::array<osg::Vec3d, 3>& corners) {
    const osg::Vec3d sides[] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
    const double longest = std::max({sides[0].length(), sides[1].length(), sides[2].length()});
    Facet facet{corners, sides[0] ^ sides[1], 0.0, 0.0};
    facet.area = facet.normal.normalize() / 2.0;
    facet.altitude = 2.0 * facet.area / longest;
    return facet;
}

/// Gathers facets by plane. Facets come in order of falling altitude, so that a part's first fixes its plane at least
/// as well.
class Gatherer {
public:
    Gatherer(double rounding, double extent) : _rounding(rounding), _extent(extent) {}

    void add(const Facet& facet) {
        const double key = keyOf(facet);
        Part* part = find(facet, key);
        if (!part) {
            _byKey.emplace(key, _parts.size());
            part = &_parts.emplace_back(Part{facet, {}, {}, 0.0});
        }
        part->add(facet);
    }

    const std::vector<Part>& parts() const { return _parts; }

private:
    /// How far, in radians, corners that are off by the rounding can turn the normal; twice that, for both ends of a
    /// side.
    double turn(const Facet& facet) const { return 4.0 * _rounding / facet.altitude; }

    /// One number for a plane, to look neighbours up by: the direction is arbitrary, only not one that scenes favour.
    double keyOf(const Facet& facet) const {
        const osg::Vec3d askew(0.5773, 0.2113, 0.7887);
        return facet.normal * askew + facet.normal * facet.centre() / _extent;
    }

    bool agree(const Part& part, const Facet& facet) const {
        const Facet& first = part.first;
        if (!((facet.normal - first.normal).length() <= turn(first) + turn(facet))) return false;
        for (const osg::Vec3d& corner : facet.corners) {
            const osg::Vec3d way = corner - first.centre();
            if (!(std::abs(first.normal * way) <= 4.0 * _rounding + turn(first) * way.length())) return false;
        }
        return true;
    }

    /// Looks at the parts whose keys are nearest, `most` to either side: planes that agree have keys within eight
    /// turns, and nearly always much less.
    Part* find(const Facet& facet, double key) {
        constexpr int most = 128;
        const double window = 8.0 * turn(facet);
        const auto middle = _byKey.lower_bound(key);
        auto above = middle;
        for (int i = 0; i < most && above != _byKey.end() && above->first <= key + window; ++i, ++above)
            if (agree(_parts[above->second], facet)) return &_parts[above->second];
        auto below = middle;
        for (int i = 0; i < most && below != _byKey.begin() && std::prev(below)->first >= key - window; ++i) {
            --below;
            if (agree(_parts[below->second], facet)) return &_parts[below->second];
        }
        return nullptr;
    }

    double _rounding;
    double _extent;
    std::vector<Part> _parts;
    std::multimap<double, std::size_t> _byKey;
};

double farthest(const std::vector<osg::Vec3d>& vertices, const osg::Vec3d& from) {
    double result = 0.0;
    for (const osg::Vec3d& vertex : vertices) result = std::max(result, (vertex - from).length());
    return result;
}

/// Those that have a plane: a triangle no higher than a few roundings has none.
std::vector<Facet> facetsOf(const CasterExtraction& casters, const osg::Vec3d& origin, double rounding) {
    const auto& vertices = casters.getVertices();
    const auto& indices = casters.getTriangles();
    std::vector<Facet> facets;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const Facet facet = facetOf(
            {vertices[indices[i]] - origin, vertices[indices[i + 1]] - origin, vertices[indices[i + 2]] - origin});
        if (facet.altitude > 8.0 * rounding) facets.push_back(facet);
    }
    std::stable_sort(facets.begin(), facets.end(),
                     [](const Facet& a, const Facet& b) { return a.altitude > b.altitude; });
    return facets;
}

FlatPart flatPartOf(const Part& part, const osg::Vec3d& origin) {
    osg::Vec3d normal = part.areaVector;
    normal.normalize();
    return {osg::Vec4d(normal, -(normal * (origin + part.moment / part.area))), part.area};
}

} // namespace

std::vector<FlatPart> flatParts(osg::Node& root, unsigned limit) {
    CasterExtraction casters;
    root.accept(casters);
    if (casters.getTriangles().empty()) return {};

    const osg::Vec3d origin = casters.getVertices()[casters.getTriangles().front()];
    const double ownRounding = std::numeric_limits<double>::epsilon() * farthest(casters.getVertices(), {});
    const double rounding = casters.getRounding() + ownRounding;
    Gatherer gatherer(rounding, farthest(casters.getVertices(), origin));
    for (const Facet& facet : facetsOf(casters, origin, rounding)) gatherer.add(facet);

    std::vector<FlatPart> result;
    for (const Part& part : gatherer.parts()) result.push_back(flatPartOf(part, origin));
    std::stable_sort(result.begin(), result.end(),
                     [](const FlatPart& a, const FlatPart& b) { return a.area > b.area; });
    if (result.size() > limit) result.resize(limit);
    return result;
}

} // namespace gnomon
