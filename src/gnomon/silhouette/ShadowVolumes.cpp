// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/silhouette/ShadowVolumes.h>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

using Outline = ShadowVolumes::Outline;
constexpr std::size_t block = 1 << 14; // edges that are worth a task

/// Edges in runs, each with room of its own in the outline.
struct Run {
    std::size_t part, first, end, found;
    bool grazed;
};

/// Finds the outline that some edges have. Room for all is needed, for each is written before it is known to count. A sheet has no
/// wall that lies in another body's: of hills, where the light grazes a facet here and there, edges would only move.
void findOutline(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, Run& run, Outline* into) {
    const std::int8_t* weights = volumes.weights.data();
    const SilhouetteMesh::Part& part = mesh.parts[run.part];
    const auto isGrazed = [&](unsigned triangle) {
        return part.closed && triangle < mesh.triangles() && grazes(mesh, part, volumes.light, triangle);
    };
    std::size_t count = 0;
    for (std::size_t i = run.first; i < run.end; ++i) {
        const SilhouetteMesh::Edge& edge = mesh.edges[i];
        const int times = weights[edge.left] - weights[edge.right];
        const bool on = times > 0;
        into[count] = {on ? edge.from : edge.to, on ? edge.to : edge.from};
        if (times != 0 && !run.grazed) run.grazed = isGrazed(edge.left) || isGrazed(edge.right);
        count += times != 0;
        if (times == 2 || times == -2) into[count] = into[count - 1], ++count;
    }
    run.found = count;
}

std::vector<Run> runsOf(const SilhouetteMesh& mesh) {
    std::vector<Run> runs;
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
        const SilhouetteMesh::Part& part = mesh.parts[p];
        for (std::size_t first = 0; first < part.edges; first += block)
            runs.push_back({p, part.firstEdge + first,
                            part.firstEdge + std::min<std::size_t>(part.edges, first + block), 0, false});
    }
    return runs;
}

/// Not more layers than half of the edges that any line across the light meets, along either of two axes.
class LayerBound {
public:
    LayerBound(const SilhouetteMesh& mesh, const ShadowVolumes& volumes) : _mesh(mesh), _volumes(volumes) {}

    unsigned of(std::size_t index) const {
        const ShadowVolumes::Part& part = _volumes.parts[index];
        const unsigned most = part.edges / 3 + 1;
        if (most <= 8) return most;
        const glm::dvec3 middle = (glm::dvec3(_mesh.parts[index].low) + glm::dvec3(_mesh.parts[index].high)) / 2.0;
        const glm::dvec3 along = glm::normalize(awayFrom(_volumes.light, middle));
        const Across axes = across(along);
        std::vector<glm::dvec2> lines;
        for (const Outline *edge = _volumes.outline.data() + part.firstEdge, *end = edge + part.edges; edge != end;
             ++edge)
            for (const unsigned vertex : {edge->from, edge->to}) {
                const glm::dvec3 away = awayFrom(_volumes.light, glm::dvec3(_mesh.vertices[vertex]));
                const double depth = _volumes.light.w == 0.0 ? 1.0 : glm::dot(away, along);
                if (!(depth > 0.0)) return most; // on all sides of a lamp
                const glm::dvec3 at = _volumes.light.w == 0.0 ? glm::dvec3(_mesh.vertices[vertex]) : away / depth;
                lines.emplace_back(glm::dot(at, axes.u), glm::dot(at, axes.v));
            }
        return std::min({most, stabbed(lines, 0) / 2, stabbed(lines, 1) / 2});
    }

private:
    /// @param ends  two points an edge.
    static unsigned stabbed(const std::vector<glm::dvec2>& ends, int axis) {
        constexpr int bins = 1024;
        double low = ends[0][axis], high = low;
        for (const glm::dvec2& end : ends) low = std::min(low, end[axis]), high = std::max(high, end[axis]);
        const double scale = high > low ? (bins - 1) / (high - low) : 0.0;
        std::array<int, bins + 1> change{};
        for (std::size_t i = 0; i < ends.size(); i += 2) {
            const auto bin = [&](std::size_t end) { return static_cast<std::size_t>((ends[end][axis] - low) * scale); };
            ++change[std::min(bin(i), bin(i + 1))];
            --change[std::max(bin(i), bin(i + 1)) + 1];
        }
        int now = 0, most = 0;
        for (const int step : change) most = std::max(most, now += step);
        return static_cast<unsigned>(most);
    }

