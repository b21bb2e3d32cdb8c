// SPDX-License-Identifier: MIT
#include <gnomon/RayScene.h>
#include <gnomon/geometry/TerminatorOffset.h>
#include <gnomon/rays/Placement.h>

#if GNOMON_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon {
namespace {

constexpr int liftSteps = 8;
constexpr double exact = 1.0 / (1LL << 42); // of the scene's size: what doubles leave of a place on a plane
constexpr double inPlane = 1.0 / (1 << 20); // of the coordinates: eight steps of a float

double largestOf(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// False for NaN too.
bool isUsable(const glm::vec3& v) {
    constexpr float most = 1e18f;
    return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

/// Corners on one line: their rounding makes a direction of its own out of the normal, and with it false hits.
bool isFlat(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return !(glm::length(glm::cross(b - a, c - a)) > std::ldexp(longest, -48) * longest);
}

bool isTriangle(const TriangleSoup& soup, const unsigned* corner) {
    glm::vec3 v[3];
    for (int i = 0; i < 3; ++i) {
        if (corner[i] >= soup.vertexCount) return false;
        v[i] = soup.vertices[corner[i]];
        if (!isUsable(v[i])) return false;
    }
    return !isFlat(glm::dvec3(v[0]), glm::dvec3(v[1]), glm::dvec3(v[2]));
}

bool report(void* progress, double share) {
    (*static_cast<const RayScene::Progress*>(progress))(share);
    return true;
}

/// The float `steps` representable values above the positive `value`.
double stepsAbove(float value, int steps) {
    std::int32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    bits += steps;
    float moved;
    std::memcpy(&moved, &bits, sizeof moved);
    return static_cast<double>(moved) - static_cast<double>(value);
}

// Embree 4 takes the context among further arguments.
#if GNOMON_EMBREE == 4
using RayContext = RTCRayQueryContext;
void init(RayContext& context) { rtcInitRayQueryContext(&context); }
void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray, &arguments);
}
void occlude(RTCScene scene, RayContext& context, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}
#else
using RayContext = RTCIntersectContext;
void init(RayContext& context) { rtcInitIntersectContext(&context); }
void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray) { rtcIntersect1(scene, &context, &ray); }
void occlude(RTCScene scene, RayContext& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }
#endif

[[noreturn]] void failInEmbree(const char* what, RTCError error) {
    const std::string why = error == RTC_ERROR_OUT_OF_MEMORY     ? "there is not enough memory"
                            : error == RTC_ERROR_UNSUPPORTED_CPU ? "it does not support this processor"
                                                                 : "it reports error " + std::to_string(int(error));
    throw std::runtime_error(std::string("Embree cannot ") + what + ": " + why + ".");
}

/// One for all scenes, as Embree advises; lives to the end of the program, for its threads do.
RTCDevice embreeDevice() {
    static const RTCDevice made = rtcNewDevice(nullptr);
    if (!made) failInEmbree("start", rtcGetDeviceError(nullptr));
    return made;
}

} // namespace

/// A ray in the frame of some triangles, in double.
struct LocalRay {
    glm::dvec3 start, along;
    double reach;
    double endSize; ///< of the coordinates of its end, in the frame that it was given in; 0 if it has none.
};

/// A tree of Embree's: over triangles, or over parts that have such trees.
struct RayScene::Embree {
    /// A scene as it is attached to another.
    struct Part {
        Part(const PlacedRayScene& given, unsigned itsIndex);
        LocalRay inside(const LocalRay& ray) const;

        std::shared_ptr<const RayScene> scene;
        unsigned index;                          ///< among those given.
        double stretched;                        ///< see stretch().
        glm::dmat4 outerFromPart, partFromOuter; ///< from and to what the part's triangles are relative to.
    };
    /// What the filter knows of the ray that is cast.
    struct Cast : RayContext {
        Cast(const Ray& ray, const Embree& embree);
        LocalRay local;
        const Embree& outer;
        const bool toLight;
        bool overEnd = false; ///< meets a surface on which it ends, too.
    };

    Embree();
    ~Embree() { rtcReleaseScene(scene); }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    bool movesBefore(const LocalRay& ray, unsigned primitive, double u, double v) const;
    static void filter(const RTCFilterFunctionNArguments* arguments);

