// SPDX-License-Identifier: MIT
#include <gnomon/Plane.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/geometry/TerminatorOffset.h>
#include <gnomon/silhouette/ShadowVolumes.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double grazing = 1e-5;       // radians
constexpr std::size_t block = 1 << 14; // triangles, or edges, that are worth a task

using Part = SilhouetteMesh::Part;
using Outline = ShadowVolumes::Outline;

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

void faceLight(const SilhouetteMesh& mesh, const Part& part, const glm::dvec4& light,
               const tbb::blocked_range<std::size_t>& triangles, std::int8_t* weights) {
    const Weights of = weightsOf(part, light);
    const double least = toleranceOf(part, light);
    // By pointers of its own: weights are chars, and a write of these might change the mesh's.
    const double *x = mesh.planeX.data(), *y = mesh.planeY.data(), *z = mesh.planeZ.data(), *d = mesh.planeD.data();
    for (std::size_t i = triangles.begin(); i < triangles.end(); ++i) {
        const double side = sideOf(x[i], y[i], z[i], d[i], light);
        weights[i] = side > least ? of.facing : side >= -least ? of.edgeOn : of.turned;
    }
}

/// A closed part casts by the triangles that face the light, and one turned inside out by those that do not. An open part,
/// and a closed one in whose bounds a lamp is, casts by all, each turned to the light: what of it is between the light and a
/// point is then counted once, whatever its winding.
///
/// Each triangle is asked once, in double: its two neighbours at an edge then agree. One that the light grazes, to 1e-5 of a
/// radian, faces it: else the volume's side would lie in it.
void faceLight(const SilhouetteMesh& mesh, const glm::dvec4& light, std::vector<std::int8_t>& weights) {
    weights.resize(mesh.triangles() + 1);
    weights.back() = 0;
    const auto faceParts = [&](const tbb::blocked_range<std::size_t>& parts) {
        for (std::size_t p = parts.begin(); p < parts.end(); ++p) {
            const Part& part = mesh.parts[p];
            const tbb::blocked_range<std::size_t> all(part.firstTriangle,
                                                      std::size_t(part.firstTriangle) + part.triangles, block);
            const auto face = [&](const auto& some) { faceLight(mesh, part, light, some, weights.data()); };
            if (part.triangles <= block)
                face(all);
            else
                tbb::parallel_for(all, face);
        }
    };
    const std::size_t grain = 1 + mesh.parts.size() * block / (mesh.triangles() + 1);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.parts.size(), grain), faceParts);
    for (const SilhouetteMesh::Thin& thin : mesh.thin) weights[thin.triangle] = weights[thin.like];
}

/// Whether the light grazes a triangle, as faceLight() has it; not if it has no plane.
bool grazes(const SilhouetteMesh& mesh, const Part& part, const glm::dvec4& light, std::size_t triangle) {
    const glm::dvec3 normal(mesh.planeX[triangle], mesh.planeY[triangle], mesh.planeZ[triangle]);
    const double side = sideOf(normal.x, normal.y, normal.z, mesh.planeD[triangle], light);
    return normal != glm::dvec3(0.0) && std::abs(side) <= toleranceOf(part, light);
}

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

