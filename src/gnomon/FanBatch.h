// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ConvexShadow.h>
#include <gnomon/GridDrape.h>
#include <gnomon/HeightPyramid.h>
#include <gnomon/PackedParts.h>
#include <gnomon/ShadowKernel.h>
#include <gnomon/TerrainShadow.h>

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
        double size = 0.0, low = 0.0, high = 0.0;        ///< from the anchor to its farthest corner; its heights.
        double tangent = 0.0;                            ///< of the light's least elevation.
        TerrainOutcome outcome = TerrainOutcome::edgeOn; ///< fan, as long as nothing else is known.
        double wrong = 0.0, seen = 0.0;                  ///< twice areas; what is wrong with the fan, of what is seen.
        std::size_t fan = 0;                             ///< its own of the kernel's.

        double off() const { return wrong > 0.0 ? wrong / seen : 0.0; } ///< see HullFan.
    };

    /// For the parts of one light and ground, which must be there as long as the batch is used.
    void begin(const Ground& ground, const glm::dvec4& light);
    /// Instead of those that there were. entry().outcome says why there is no shadow, but for what the ground tells.
    void take(const PackedParts& parts, std::size_t first, std::size_t end);
    /// Polygons of all that were taken.
    void findFans();

    std::size_t size() const { return _entries.size(); }
    const Entry& entry(std::size_t i) const { return _entries[i]; }
    /// Corners of a fan that was found, about its anchor, counter-clockwise, from the one that sees all others.
    std::size_t cornerCount(std::size_t i) const { return _fans[_entries[i].fan].corners; }
    glm::dvec3 corner(std::size_t i, std::size_t at) const {
        const std::size_t place = _fans[_entries[i].fan].edge + at;
        return {_cx[place], _cy[place], _cz[place]};
    }
    /// Whether it has a silhouette, though it may be turned away.
    bool isThere(std::size_t i) const { return _entries[i].fan != none; }
    bool isOut(std::size_t i) const { return _fans[_entries[i].fan].isOut; } ///< some corner is over the ground.
    glm::dvec3 top(std::size_t i) const;                                     ///< highest corner of its silhouette.
    Drape triangles(std::size_t i) const; ///< of a fan that was found, in the ground's frame.
    /// The ground's triangles in the shadow, about its anchor. @param error  in plan. @return until the next call.
    const Drape& drape(std::size_t i, double error);
    const Drape& allGround(std::size_t i); ///< the same of all the ground.
    /// In the ground's frame, planes with unit normals.
    ConvexShadow shadow(std::size_t i) const;

private:
    using Lane = std::vector<double>;
    static constexpr std::size_t none = ~std::size_t(0);

    void takeKind(const PackedParts& parts, std::size_t first, const std::vector<std::size_t>& same);
    void askFaces(const PackedParts& parts, std::size_t first, const std::vector<std::size_t>& same);
    bool addFaces(const HullTopology& topology, std::size_t lane);
    bool addSilhouette(const HullTopology& topology, std::size_t lane);
    void addFan(Entry& entry, std::size_t face);
    double leastTangent(const Entry& entry, std::size_t edge, std::size_t edges) const;
    glm::dvec2 wayOf(const Entry& entry, const glm::dvec3& point) const;
    glm::dvec3 silhouette(std::size_t at) const { return {_sx[at], _sy[at], _sz[at]}; }
    glm::dvec3 middle(std::size_t edge) const { return 0.5 * (silhouette(edge) + silhouette(edge + 1)); }
    void makeRoom();
    void cast();
    bool isGentle(const Entry& entry) const;
    bool landExactly(const Entry& entry);
    std::optional<glm::dvec3> exactEnd(const Entry& entry, const glm::dvec3& point, std::size_t query) const;
    void finish(Entry& entry);
    double areaAt(std::size_t a, std::size_t b, std::size_t c) const;
    double simplify(KernelFan& fan, double most);
    bool turnToStart(KernelFan& fan);
    void judge(std::size_t places);
    KernelFans kernelFans();
    bool findReach(std::size_t i, glm::dvec2& low, glm::dvec2& high) const;
    void takePlanes(std::size_t i);

    const Ground* _ground = nullptr;
    const HeightPyramid* _grid = nullptr; ///< the ground, if it is one.
    GridView _view{};
    glm::dvec2 _origin{0.0}, _scale{1.0}; ///< of the kernel's frame.
    double _base = 0.0;
    glm::dvec4 _light{0.0};
    bool _isLight = false;
    glm::dvec2 _way{0.0};                   ///< of a sun's rays in plan, a unit of descent.
    double _tangent = 0.0, _steepest = 0.0; ///< of the sun's elevation; of the grid's slopes.

    std::vector<Entry> _entries;
    std::vector<KernelFan> _fans;
    // Of parts of one kind, see KernelHulls.
    std::vector<float> _places;
    std::size_t _stride = 0;
    Lane _lightX, _lightY, _lightZ, _facePlanes, _facing, _sizes, _lows, _highs;
    std::vector<char> _lit; ///< faces of one part.
    std::vector<unsigned> _loop;
    std::vector<std::size_t> _same;
    std::vector<bool> _taken;

    std::size_t _edges = 0, _faces = 0, _queries = 0; ///< in use of the following.
    Lane _sx, _sy, _sz, _ex, _ey, _ez, _ew, _along, _cx, _cy, _cz, _mx, _my;
    Lane _fx, _fy, _fz, _fw;
    Lane _u, _v, _z, _du, _dv, _descent, _height, _work;
    std::vector<unsigned> _order;
    Lane _px, _py, _pu, _pv, _pz;
    GridDrape::Planes _planes;
    GridDrape _gridDrape;
    Drape _drape;
    std::vector<unsigned> _asked; ///< twice the place in _upper, or in _lower and one more.
};

} // namespace gnomon