    void take(const TriangleSoup& soup);
    void take(const std::vector<PlacedRayScene>& given);
    void commit(const Progress& progress);
    bool empty() const { return kept.empty() && parts.empty(); }
    void measure();
    void measureParts();
    RTCRay ray(const Ray& ray) const;
    bool meets(const LocalRay& ray, bool overEnd, unsigned primitive) const;
    RayHit refined(const LocalRay& ray, unsigned primitive) const;
    RayHit refined(const Cast& cast, const RTCHit& hit) const;
    double step(double coordinate) const;
    glm::dvec3 corner(std::size_t primitive, int i) const { return glm::dvec3(vertices[indices[3 * primitive + i]]); }

    RTCScene scene = nullptr;
    glm::dvec3 origin{0.0};
    const glm::vec3* vertices = nullptr; ///< Embree's own copy.
    const unsigned* indices = nullptr;   ///< the same; only of triangles that are kept.
    std::vector<unsigned> kept;          ///< for each of them, its place among those given.
    std::vector<Part> parts;             ///< by Embree's number.
    std::function<bool(unsigned, double, double)> solidAt;
    std::vector<glm::vec4> offsets; ///< by vertex; may be empty.
    std::size_t leftOut = 0;
    double reach = 0.0;
    double size = 0.0; ///< how far from the origin the middle one of the triangles is: what is far off does not count.
    double longest = 0.0; ///< a triangle's side.
};

RayScene::Embree::Embree() : scene(rtcNewScene(embreeDevice())) {
    if (!scene) failInEmbree("make a scene", rtcGetDeviceError(embreeDevice()));
}

RayScene::Embree::Cast::Cast(const Ray& ray, const Embree& embree)
    : local{ray.start - embree.origin, ray.along, ray.reach, 0.0}, outer(embree), toLight(ray.toLight) {
    init(*this);
    if (!std::isinf(ray.reach)) local.endSize = largestOf(local.start + ray.reach * ray.along);
}

/// Embree asks it of each hit that it finds; single rays only are cast, so that N is 1.
void RayScene::Embree::filter(const RTCFilterFunctionNArguments* arguments) {
    const Embree& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    const Cast& cast = *static_cast<const Cast*>(arguments->context);
    const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, 0);
    const unsigned part = RTCHitN_instID(arguments->hit, arguments->N, 0, 0);
    const LocalRay ray = part == RTC_INVALID_GEOMETRY_ID ? cast.local : cast.outer.parts[part].inside(cast.local);
    const double u = double(RTCHitN_u(arguments->hit, arguments->N, 0)),
                 v = double(RTCHitN_v(arguments->hit, arguments->N, 0));
    if (!self.meets(ray, cast.overEnd, primitive) || (cast.toLight && self.movesBefore(ray, primitive, u, v)) ||
        (self.solidAt && !self.solidAt(self.kept[primitive], u, v)))
        arguments->valid[0] = 0;
}

/// Whether a point of the triangle, once it has moved along the ray, away from the light, is before the ray's start.
bool RayScene::Embree::movesBefore(const LocalRay& ray, unsigned primitive, double u, double v) const {
    if (offsets.empty()) return false;
    const double length = glm::length(ray.along);
    const auto offset = [&](std::size_t i) {
        return terminatorOffset(offsets[indices[3 * std::size_t{primitive} + i]], ray.along / length);
    };
    const double away = (1.0 - u - v) * offset(0) + u * offset(1) + v * offset(2);
    return away > 0.0 && refined(ray, primitive).distance * length < away;
}

/// Whether the triangle's plane is between the ray's ends, in double. Embree's floats are off by steps of the triangle's
/// size, which may be kilometres where the ray starts millimetres above it.
bool RayScene::Embree::meets(const LocalRay& ray, bool overEnd, unsigned primitive) const {
    const glm::dvec3 a = corner(primitive, 0);
    const glm::dvec3 normal = glm::cross(corner(primitive, 1) - a, corner(primitive, 2) - a);
    const double ahead = glm::dot(a - ray.start, normal), speed = glm::dot(ray.along, normal);
    const double distance = ahead / speed;
    if (!(distance > 0.0 && distance <= ray.reach)) return false;
    if (overEnd || std::isinf(ray.reach)) return true;
    const double reached = std::max(largestOf(a), ray.endSize);
    return std::abs(ahead - ray.reach * speed) > inPlane * reached * glm::length(normal);
}

