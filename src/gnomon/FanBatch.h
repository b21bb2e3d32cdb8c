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
    /// Of one part. Places are about the anchor.
    struct Entry {
        glm::dvec3 anchor{0.0};
        glm::dvec4 light{0.0};
        glm::dvec3 top{0.0};                             ///< its highest corner.
        double low = 0.0, size = 0.0;                    ///< its lowest height; from the anchor to its farthest corner.
        double tangent = 0.0;                            ///< of the light's least elevation.
        TerrainOutcome outcome = TerrainOutcome::edgeOn; ///< fan, as long as nothing else is known.
        bool isOut = false;                              ///< some corner of its silhouette is over the ground.
        double wrong = 0.0, seen = 0.0;                  ///< twice areas; what is wrong with the fan, of what is seen.
        std::size_t fan = 0, query = 0; ///< its own of the kernel's; of the corners, then of the edges.

        double off() const { return wrong > 0.0 ? wrong / seen : 0.0; } ///< see HullFan.
    };

    void begin(const Ground& ground, const glm::dvec4& light);
    /// @return whether it has a shadow of its own, though it may be turned away; entry().outcome says why not, but for what
    /// the ground tells.
    bool add(const PackedParts& parts, std::size_t part);
    /// The planes through the silhouettes' edges.
    void findEdges();
    /// Polygons of all that were added, for which findEdges() was called.
    void findFans();
    void clear(); ///< for the next parts, of the same light and ground.

    std::size_t size() const { return _entries.size(); }
    const Entry& entry(std::size_t i) const { return _entries[i]; }
    /// Corners of a fan that was found, about its anchor, counter-clockwise, from the one that sees all others.
    std::size_t cornerCount(std::size_t i) const { return _fans[_entries[i].fan].corners; }
    glm::dvec3 corner(std::size_t i, std::size_t at) const {
        const std::size_t place = _fans[_entries[i].fan].corner + at;
        return {_cx[place], _cy[place], _cz[place]};
    }
    Drape triangles(std::size_t i) const; ///< of a fan that was found, in the ground's frame.
    /// The ground's triangles in the shadow, about its anchor. @param error  in plan. @return until the next call.
    const Drape& drape(std::size_t i, double error);
    const Drape& allGround(std::size_t i); ///< the same of all the ground.
    /// In the ground's frame, planes with unit normals.
    ConvexShadow shadow(std::size_t i) const;

private:
    using Lane = std::vector<double>;
    /// Rays that are likely to start over the ground, or the others: so lanes end together.
    struct Queries {
        std::size_t count = 0;
        Lane u, v, z, du, dv, descent, height;
    };
    static constexpr unsigned none = ~0u;

    void decode(const PackedParts& parts, std::size_t part, Entry& entry);
    bool addFaces(const HullTopology& topology, const Entry& entry);
    bool addSilhouette(const HullTopology& topology);
    double leastTangent(const Entry& entry) const;
    glm::dvec2 wayOf(const Entry& entry, const glm::dvec3& point) const;
    glm::dvec3 silhouette(std::size_t at) const { return {_sx[at], _sy[at], _sz[at]}; }
    glm::dvec3 middle(std::size_t edge) const { return 0.5 * (silhouette(edge) + silhouette(edge + 1)); }
    void ask(Entry& entry);
    unsigned ask(const Entry& entry, const glm::dvec3& point);
    void cast(Queries& queries) const;
    double descent(unsigned query) const { return query % 2 ? _lower.descent[query / 2] : _upper.descent[query / 2]; }
    double height(unsigned query) const { return query % 2 ? _lower.height[query / 2] : _upper.height[query / 2]; }
    std::optional<glm::dvec3> placeOf(const Entry& entry, const glm::dvec3& point, unsigned query, bool exactly) const;
    bool isOut(const Entry& entry) const;
    bool isGentle(const Entry& entry) const;
    bool takePlaces(const Entry& entry, bool exactly);
    bool outline(Entry& entry);
    double doubleLenses(const Entry& entry, bool exactly) const;
    double areaAt(std::size_t a, std::size_t b, std::size_t c) const;
    static double doublePolygon(const Lane& x, const Lane& y, std::size_t first, std::size_t count);
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
    glm::dvec2 _way{0.0}; ///< of a sun's rays in plan, a unit of descent.

    std::vector<Entry> _entries;
    std::vector<KernelFan> _fans;
    std::vector<glm::dvec3> _corners; ///< of the part that is being added.
    std::vector<char> _lit;           ///< its faces.
    std::vector<unsigned> _loop;
    std::size_t _edges = 0, _faces = 0, _outlined = 0; ///< in use of the following.
    Lane _sx, _sy, _sz, _ex, _ey, _ez, _ew, _along;
    Lane _fx, _fy, _fz, _fw;
    Lane _cx, _cy, _cz;
    Lane _px, _py, _pu, _pv, _pz, _lightened;
    Queries _upper, _lower;
    GridDrape::Planes _planes;
    GridDrape _gridDrape;
    Drape _drape;
    std::vector<unsigned> _asked; ///< twice the place in _upper, or in _lower and one more.
};

} // namespace gnomon
