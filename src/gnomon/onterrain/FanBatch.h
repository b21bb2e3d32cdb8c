// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/GridDrape.h>
#include <gnomon/geometry/ConvexShadow.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/onterrain/PackedParts.h>
#include <gnomon/onterrain/TerrainOutcome.h>
#include <gnomon/simd/ShadowKernel.h>

#include <glm/vec2.hpp>

namespace gnomon {

/// Shadows of a few dozen parts as polygons, found together: what the kernel reads and writes, used again for the next ones.
/// A part's shadow is the same whatever others it is found with.
///
/// Source: fixed-point iteration of roof corners' rays takes as many steps as the slope's share of the light's tangent has
///         digits; Newton's, from triangle to triangle, two to four and ends at the triangle's own plane.
class FanBatch {
public:
    static constexpr double inGround = 1e-6; ///< of a part's size: what floats leave of a height, and some more.

    /// Of one part. Places are about the anchor.
    struct Entry {
        glm::dvec3 anchor{0.0};
        glm::dvec4 light{0.0};                           ///< about the anchor.
        double size = 0.0;                               ///< from the anchor to its farthest corner.
        double tangent = 0.0;                            ///< of the light's least elevation.
        TerrainOutcome outcome = TerrainOutcome::edgeOn; ///< fan, as long as nothing else is known.
        double wrong = 0.0, seen = 0.0;                  ///< twice areas; what is wrong with the fan, of what is seen.
        std::size_t fan = 0, lane = 0;                   ///< of the kernel's.
        std::size_t corners = 0;                         ///< of the polygon that are left.

        double off() const { return wrong > 0.0 ? wrong / seen : 0.0; } ///< see HullFan.
    };

    /// For the parts of one light and ground, which must be there as long as the batch is used.
    void begin(const Ground& ground, const glm::dvec4& light, const ShadowKernel& kernel = bestShadowKernel());
    /// Instead of those that there were. entry().outcome says why there is no shadow, but for what the ground tells.
    void take(const PackedParts& parts, std::size_t first, std::size_t end);
    /// Polygons of all that were taken.
    void findFans();

    std::size_t size() const { return _entries.size(); }
    const Entry& entry(std::size_t i) const { return _entries[i]; }
    /// Corners of a fan that was found, about its anchor, counter-clockwise, from the one that sees all others.
    std::size_t cornerCount(std::size_t i) const { return _entries[i].corners; }
    glm::dvec3 corner(std::size_t i, std::size_t at) const { return endOf(_entries[i], at); }
    /// The same corners, in the entry's lane.
    const KernelEdge* edges(const Entry& entry) const { return &edgeOf(entry, 0); }
    /// Whether it has a silhouette, though it may be turned away.
    bool isThere(std::size_t i) const { return _entries[i].fan != none; }
    /// Some corner is over the ground.
    bool isOut(std::size_t i) const { return partOf(_entries[i]).isOut[_entries[i].lane] > 0.0; }
    glm::dvec3 top(std::size_t i) const;  ///< highest corner of its silhouette.
    Drape triangles(std::size_t i) const; ///< of a fan that was found, in the ground's frame.
    /// The ground's triangles in the shadow, about its anchor. @param error  in plan. @return until the next call.
    const DrapeMesh& drape(std::size_t i, double error);
    const DrapeMesh& allGround(std::size_t i); ///< the same of all the ground.
    /// In the ground's frame, planes with unit normals.
    ConvexShadow shadow(std::size_t i) const;

private:
    static constexpr std::size_t none = ~std::size_t(0);

    void takeKind(const PackedParts& parts, std::size_t first);
    void askFaces(const PackedParts& parts, std::size_t first);
    void packBlock(const PackedParts& parts, std::size_t first, std::size_t block);
    bool isAlike(std::size_t a, std::size_t b) const;
    void takeAlike(const HullTopology& topology);
    void findSilhouette(const HullTopology& topology);
    void addFans();
    void addParts(const std::size_t* lanes);
    std::uint64_t litOf(std::size_t inKind, std::size_t word) const {
        const std::size_t block = inKind / kernelLanes, lane = inKind % kernelLanes;
        return _lit[((_hulls.faces / 64 + 1) * block + word) * kernelLanes + lane];
    }