/// Copies what is usable.
void RayScene::Embree::take(const TriangleSoup& soup) {
    origin = soup.origin;
    solidAt = soup.solidAt;
    kept.reserve(soup.indexCount / 3);
    for (std::size_t i = 0; i + 2 < soup.indexCount; i += 3)
        if (isTriangle(soup, soup.indices + i)) kept.push_back(static_cast<unsigned>(i / 3));
    leftOut = soup.indexCount / 3 - kept.size();
    if (kept.empty()) return;
    const RTCGeometry geometry = rtcNewGeometry(embreeDevice(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), soup.vertexCount));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), kept.size()));
    if (points && corners) {
        std::copy_n(soup.vertices, soup.vertexCount, points);
        for (std::size_t i = 0; i < kept.size(); ++i)
            std::copy_n(soup.indices + 3 * std::size_t{kept[i]}, 3, corners + 3 * i);
        vertices = points;
        if (soup.terminatorOffsets) offsets.assign(soup.terminatorOffsets, soup.terminatorOffsets + soup.vertexCount);
        indices = corners;
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
}

void RayScene::Embree::commit(const Progress& progress) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (progress) rtcSetSceneProgressMonitorFunction(scene, report, const_cast<Progress*>(&progress));
    rtcCommitScene(scene);
    if (progress) rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    const RTCError error = rtcGetDeviceError(embreeDevice());
    if (error != RTC_ERROR_NONE) failInEmbree("build its tree", error);
    if (empty()) return;
    RTCBounds box;
    rtcGetSceneBounds(scene, &box);
    reach = std::max({double(box.upper_x) - double(box.lower_x), double(box.upper_y) - double(box.lower_y),
                      double(box.upper_z) - double(box.lower_z)}) /
            2.0;
    parts.empty() ? measure() : measureParts();
}

void RayScene::Embree::measure() {
    std::vector<double> distances;
    const std::size_t every = kept.size() / 1000 + 1;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec3 a = corner(i, 0), b = corner(i, 1), c = corner(i, 2);
        longest = std::max({longest, glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
        if (i % every == 0) distances.push_back(std::max({largestOf(a), largestOf(b), largestOf(c)}));
    }
    longest = std::sqrt(longest);
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    size = *middle;
}

/// Embree's ray: a direction of length 1, so that no length over- or underflows a float. It starts earlier and ends later
/// than the given one by as much as floats may be off.
RTCRay RayScene::Embree::ray(const Ray& given) const {
    const double length = glm::length(given.along);
    const glm::dvec3 local = given.start - origin, unit = given.along / length;
    const double more = (parts.empty() ? 1.0 : 2.0) * inPlane * (largestOf(local) + longest); // floats twice
    const glm::vec3 start(local - more * unit), along(unit);
    const bool usable = isUsable(start) && isUsable(along) && length < 1e150 && given.reach > 0.0;
    RTCRay result{};
    result.org_x = start.x;
    result.org_y = start.y;
    result.org_z = start.z;
    result.dir_x = usable ? along.x : 0.0f;
    result.dir_y = usable ? along.y : 0.0f;
    result.dir_z = usable ? along.z : 1.0f;
    result.tfar = usable ? static_cast<float>(given.reach * length + 2.0 * more)
                         : -1.0f; // below 0 for no ray, which Embree must not see
    result.mask = ~0u;
    return result;
}

/// Where the ray meets the triangle's plane, in double.
RayHit RayScene::Embree::refined(const LocalRay& ray, unsigned primitive) const {
    const glm::dvec3 a = corner(primitive, 0);
    const glm::dvec3 normal = glm::normalize(glm::cross(corner(primitive, 1) - a, corner(primitive, 2) - a));
    RayHit hit;
    hit.triangle = kept[primitive];
    hit.normal = normal;
    hit.distance = glm::dot(a - ray.start, normal) / glm::dot(ray.along, normal);
    return hit;
}

RayScene::Embree::Part::Part(const PlacedRayScene& given, unsigned itsIndex)
    : scene(given.scene),
      index(itsIndex),
      stretched(stretch(given.outerFromInner)),
      outerFromPart(glm::translate(given.outerFromInner, given.scene->_embree->origin)),
      partFromOuter(glm::inverse(outerFromPart)) {}

LocalRay RayScene::Embree::Part::inside(const LocalRay& ray) const {
    return {glm::dvec3(partFromOuter * glm::dvec4(ray.start, 1.0)), glm::dmat3(partFromOuter) * ray.along, ray.reach,
            ray.endSize / stretched};
}

void RayScene::Embree::take(const std::vector<PlacedRayScene>& given) {
    for (unsigned i = 0; i < given.size(); ++i) {
        if (!given[i].scene || !given[i].scene->_embree->parts.empty())
            throw std::invalid_argument("gnomon::RayScene: a part must be a scene that has no parts of its own.");
        const Embree& inner = *given[i].scene->_embree;
        leftOut += inner.leftOut;
        if (!isPlacement(given[i].outerFromInner)) leftOut += inner.kept.size();
        if (inner.kept.empty() || !isPlacement(given[i].outerFromInner)) continue;
        parts.emplace_back(given[i], i);
        const RTCGeometry instance = rtcNewGeometry(embreeDevice(), RTC_GEOMETRY_TYPE_INSTANCE);
        const glm::mat4x3 matrix(parts.back().outerFromPart);
        rtcSetGeometryInstancedScene(instance, inner.scene);
        rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &matrix[0][0]);
        rtcCommitGeometry(instance);
        rtcAttachGeometryByID(scene, instance, static_cast<unsigned>(parts.size() - 1));
        rtcReleaseGeometry(instance);
    }
}

