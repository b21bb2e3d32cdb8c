// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>

#if GNOMON_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon {

#if GNOMON_EMBREE == 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

[[noreturn]] void failInEmbree(const char* what, RTCError error);

/// One for all scenes, as Embree advises; lives to the end of the program, for its threads do.
RTCDevice embreeDevice();

inline double largestOf(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

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
        bool overEnd = false; ///< meets a surface on which it ends, too.
    };

    Embree();
    ~Embree() { rtcReleaseScene(scene); }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    static void filter(const RTCFilterFunctionNArguments* arguments);

    void take(const TriangleSoup& soup);
    void take(const std::vector<PlacedRayScene>& given);
    void commit(const ProgressLine& progress);
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
    std::size_t leftOut = 0;
    double reach = 0.0;
    double size = 0.0; ///< how far from the origin the middle one of the triangles is: what is far off does not count.
    double longest = 0.0; ///< a triangle's side.
};

} // namespace gnomon