/// Edges that any line across the light meets at most, along an axis. @param ends  two points an edge.
unsigned stabbed(const std::vector<glm::dvec2>& ends, int axis) {
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

/// Not more of a part's volumes hold one point than half of the edges that any line across the light meets, along either of two
/// axes.
unsigned mostOverOf(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index) {
    const ShadowVolumes::Part& part = volumes.parts[index];
    const unsigned most = part.edges / 3 + 1;
    if (most <= 8) return most;
    const glm::dvec3 middle = (glm::dvec3(mesh.parts[index].low) + glm::dvec3(mesh.parts[index].high)) / 2.0;
    const glm::dvec3 along = glm::normalize(awayFrom(volumes.light, middle));
    const Across axes = across(along);
    std::vector<glm::dvec2> lines;
    for (const Outline *edge = volumes.outline.data() + part.firstEdge, *end = edge + part.edges; edge != end; ++edge)
        for (const unsigned vertex : {edge->from, edge->to}) {
            const glm::dvec3 away = awayFrom(volumes.light, glm::dvec3(mesh.vertices[vertex]));
            const double depth = volumes.light.w == 0.0 ? 1.0 : glm::dot(away, along);
            if (!(depth > 0.0)) return most; // on all sides of a lamp
            const glm::dvec3 at = volumes.light.w == 0.0 ? glm::dvec3(mesh.vertices[vertex]) : away / depth;
            lines.emplace_back(glm::dot(at, axes.u), glm::dot(at, axes.v));
        }
    return std::min({most, stabbed(lines, 0) / 2, stabbed(lines, 1) / 2});
}

/// How far a vertex of the surface that casts goes on, in lengths of awayFrom().
double startOf(const SilhouetteMesh& mesh, const glm::dvec4& light, unsigned vertex) {
    if (mesh.offsets.empty() || !(mesh.offsets[vertex].w > 0.0f)) return 0.0;
    const glm::dvec3 away = awayFrom(light, glm::dvec3(mesh.vertices[vertex]));
    const double length = glm::length(away);
    return length > 0.0 ? terminatorOffset(mesh.offsets[vertex], -away / length) / length : 0.0;
}

/// Puts the sides and the end of part after part into the arrays.
class Writer {
public:
    Writer(const SilhouetteMesh& mesh, ShadowVolumes& volumes)
        : _mesh(mesh), _volumes(volumes), _places(mesh.vertices.size(), {~0u, 0}) {}

    void add(unsigned index) {
        ShadowVolumes::Part& part = _volumes.parts[index];
        part.first = static_cast<unsigned>(_volumes.corners.size());
        if (part.edges == 0) return;
        part.count = 6 * part.edges;
        _volumes.corners.resize(std::size_t(part.first) + part.count);
        unsigned* corner = _volumes.corners.data() + part.first;
        const Outline *first = _volumes.outline.data() + part.firstEdge, *end = first + part.edges;
        for (const Outline* edge = first; edge != end; ++edge) {
            const unsigned a = placeOf(index, edge->from), b = placeOf(index, edge->to);
            for (const unsigned each : {a, a + 1, b + 1, a, b + 1, b}) *corner++ = each;
        }
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
        const double start = startOf(_mesh, _volumes.light, vertex);
        _volumes.vertices.emplace_back(at, static_cast<float>(start));
        _volumes.vertices.emplace_back(at, static_cast<float>(length < 0.0 ? length : std::max(length, start)));
        return place.vertex;
    }

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

/// What of a part's triangles that cast.
enum class Surface {
    All,       ///< turned to the light.
    Rim,       ///< those that have moved.
    AtInfinity ///< turned away.
};

void appendSurface(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, Surface surface,
                   VolumeCaps& into) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        if (volumes.weights[i] == 0) continue;
        const unsigned* of = mesh.corners.data() + 3 * i;
        double starts[3] = {-1.0, -1.0, -1.0};
        for (int k = 0; k < 3 && surface != Surface::AtInfinity; ++k) starts[k] = startOf(mesh, volumes.light, of[k]);
        if (surface == Surface::Rim && std::max({starts[0], starts[1], starts[2]}) == 0.0) continue;
        const bool turned = (volumes.weights[i] < 0) != (surface == Surface::AtInfinity);
        for (const int k : {0, turned ? 2 : 1, turned ? 1 : 2}) {
            into.corners.push_back(static_cast<unsigned>(into.vertices.size()));
            into.vertices.emplace_back(mesh.vertices[of[k]], static_cast<float>(starts[k]));
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
    if (light.w == 0.0) { // the way is the same everywhere, and of length 1
        const double steepness = glm::dot(glm::dvec3(plane), glm::dvec3(light));
        if (!(steepness >= flattest)) return never;
        const glm::dvec3 farthest = glm::mix(low, high, glm::greaterThan(glm::dvec3(plane), glm::dvec3(0.0)));
        return std::max(0.0, distance(plane, farthest) / steepness);
    }
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = cornerOf(low, high, i), away = awayFrom(light, corner);
        const double steepness = -glm::dot(glm::dvec3(plane), away), length = glm::length(away);
        if (!(steepness >= flattest * length && length > 0.0)) return never;
        longest = std::max(longest, distance(plane, corner) / steepness * length);
    }
    return longest;
}

/// True if all points are on the side of a plane through `about` to which `normal` points.
bool areBeyond(const std::vector<glm::dvec3>& points, const glm::dvec3& normal, const glm::dvec3& about) {
    const double least = 1e-9 * glm::length(normal);
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
        return glm::dot(normal, point - about) > least * glm::length(point - about);
    });
}

