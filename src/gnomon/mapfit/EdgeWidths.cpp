// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/mapfit/EdgeWidths.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <climits>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

constexpr int directions = 6; // of edges, over half a turn
constexpr double halfTurn = 3.14159265358979323846;

/// Change of x/w and y/w along two ways on a surface.
glm::dmat2 slopeOf(const glm::dmat4& matrix, const glm::dvec4& at, const glm::dvec3& u, const glm::dvec3& v) {
    const auto along = [&](const glm::dvec3& way) {
        const glm::dvec4 change = matrix * glm::dvec4(way, 0.0);
        return (glm::dvec2(change) - glm::dvec2(at) / at.w * change.w) / at.w;
    };
    return {along(u), along(v)};
}

/// The longer side of a pixel, squared, in the map.
double longest(const glm::dmat2& mapFromPicture) {
    return std::max(glm::dot(mapFromPicture[0], mapFromPicture[0]), glm::dot(mapFromPicture[1], mapFromPicture[1]));
}

/// Of a way in pixels.
double riseOf(const glm::dvec2& way) {
    const glm::dvec2 along = glm::abs(way);
    return std::min(along.x, along.y) / std::max(along.x, along.y);
}

double sampledBy(double rise) {
    constexpr double bent = 1.08; // to straight ones: on the tuning scenes of gnomonchart
    return std::min(bent * sampledEdgeOf(rise), 0.5);
}

/// How far off what is so wide is among places so far apart: it is lost, or drawn as wide as they are apart.
double lostWidth(double across, double apart) { return across < apart ? apart : 0.0; }

} // namespace

EdgeWidths::EdgeWidths(const glm::dmat4& clipFromScene, const glm::dvec2& pixels)
    : _clipFromScene(clipFromScene), _sceneFromClip(glm::inverse(clipFromScene)), _pixels(pixels) {}

/// Sides of a pixel in the map on what faces the eye: neither nearer nor farther along the picture.
glm::dmat2 EdgeWidths::facing(const glm::dvec4& clip, const glm::dmat4& mapFromScene) const {
    const glm::dmat4 mapFromClip = mapFromScene * _sceneFromClip;
    const glm::dvec4 there = clip / clip.w;
    const glm::dvec3 x(2.0 / _pixels.x, 0.0, 0.0), y(0.0, 2.0 / _pixels.y, 0.0);
    return slopeOf(mapFromClip, mapFromClip * there, x, y);
}

/// An edge along a way in the map is moved across it. In the picture the area between its two places is the determinant times
/// as large, and it is that area divided by its length there that it moves.
void EdgeWidths::add(const SeenPlace& place, const glm::dmat4& mapFromScene) {
    constexpr double shortened = 16.0; // as in map.frag
    const glm::dvec4 here(place.place, 1.0), clip = _clipFromScene * here, map = mapFromScene * here;
    if (!(clip.w > 0.0) || !(map.w > 0.0)) return;
    const auto [u, v] = across(glm::normalize(place.normal));
    const glm::dmat2 inMap = slopeOf(mapFromScene, map, u, v);
    glm::dmat2 inPicture = slopeOf(_clipFromScene, clip, u, v);
    for (int column = 0; column < 2; ++column) inPicture[column] *= _pixels / 2.0;
    const glm::dmat2 pictureFromMap = inPicture * glm::inverse(inMap);
    const glm::dmat2 mapFromPicture = glm::inverse(pictureFromMap);
    const double area = std::abs(glm::determinant(pictureFromMap));
    const bool slanted = longest(mapFromPicture) > shortened * longest(facing(clip, mapFromScene));
    const auto add = [&](const glm::dvec2& way, double length) {
        const double width = area * glm::length(mapFromPicture * way) / glm::length(way);
        if (length * place.share > 0.0 && width > 0.0 && std::isfinite(width))
            addEdge({width, length * place.share, place.across, riseOf(way), place.folded, slanted});
    };
    if (place.edge != glm::dvec2(0.0)) return add(place.edge * _pixels, 1.0);
    for (int i = 0; i < directions; ++i) {
        const double angle = halfTurn * i / directions;
        const glm::dvec2 way = inPicture * glm::dvec2(std::cos(angle), std::sin(angle));
        add(way, glm::length(way) / directions);
    }
}

void EdgeWidths::addEdge(const Edge& edge) {
    constexpr double kinds = 8.0; // of widths, an octave: so they are sorted sooner
    const auto step = [](double of) {
        return of > 0.0 && std::isfinite(of) ? int(std::floor(kinds * std::log2(of))) : INT_MAX;
    };
    const int rise = int(std::floor(kinds * edge.rise));
    Edge& all = _edges[{step(edge.width), step(edge.across), rise, edge.folded, edge.slanted}];
    const double before = all.length / (all.length + edge.length);
    const double width = before * all.width + (1.0 - before) * edge.width;
    const double length = all.length + edge.length;
    all = edge;
    all.width = width;
    all.length = length;
}

/// The share of all edges that is off by no more than x grows with x by pieces: those that are off by less count whole.
double EdgeWidths::usual(double share, const Off& off) const {
    std::vector<std::pair<double, double>> edges; // how far off, and how long
    double all = 0.0, slope = 0.0, whole = 0.0;
    for (const auto& [like, edge] : _edges) {
        edges.emplace_back(off(edge), edge.length);
        all += edge.length;
        slope += edges.back().first > 0.0 ? edge.length / edges.back().first : 0.0;
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [most, length] : edges) {
        const double reached = (share * all - whole) / slope;                      // if it lies before this edge's
        if (reached <= most) return std::min(reached / share, edges.back().first); // not by rounding beyond all
        whole += length;
        slope -= most > 0.0 ? length / most : 0.0;
    }
    return edges.empty() ? 0.0 : edges.back().first;
}

/// Between two columns the drawn edge goes on level, or rises by a pixel. So above or below the true one it is off by any amount
/// between e and e - rise, or e and e + 1 - rise, with e at random: by more than a in (0.5 - a)^2 / (rise (1 - rise)) of its length.
/// The nearest place is nearer than that above or below, as if more of it were beyond: fitted to stripes.
double sampledEdgeOf(double rise) {
    constexpr double beyond = 0.05, ofNearest = 0.12;
    const double most = 0.5 - std::max(0.5 * beyond, std::sqrt(ofNearest * rise * (1.0 - rise)));
    return most / std::hypot(1.0, rise);
}

double sampledError(const EdgeWidths::Edge& edge) {
    return std::max(sampledBy(edge.rise), lostWidth(edge.across, 1.0));
}

/// A smooth edge is as hard as others where pixels are long, and next to a fold.
double mapError(const EdgeWidths::Edge& edge, const EdgeFilter& filter, double texels) {
    const double texel = edge.width / texels, sampled = sampledBy(edge.rise);
    const bool mean = filter.mean && !edge.slanted && !edge.folded;
    EdgeFilter here = filter;
    if (!filter.mean) here.pixel *= sampled / sampledEdge;
    if (filter.pixel < sampledEdge && (edge.slanted || edge.folded)) here.pixel = std::max(here.pixel, sampled);
    return std::max(mapError(here, texel), lostWidth(edge.across, mean ? texel : std::max(texel, 1.0)));
}

double mapError(const EdgeFilter& filter, double pixelsATexel) {
    return std::hypot(filter.pixel, filter.spread * pixelsATexel);
}

double polygonError(double pixelsOff) { return std::hypot(sampledEdge, pixelsOff); }

} // namespace gnomon