    const SilhouetteMesh& _mesh;
    const ShadowVolumes& _volumes;
};

/// Puts the sides and the end of part after part into the arrays.
class Writer {
public:
    Writer(const SilhouetteMesh& mesh, ShadowVolumes& volumes)
        : _mesh(mesh), _volumes(volumes), _places(mesh.vertices.size(), {~0u, 0}) {}

    void add(unsigned index) {
        ShadowVolumes::Part& part = _volumes.parts[index];
        part.first = static_cast<unsigned>(_volumes.corners.size());
        if (part.edges == 0) return;
        const Outline *first = _volumes.outline.data() + part.firstEdge, *end = first + part.edges;
        for (const Outline* edge = first; edge != end; ++edge) {
            const unsigned a = placeOf(index, edge->from), b = placeOf(index, edge->to);
            triangle(a, a + 1, b + 1);
            triangle(a, b + 1, b);
        }
        part.count = static_cast<unsigned>(_volumes.corners.size()) - part.first;
    }

private:
    struct Place {
        unsigned part, vertex;
    };
    unsigned placeOf(unsigned part, unsigned vertex) {
        Place& place = _places[vertex];
        if (place.part == part) return place.vertex;
        place = {part, static_cast<unsigned>(_volumes.vertices.size())};
        const glm::vec3& at = _mesh.vertices[vertex];
        const double length = lengthTo(_volumes.parts[part].end, glm::dvec3(at), _volumes.light);
        _volumes.vertices.emplace_back(at, 0.0f);
        _volumes.vertices.emplace_back(at, static_cast<float>(length));
        return place.vertex;
    }
    void triangle(unsigned a, unsigned b, unsigned c) { _volumes.corners.insert(_volumes.corners.end(), {a, b, c}); }

    const SilhouetteMesh& _mesh;
    ShadowVolumes& _volumes;
    std::vector<Place> _places;
};

/// Of all parts, one after the other.
void findOutline(const SilhouetteMesh& mesh, ShadowVolumes& into) {
    std::vector<Run> runs = runsOf(mesh);
    into.outline.resize(2 * mesh.edges.size() + 1);
    const std::size_t grain = 1 + runs.size() * block / (mesh.edges.size() + 1);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs.size(), grain), [&](const auto& some) {
        for (std::size_t i = some.begin(); i < some.end(); ++i) {
            Run& run = runs[i];
            findOutline(mesh, into, run, into.outline.data() + 2 * run.first);
        }
    });
    std::size_t used = 0;
    for (const Run& run : runs) {
        ShadowVolumes::Part& part = into.parts[run.part];
        if (part.edges == 0) part.firstEdge = static_cast<unsigned>(used);
        const auto first = into.outline.begin() + static_cast<std::ptrdiff_t>(2 * run.first);
        std::copy_n(first, run.found, into.outline.begin() + static_cast<std::ptrdiff_t>(used));
        part.edges += static_cast<unsigned>(run.found);
        part.grazed = part.grazed || run.grazed;
        used += run.found;
    }
}

/// The triangles that cast, turned to the light; or at infinity, turned away.
void appendSurface(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, bool atInfinity,
                   VolumeCaps& into) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        if (volumes.weights[i] == 0) continue;
        const unsigned* of = mesh.corners.data() + 3 * i;
        const bool turned = (volumes.weights[i] < 0) != atInfinity;
        for (const unsigned corner : {of[0], of[turned ? 2 : 1], of[turned ? 1 : 2]}) {
            into.corners.push_back(static_cast<unsigned>(into.vertices.size()));
            into.vertices.emplace_back(mesh.vertices[corner], atInfinity ? -1.0f : 0.0f);
        }
    }
}