    const KernelFan& fanOf(const Entry& entry) const { return _fans[entry.fan]; }
    const KernelPart& partOf(const Entry& entry) const { return _parts[entry.fan]; }
    const KernelEdge& edgeOf(const Entry& entry, std::size_t e) const { return _edges[fanOf(entry).edge + e]; }
    KernelEdge& edgeOf(const Entry& entry, std::size_t e) { return _edges[fanOf(entry).edge + e]; }
    const KernelRay& rayOf(const Entry& entry, std::size_t r) const { return _rays[fanOf(entry).ray + r]; }
    glm::dvec3 endOf(const Entry& entry, std::size_t e) const {
        const KernelEdge& edge = edgeOf(entry, e);
        return {edge.endX[entry.lane], edge.endY[entry.lane], edge.endZ[entry.lane]};
    }
    void setEnd(const Entry& entry, std::size_t e, const glm::dvec3& end);
    double leastTangent(const Entry& entry) const;
    glm::dvec2 wayOf(const Entry& entry, const glm::dvec3& point) const;
    glm::dvec3 silhouette(const Entry& entry, std::size_t e) const;
    glm::dvec4 edgePlane(const Entry& entry, std::size_t e) const;
    glm::dvec4 facePlane(const Entry& entry, std::size_t f) const;
    void findFans(std::size_t first, std::size_t end);
    template <class Do>
    void eachEntry(std::size_t first, std::size_t end, const Do& what);
    void beginRays(std::size_t first, std::size_t end);
    void cast(std::size_t first, std::size_t end);
    bool isGentle(const Entry& entry) const;
    bool landExactly(const Entry& entry);
    std::optional<glm::dvec3> exactEnd(const Entry& entry, const glm::dvec3& point, const KernelRay& ray) const;
    bool isStoodTooWide(const Entry& entry) const;
    void finish(Entry& entry);
    double areaAt(const Entry& entry, std::size_t a, std::size_t b, std::size_t c) const;
    double simplify(Entry& entry, double most);
    bool turnToStart(const Entry& entry);
    void turn(const Entry& entry, std::size_t start);
    void addHeights(std::size_t first, std::size_t end);
    KernelFans kernelFans(std::size_t first, std::size_t end);
    bool findReach(std::size_t i, glm::dvec2& low, glm::dvec2& high) const;
    void takePlanes(std::size_t i);
    const DrapeMesh& meshOf(const Drape& triangles, const glm::dvec3& anchor);

    const Ground* _ground = nullptr;
    const ShadowKernel* _kernel = nullptr;
    const HeightPyramid* _grid = nullptr; ///< the ground, if it is one.
    GridView _view{};
    glm::dvec2 _origin{0.0}, _scale{1.0}; ///< of the kernel's frame.
    double _base = 0.0;
    glm::dvec4 _light{0.0};
    bool _isLight = false;
    glm::dvec2 _way{0.0};                   ///< of a sun's rays in plan, a unit of descent.
    double _tangent = 0.0, _steepest = 0.0; ///< of the sun's elevation; of the grid's slopes.

    std::vector<Entry> _entries;
    std::vector<char> _taken;
    // Of parts of one kind:
    KernelHulls _hulls{};
    std::vector<std::size_t> _kind;
    std::vector<float> _places;
    std::vector<double> _lights, _facePlanes, _sizes;
    std::vector<std::uint64_t> _lit;
    // Of those of them that the light meets at the same faces:
    std::vector<std::size_t> _alike, _left; ///< places in `_kind`.
    std::vector<char> _isLit;
    std::vector<unsigned> _litFaces, _loop;

    std::vector<KernelFan> _fans;
    std::vector<std::size_t> _members; ///< the entry in each lane of them.
    std::vector<KernelPart> _parts;
    std::vector<KernelEdge> _edges;
    std::vector<KernelFace> _faces;
    // Of fans that are found together:
    std::vector<KernelRay> _rays;
    std::vector<KernelPlace> _inside; ///< of the triangles.
    std::vector<unsigned> _order;
    std::size_t _edgeCount = 0, _faceCount = 0, _rayCount = 0; ///< in use.
    std::vector<glm::dvec3> _turned;
    GridDrape::Planes _planes;
    GridDrape _gridDrape;
    KeyNumbers<glm::dvec3> _numbers;
    DrapeMesh _mesh;
};

} // namespace gnomon
