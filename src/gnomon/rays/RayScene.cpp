// SPDX-License-Identifier: MIT
#include <gnomon/RayScene.h>

#include <embree3/rtcore.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
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

constexpr int liftSteps = 256;

[[noreturn]] void fail(const char* what, RTCError error) {
    const std::string why = error == RTC_ERROR_OUT_OF_MEMORY     ? "there is not enough memory"
                            : error == RTC_ERROR_UNSUPPORTED_CPU ? "it does not support this processor"
                                                                 : "it reports error " + std::to_string(int(error));
    throw std::runtime_error(std::string("Embree cannot ") + what + ": " + why + ".");
}

/// One for all scenes, as Embree advises; lives to the end of the program, for its threads do.
RTCDevice device() {
    static const RTCDevice made = rtcNewDevice(nullptr);
    if (!made) fail("start", rtcGetDeviceError(nullptr));
    return made;
}

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
    (*static_cast<const RayScene::ProgressLine*>(progress))(share);
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

RTCIntersectContext context() {
    RTCIntersectContext result;
    rtcInitIntersectContext(&result);
    return result;
}

} // namespace

struct RayScene::Embree {
    ~Embree() { rtcReleaseScene(scene); }

    static void passThroughHoles(const RTCFilterFunctionNArguments* arguments);

    void take(const TriangleSoup& soup);
    void commit(const ProgressLine& progress);
    RTCRay ray(const Ray& ray) const;
    RayHit refined(const Ray& ray, unsigned primitive) const;
    glm::dvec3 corner(std::size_t primitive, int i) const { return glm::dvec3(vertices[indices[3 * primitive + i]]); }

    RTCScene scene = nullptr;
    glm::dvec3 origin{0.0};
    const glm::vec3* vertices = nullptr; ///< Embree's own copy.
    const unsigned* indices = nullptr;   ///< the same; only of triangles that are kept.
    std::vector<unsigned> kept;          ///< for each of them, its place among those given.
    std::function<bool(unsigned, double, double)> solidAt;
    std::size_t leftOut = 0;
    double reach = 0.0;
};

/// Embree asks it of each hit that it finds; single rays only are cast, so that N is 1.
void RayScene::Embree::passThroughHoles(const RTCFilterFunctionNArguments* arguments) {
    const Embree& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
    const unsigned triangle = self.kept[RTCHitN_primID(arguments->hit, arguments->N, 0)];
    const float u = RTCHitN_u(arguments->hit, arguments->N, 0), v = RTCHitN_v(arguments->hit, arguments->N, 0);
    if (!self.solidAt(triangle, double(u), double(v))) arguments->valid[0] = 0;
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
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), soup.vertexCount));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), kept.size()));
    if (points && corners) {
        std::copy_n(soup.vertices, soup.vertexCount, points);
        for (std::size_t i = 0; i < kept.size(); ++i)
            std::copy_n(soup.indices + 3 * std::size_t{kept[i]}, 3, corners + 3 * i);
        vertices = points;
        indices = corners;
        if (solidAt) {
            rtcSetGeometryUserData(geometry, this);
            rtcSetGeometryIntersectFilterFunction(geometry, passThroughHoles);
            rtcSetGeometryOccludedFilterFunction(geometry, passThroughHoles);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry);
}

void RayScene::Embree::commit(const ProgressLine& progress) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (progress) rtcSetSceneProgressMonitorFunction(scene, report, const_cast<ProgressLine*>(&progress));
    rtcCommitScene(scene);
    if (progress) rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    const RTCError error = rtcGetDeviceError(device());
    if (error != RTC_ERROR_NONE) fail("build its tree", error);
    if (kept.empty()) return;
    RTCBounds box;
    rtcGetSceneBounds(scene, &box);
    reach = std::max({double(box.upper_x) - double(box.lower_x), double(box.upper_y) - double(box.lower_y),
                      double(box.upper_z) - double(box.lower_z)}) /
            2.0;
}

/// Embree's ray: a direction of length 1, so that no length over- or underflows a float.
RTCRay RayScene::Embree::ray(const Ray& given) const {
    const glm::vec3 start(given.start - origin);
    const double length = glm::length(given.along);
    const glm::vec3 along(given.along / length);
    const bool usable = isUsable(start) && isUsable(along) && length < 1e150 && given.reach > 0.0;
    RTCRay result{};
    result.org_x = start.x;
    result.org_y = start.y;
    result.org_z = start.z;
    result.dir_x = usable ? along.x : 0.0f;
    result.dir_y = usable ? along.y : 0.0f;
    result.dir_z = usable ? along.z : 1.0f;
    result.tfar =
        usable ? static_cast<float>(given.reach * length) : -1.0f; // below 0 for no ray, which Embree must not see
    result.mask = ~0u;
    return result;
}

/// Where the ray meets the triangle's plane, in double.
RayHit RayScene::Embree::refined(const Ray& ray, unsigned primitive) const {
    const glm::dvec3 a = corner(primitive, 0);
    const glm::dvec3 normal = glm::normalize(glm::cross(corner(primitive, 1) - a, corner(primitive, 2) - a));
    RayHit hit;
    hit.triangle = kept[primitive];
    hit.normal = normal;
    hit.distance = glm::dot(a - (ray.start - origin), normal) / glm::dot(ray.along, normal);
    return hit;
}

RayScene::RayScene(const TriangleSoup& triangles, const ProgressLine& progress) : _embree(new Embree) {
    _embree->scene = rtcNewScene(device());
    if (!_embree->scene) fail("make a scene", rtcGetDeviceError(device()));
    _embree->take(triangles);
    _embree->commit(progress);
}

RayScene::~RayScene() = default;

RayHit RayScene::closest(const Ray& given) const {
    RTCRayHit query{_embree->ray(given), {}};
    if (query.ray.tfar < 0.0f) return {};
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext how = context();
    rtcIntersect1(_embree->scene, &how, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return _embree->refined(given, query.hit.primID);
}

bool RayScene::blocked(const Ray& given) const {
    RTCRay query = _embree->ray(given);
    if (query.tfar < 0.0f) return false;
    RTCIntersectContext how = context();
    rtcOccluded1(_embree->scene, &how, &query);
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

double RayScene::margin(const glm::dvec3& point) const {
    const glm::dvec3 local = glm::abs(point - _embree->origin);
    return stepsAbove(static_cast<float>(std::max({local.x, local.y, local.z, _embree->reach / 16.0})), liftSteps);
}

glm::dvec3 RayScene::lifted(const glm::dvec3& point, const glm::dvec3& normal) const {
    glm::dvec3 result = point;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = std::max(std::abs(point[axis] - _embree->origin[axis]), _embree->reach / 16.0);
        result[axis] += normal[axis] * stepsAbove(static_cast<float>(size), liftSteps);
    }
    return result;
}

std::size_t RayScene::leftOut() const { return _embree->leftOut; }
double RayScene::reach() const { return _embree->reach; }

} // namespace gnomon