/// From one of its vertices over the whole end: what it covers twice, it covers from either side.
void appendFan(const ShadowVolumes& volumes, const ShadowVolumes::Part& part, VolumeCaps& into) {
    const unsigned* sides = volumes.corners.data() + part.first;
    for (unsigned i = 0; i < part.count; i += 6)
        for (const unsigned corner : {sides[1], sides[i + 2], sides[i + 1]}) {
            into.corners.push_back(static_cast<unsigned>(into.vertices.size()));
            into.vertices.push_back(volumes.vertices[corner]);
        }
}

constexpr double margin = 1e-3;   // of the receivers' size
constexpr double flattest = 0.02; // sine of the angle between the way of the light and a plane
constexpr double never = std::numeric_limits<double>::infinity();

glm::dvec3 cornerOf(const glm::dvec3& low, const glm::dvec3& high, unsigned i) {
    return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
}

/// The longest way from a corner of a box to a plane; infinite if there is none.
double longestTo(const glm::dvec4& plane, const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light) {
    double longest = 0.0;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = cornerOf(low, high, i), away = awayFrom(light, corner);
        const double steepness = -glm::dot(glm::dvec3(plane), away), length = glm::length(away);
        if (!(steepness >= flattest * length && length > 0.0)) return never;
        longest = std::max(longest, distance(plane, corner) / steepness * length);
    }
    return longest;
}

} // namespace

void findShadowVolumes(const SilhouetteMesh& mesh, const glm::dvec4& light, const std::vector<glm::dvec4>& planes,
                       ShadowVolumes& into) {
    into.light = light;
    into.vertices.clear();
    into.corners.clear();
    into.parts.assign(mesh.parts.size(), {});
    faceLight(mesh, light, into.weights);
    findOutline(mesh, into);
    const LayerBound layers(mesh, into);
    Writer writer(mesh, into);
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        ShadowVolumes::Part& part = into.parts[i];
        part.end = nearestEnd(planes, glm::dvec3(mesh.parts[i].low), glm::dvec3(mesh.parts[i].high), light);
        part.layers = std::max(1u, layers.of(i));
        writer.add(static_cast<unsigned>(i));
    }
}

void appendLightCap(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into) {
    appendSurface(mesh, volumes, index, false, into);
}

void appendDarkCap(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into) {
    const ShadowVolumes::Part& volume = volumes.parts[index];
    if (volume.end != glm::dvec4(0.0))
        appendFan(volumes, volume, into);
    else if (volumes.light.w != 0.0)
        appendSurface(mesh, volumes, index, true, into);
}

std::vector<glm::dvec4> endPlanes(const glm::dvec3& low, const glm::dvec3& high) {
    const double away = margin * glm::distance(low, high);
    std::vector<glm::dvec4> planes;
    if (!std::isfinite(away)) return planes;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec4 plane(0.0);
        plane[axis] = 1.0;
        plane.w = away - low[axis];
        planes.push_back(plane);
        plane[axis] = -1.0;
        plane.w = away + high[axis];
        planes.push_back(plane);
    }
    return planes;
}

glm::dvec4 nearestEnd(const std::vector<glm::dvec4>& planes, const glm::dvec3& low, const glm::dvec3& high,
                      const glm::dvec4& light) {
    glm::dvec4 nearest(0.0);
    double least = never;
    for (const glm::dvec4& plane : planes) {
        const double longest = longestTo(plane, low, high, light);
        if (longest < least) least = longest, nearest = plane;
    }
    return nearest;
}

double lengthTo(const glm::dvec4& plane, const glm::dvec3& place, const glm::dvec4& light) {
    const double steepness = -glm::dot(glm::dvec3(plane), awayFrom(light, place));
    if (!(steepness > 0.0)) return -1.0;
    return std::max(0.0, distance(plane, place) / steepness);
}

} // namespace gnomon