/// Whether a sun's volume of the part's bounds is nowhere near the eye.
bool areApart(const glm::dvec3& eye, const SilhouetteMesh::Part& part, const glm::dvec3& sun) {
    const auto [u, v] = across(sun);
    const glm::dvec3 middle = (glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0, to = eye - middle;
    const glm::dvec3 half = (glm::dvec3(part.high) - middle) * (1.0 + 1e-6);
    const auto reach = [&half](const glm::dvec3& axis) { return glm::dot(glm::abs(axis), half); };
    return std::abs(glm::dot(to, u)) > reach(u) || std::abs(glm::dot(to, v)) > reach(v) ||
           glm::dot(to, sun) > reach(sun);
}

/// The same of a lamp's, behind the sphere about the part.
bool areApartFromLamp(const glm::dvec3& eye, const SilhouetteMesh::Part& part, const glm::dvec3& lamp) {
    const glm::dvec3 middle = (glm::dvec3(part.low) + glm::dvec3(part.high)) / 2.0, to = middle - lamp;
    const double radius = glm::distance(middle, glm::dvec3(part.high)) * (1.0 + 1e-6);
    const double away = glm::length(to), eyeAway = glm::distance(lamp, eye);
    if (!(away > radius && eyeAway > 0.0)) return false;
    if (eyeAway < away - radius) return true;
    const double cosine = glm::dot(to, eye - lamp) / (away * eyeAway);
    return std::acos(std::clamp(cosine, -1.0, 1.0)) > std::asin(radius / away);
}

struct Triangle {
    glm::dvec3 a, b, c, normal;
};

/// As it casts.
Triangle triangleOf(const SilhouetteMesh& mesh, const glm::dvec4& light, std::size_t i) {
    const unsigned* of = mesh.corners.data() + 3 * i;
    Triangle t{glm::dvec3(mesh.vertices[of[0]]),
               glm::dvec3(mesh.vertices[of[1]]),
               glm::dvec3(mesh.vertices[of[2]]),
               {mesh.planeX[i], mesh.planeY[i], mesh.planeZ[i]}};
    bool moved = false;
    glm::dvec3* corners[] = {&t.a, &t.b, &t.c};
    for (int k = 0; k < 3; ++k)
        if (const double start = startOf(mesh, light, of[k]); start > 0.0) {
            *corners[k] += start * awayFrom(light, *corners[k]);
            moved = true;
        }
    if (moved) t.normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
    return t;
}

/// False if a plane is between them.
bool mayMeet(const std::vector<glm::dvec3>& body, const Triangle& t) {
    return !areBeyond(body, t.normal, t.a) && !areBeyond(body, -t.normal, t.a) &&
           !areBeyond(body, glm::cross(t.b - t.a, t.normal), t.a) &&
           !areBeyond(body, glm::cross(t.c - t.b, t.normal), t.b) &&
           !areBeyond(body, glm::cross(t.a - t.c, t.normal), t.c);
}

/// 1 or -1: on which side of the plane through an edge and the light a place is; 0 if that is not certain.
int sideOf(const glm::dvec3& place, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec4& light) {
    const glm::dvec3 normal = glm::cross(b - a, awayFrom(light, a)), to = place - a;
    const double side = glm::dot(normal, to), least = 1e-9 * glm::length(normal) * glm::length(to);
    return side > least ? 1 : side < -least ? -1 : 0;
}

/// Whether a triangle is between the light and a place.
std::optional<bool> hides(const Triangle& t, int weight, const glm::dvec3& place, const glm::dvec4& light) {
    if (glm::dot(t.normal, place - t.a) * weight > 0.0) return false; // the light's side
    const int ab = sideOf(place, t.a, t.b, light), bc = sideOf(place, t.b, t.c, light),
              ca = sideOf(place, t.c, t.a, light);
    if (ab * bc < 0 || bc * ca < 0 || ca * ab < 0) return false;
    if (ab == 0 || bc == 0 || ca == 0) return std::nullopt;
    return true;
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
    Writer writer(mesh, into);
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        ShadowVolumes::Part& part = into.parts[i];
        part.end = nearestEnd(planes, glm::dvec3(mesh.parts[i].low), glm::dvec3(mesh.parts[i].high), light);
        part.mostOver = std::max(1u, mostOverOf(mesh, into, i));
        writer.add(static_cast<unsigned>(i));
    }
}