/// As measure(), of triangles where they are.
void RayScene::Embree::measureParts() {
    std::size_t triangles = 0;
    for (const Part& part : parts) triangles += part.scene->_embree->kept.size();
    const std::size_t every = triangles / 1000 + 1;
    std::vector<double> distances;
    std::size_t next = 0; // of the part's
    for (const Part& part : parts) {
        const Embree& inner = *part.scene->_embree;
        longest = std::max(longest, part.stretched * inner.longest);
        const auto distance = [&](int i) {
            return largestOf(glm::dvec3(part.outerFromPart * glm::dvec4(inner.corner(next, i), 1.0)));
        };
        for (; next < inner.kept.size(); next += every)
            distances.push_back(std::max({distance(0), distance(1), distance(2)}));
        next -= inner.kept.size();
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    size = *middle;
}

/// Distances along a ray are the same in every frame. A normal is turned as planes are.
RayHit RayScene::Embree::refined(const Cast& cast, const RTCHit& hit) const {
    if (parts.empty()) return refined(cast.local, hit.primID);
    const Part& part = parts[hit.instID[0]];
    RayHit result = part.scene->_embree->refined(part.inside(cast.local), hit.primID);
    result.part = part.index;
    result.normal = glm::normalize(glm::transpose(glm::dmat3(part.partFromOuter)) * result.normal);
    return result;
}

RayScene::RayScene(const TriangleSoup& triangles, const Progress& progress) : _embree(new Embree) {
    _embree->take(triangles);
    _embree->commit(progress);
}

RayScene::RayScene(const std::vector<PlacedRayScene>& parts) : _embree(new Embree) {
    _embree->take(parts);
    _embree->commit({});
}

RayScene::~RayScene() = default;

RayHit RayScene::closest(const Ray& given) const {
    RTCRayHit query{_embree->ray(given), {}};
    if (query.ray.tfar < 0.0f) return {};
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Embree::Cast how(given, *_embree);
    how.overEnd = true;
    intersect(_embree->scene, how, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return _embree->refined(how, query.hit);
}

bool RayScene::blocked(const Ray& given) const {
    RTCRay query = _embree->ray(given);
    if (query.tfar < 0.0f) return false;
    Embree::Cast how(given, *_embree);
    occlude(_embree->scene, how, query);
    return query.tfar < 0.0f;
}

/// Single rays, so that the answers are those of single rays: Embree's packets round differently.
void RayScene::closest(const Ray* rays, std::size_t count, RayHit* hits) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) hits[i] = closest(rays[i]);
    });
}

void RayScene::blocked(const Ray* rays, std::size_t count, std::uint8_t* answers) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) answers[i] = blocked(rays[i]);
    });
}

double RayScene::Embree::step(double coordinate) const {
    const double least = std::max(size / 16.0, double{std::numeric_limits<float>::min()});
    return std::max(stepsAbove(static_cast<float>(std::max(std::abs(coordinate), least)), liftSteps), exact * reach);
}

double RayScene::margin(const glm::dvec3& point) const { return _embree->step(largestOf(point - _embree->origin)); }

glm::dvec3 RayScene::lifted(const glm::dvec3& point, const glm::dvec3& normal) const {
    glm::dvec3 result = point;
    for (int axis = 0; axis < 3; ++axis)
        result[axis] += normal[axis] * _embree->step(point[axis] - _embree->origin[axis]);
    return result;
}

std::size_t RayScene::leftOut() const { return _embree->leftOut; }
double RayScene::reach() const { return _embree->reach; }
double RayScene::longestSide() const { return _embree->longest; }

} // namespace gnomon