void appendLightCap(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into) {
    appendSurface(mesh, volumes, index, Surface::All, into);
}

void appendRim(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into) {
    if (mesh.parts[index].smooth) appendSurface(mesh, volumes, index, Surface::Rim, into);
}

void appendDarkCap(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into) {
    const ShadowVolumes::Part& volume = volumes.parts[index];
    if (volume.end != glm::dvec4(0.0))
        appendFan(volumes, volume, into);
    else if (volumes.light.w != 0.0)
        appendSurface(mesh, volumes, index, Surface::AtInfinity, into);
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

SightStart::SightStart(const glm::dmat4& clipFromMesh, const glm::dvec3& low, const glm::dvec3& high)
    : towardsEye(eyeIn(clipFromMesh)) {
    const glm::dmat4 meshFromClip = glm::inverse(clipFromMesh);
    for (unsigned i = 0; i < 4; ++i) {
        const glm::dvec4 corner = meshFromClip * glm::dvec4(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, -1.0, 1.0);
        cutAway.push_back(glm::dvec3(corner) / corner.w);
    }
    if (towardsEye.w != 0.0) {
        eye = glm::dvec3(towardsEye) / towardsEye.w;
        cutAway.push_back(eye);
        return;
    }
    const double far = 10.0 * (glm::distance(low, high) + glm::distance(cutAway[0], (low + high) / 2.0));
    const glm::dvec3 there = far * glm::normalize(glm::dvec3(towardsEye));
    for (unsigned i = 0; i < 4; ++i) cutAway.push_back(cutAway[i] + there);
    eye = (cutAway[4] + cutAway[7]) / 2.0;
}

std::optional<int> volumesHolding(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes,
                                  std::size_t index, bool mayBeCut) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    const glm::dvec4 &light = volumes.light, &end = volumes.parts[index].end;
    if (end != glm::dvec4(0.0) && !(glm::dot(end, start.towardsEye) > 0.0)) return std::nullopt;
    const bool apart = light.w == 0.0 ? areApart(start.eye, part, glm::dvec3(light))
                                      : areApartFromLamp(start.eye, part, glm::dvec3(light));
    if (apart && !mayBeCut) return 0;
    int count = 0;
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        const int weight = volumes.weights[i];
        if (weight == 0) continue;
        const Triangle triangle = triangleOf(mesh, light, i);
        if (mayBeCut && mayMeet(start.cutAway, triangle)) return std::nullopt;
        if (apart) continue;
        const std::optional<bool> hidden = hides(triangle, weight, start.eye, light);
        if (!hidden) return std::nullopt;
        count += *hidden;
    }
    return count;
}

bool mayShowBack(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index,
                 bool mayBeCut) {
    const SilhouetteMesh::Part& part = mesh.parts[index];
    const bool outside = part.closed && !mayBeCut && !part.boundsHold(start.eye);
    if (outside && (volumes.light.w == 0.0 || !part.boundsHold(glm::dvec3(volumes.light)))) return false;
    for (std::size_t i = part.firstTriangle; i < std::size_t(part.firstTriangle) + part.triangles; ++i) {
        if (outside && (volumes.weights[i] > 0) != part.inward) continue; // the light is outside of it, too
        const glm::dvec4 plane(mesh.planeX[i], mesh.planeY[i], mesh.planeZ[i], mesh.planeD[i]);
        if (volumes.weights[i] * glm::dot(plane, start.towardsEye) < 0.0) return true;
    }
    return false;
}

} // namespace gnomon
