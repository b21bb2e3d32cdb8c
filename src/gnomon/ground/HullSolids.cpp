// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/HullSolids.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-6; // of a part's size: what floats leave of a place, and some more
constexpr double mostTurn = 0.03; // of the light's tangent: half of what the margin allows for

struct PlanBox {
    glm::dvec2 low{infinite}, high{-infinite};
    void add(const glm::dvec2& place) { low = glm::min(low, place), high = glm::max(high, place); }
    void add(const PlanBox& other) { low = glm::min(low, other.low), high = glm::max(high, other.high); }
    double diameter() const { return glm::length(high - low); }
};

double sideOf(const glm::vec4& plane, const glm::dvec4& light) { return glm::dot(glm::dvec4(plane), light); }

/// A corner as seen from the light.
struct Seen {
    glm::dvec2 at;
    double near; ///< the more, the nearer to the light.
    unsigned corner;
};

double turn(const Seen& a, const Seen& b, const Seen& c) { return cross(b.at - a.at, c.at - a.at); }

/// Leaves the corners of the convex hull, counter-clockwise; of those that lie behind one another the nearest.
/// Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", IPL 9(5), 1979.
void keepHull(std::vector<Seen>& points, std::vector<Seen>& hull) {
    std::sort(points.begin(), points.end(), [](const Seen& a, const Seen& b) {
        return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y != b.at.y ? a.at.y < b.at.y : a.near > b.near;
    });
    points.erase(std::unique(points.begin(), points.end(), [](const Seen& a, const Seen& b) { return a.at == b.at; }),
                 points.end());
    hull.clear();
    for (const bool back : {false, true}) {
        const std::size_t start = hull.size();
        for (const Seen& point : points) {
            while (hull.size() >= start + 2 && !(turn(hull[hull.size() - 2], hull.back(), point) > 0.0))
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back(); // the other half begins with it
        if (!back) std::reverse(points.begin(), points.end());
    }
    std::swap(points, hull);
}

/// A plane of two coordinates that a light sees all of a part in; nullopt if a lamp is inside of it.
class LightView {
public:
    static std::optional<LightView> of(const HullPart& part, const glm::dvec4& light) {
        LightView view;
        view._light = light;
        glm::dvec3 axis(light);
        if (light.w != 0.0) { // across a face that it is before: all corners are behind that
            double most = 0.0;
            for (const glm::vec4& face : part.faces)
                if (const double side = sideOf(face, light); side > most) most = side, axis = glm::dvec3(face);
            if (!(most > 0.0)) return std::nullopt;
        }
        view._axis = glm::normalize(axis);
        const Across both = across(view._axis);
        view._u = both.u;
        view._v = both.v;
        return view;
    }
    /// In steps of what floats leave of a place: so that what is behind a corner is at the same place.
    Seen seen(const glm::dvec3& corner, unsigned number, double size) const {
        const glm::dvec3 way = corner - _light.w * glm::dvec3(_light);
        const double near = glm::dot(_axis, way), scale = _light.w == 0.0 ? 1.0 : -near;
        const double step = rounding * size / scale;
        const glm::dvec2 at = glm::dvec2(glm::dot(_u, way), glm::dot(_v, way)) / scale;
        return {step * glm::floor(at / step + 0.5), near, number};
    }

private:
    glm::dvec4 _light;
    glm::dvec3 _axis, _u, _v;
};

/// Layers by cells of a plane: a solid goes above all that were put into the cells it touches.
class Layers {
public:
    void begin(const std::vector<PlanBox>& boxes) {
        PlanBox all;
        std::vector<double> sizes;
        for (const PlanBox& box : boxes) all.add(box), sizes.push_back(box.diameter());
        std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
        const glm::dvec2 size = all.high - all.low;
        const double side = std::ceil(2.0 * std::sqrt(double(boxes.size())));
        _low = all.low;
        _cell = std::max({sizes[sizes.size() / 2], size.x / side, size.y / side, std::numeric_limits<double>::min()});
        _columns = std::size_t(size.x / _cell) + 1;
        _cells.assign(_columns * (std::size_t(size.y / _cell) + 1), {});
        mostOver = 0;
    }
    unsigned place(const PlanBox& box) {
        unsigned layer = 0;
        each(box, [&](const Cell& cell) { layer = std::max(layer, cell.above); });
        each(box, [&](Cell& cell) {
            cell.above = layer + 1;
            mostOver = std::max(mostOver, ++cell.solids);
        });
        return layer;
    }
    unsigned mostOver = 0;

private:
    struct Cell {
        unsigned above = 0, solids = 0;
    };
    template <typename Step>
    void each(const PlanBox& box, const Step& step) {
        const glm::dvec2 from = (box.low - _low) / _cell, to = (box.high - _low) / _cell;
        for (auto y = std::size_t(from.y); y <= std::size_t(to.y); ++y)
            for (auto x = std::size_t(from.x); x <= std::size_t(to.x); ++x) step(_cells[y * _columns + x]);
    }
    glm::dvec2 _low{0.0};
    double _cell = 1.0;
    std::size_t _columns = 1;
    std::vector<Cell> _cells;
};

/// Solids one after the other; finish() puts them into layers.
class Writer {
public:
    Writer(HullSolids& into, const glm::dvec4& light, const glm::dvec3& origin) : _into(into) {
        into.origin = origin;
        into.light = light.w == 0.0 ? light : glm::dvec4(glm::dvec3(light) / light.w - origin, 1.0);
        into.vertices.clear();
        memory().beginnings.clear();
        into.outcomes = {};
        into.low = glm::dvec3(infinite);
        into.high = glm::dvec3(-infinite);
        into.widest = into.largest = into.turn = 0.0;
        memory().boxes.clear();
        memory().under.clear();
    }
    void begin() { _first = unsigned(_into.vertices.size()), _ends.clear(), _top.reset(); }
    /// Nearer to the light than the corners: the fan of a solid that does not begin flat.
    void top(const glm::dvec3& place) { _top = place; }
    /// @param from  where it begins, as a vertex.
    /// @param end  as a vertex; nullopt: it does not go on.
    void corner(const glm::dvec4& from, const std::optional<glm::dvec4>& end) {
        _into.vertices.emplace_back(from);
        _ends.push_back(end);
    }
    /// @param box   of all of it in plan. @param bottom,top  and upright.
    /// @param seen  in a plane in which those that hold one place overlap.
    void end(const PlanBox& box, double bottom, double top, const PlanBox& seen) {
        Memory& kept = memory();
        kept.beginnings.push_back({_first, unsigned(_ends.size()), 0});
        for (unsigned i = 0; i < _ends.size(); ++i) {
            kept.under.push_back(_ends[i] ? unsigned(_into.vertices.size()) : _first + i);
            if (_ends[i]) _into.vertices.emplace_back(*_ends[i]);
        }
        if (_top) {
            kept.beginnings.back().top = unsigned(_into.vertices.size());
            _into.vertices.emplace_back(glm::dvec4(*_top, 0.0));
        }
        kept.boxes.push_back(seen);
        _into.low = glm::min(_into.low, glm::dvec3(box.low, bottom));
        _into.high = glm::max(_into.high, glm::dvec3(box.high, top));
    }
    void finish();

private:
    using Triangles = std::vector<unsigned>;
    /// `count` vertices from `first` on, counter-clockwise from the light; and the one before all of them, 0: there is none.
    struct Beginning {
        unsigned first, count, top;
    };
    /// That is used again.
    struct Memory {
        std::vector<Beginning> beginnings;
        std::vector<PlanBox> boxes;
        std::vector<unsigned> under; ///< the end of each corner that a solid begins with, or itself.
        Layers layers;
        std::vector<Triangles> sides, ends; ///< of each layer.
    };
    static Memory& memory() {
        thread_local Memory kept;
        return kept;
    }
    static void add(Triangles& to, unsigned a, unsigned b, unsigned c) {
        if (a != b && b != c && c != a) to.insert(to.end(), {a, b, c});
    }
    static void addSolid(const Beginning& at, const unsigned* under, Triangles& sides, Triangles& ends);

    HullSolids& _into;
    unsigned _first = 0;
    std::optional<glm::dvec3> _top;
    std::vector<std::optional<glm::dvec4>> _ends;
};

void Writer::addSolid(const Beginning& at, const unsigned* under, Triangles& sides, Triangles& ends) {
    for (unsigned i = 0; i < at.count; ++i) {
        const unsigned j = i + 1 < at.count ? i + 1 : 0, a = at.first + i, b = at.first + j;
        add(sides, under[i], under[j], b);
        add(sides, under[i], b, a);
        if (at.top) add(sides, at.top, a, b);
        if (i < 2) continue;
        if (!at.top) add(sides, at.first, a - 1, a);
        add(ends, under[0], under[i], under[i - 1]);
    }
}

void Writer::finish() {
    _into.corners.clear();
    _into.sides.clear();
    _into.ends.clear();
    _into.mostOver = 0;
    if (memory().beginnings.empty()) {
        _into.low = _into.high = glm::dvec3(0.0);
        return;
    }
    Memory& kept = memory();
    for (auto* all : {&kept.sides, &kept.ends})
        for (Triangles& one : *all) one.clear();
    kept.layers.begin(kept.boxes);
    std::size_t used = 0;
    const unsigned* under = kept.under.data();
    for (std::size_t i = 0; i < kept.boxes.size(); under += kept.beginnings[i++].count) {
        const std::size_t layer = kept.layers.place(kept.boxes[i]);
        used = std::max(used, layer + 1);
        if (kept.sides.size() < used) kept.sides.resize(used), kept.ends.resize(used);
        addSolid(kept.beginnings[i], under, kept.sides[layer], kept.ends[layer]);
    }
    _into.mostOver = kept.layers.mostOver;
    const auto append = [&](const std::vector<Triangles>& all, std::vector<unsigned>& ends) {
        for (std::size_t i = 0; i < used; ++i) {
            _into.corners.insert(_into.corners.end(), all[i].begin(), all[i].end());
            ends.push_back(unsigned(_into.corners.size()));
        }
    };
    append(kept.sides, _into.sides);
    append(kept.ends, _into.ends);
}

/// A part's solid, about its anchor.
class Solid {
public:
    Solid(const HullGround& ground, const HullPart& part, const glm::dvec4& light)
        : _ground(ground),
          _part(part),
          _light(light.w == 0.0 ? light : glm::dvec4(glm::dvec3(light) / light.w - part.anchor, 1.0)),
          _kept(memory()) {}

    HullOutcome find() {
        if (_part.front != glm::dvec4(0.0) && !(glm::dot(_part.front, _light) > 0.0)) return HullOutcome::unseen;
        const auto view = LightView::of(_part, _light);
        if (!view) return _part.faces.size() > 2 ? HullOutcome::lightInside : HullOutcome::unseen;
        if (!findSilhouette(*view) || isInGround()) return HullOutcome::unseen;
        if (_light.w != 0.0 && !(_light.z - _high.z > rounding * _part.size)) return HullOutcome::cast; // endless
        return findBottom();
    }

    /// What find() says that is cast.
    void write(Writer& writer, HullSolids& into) {
        const glm::dvec3 by = _part.anchor - into.origin;
        writer.begin();
        if (isEndless())
            writeEndless(writer, by);
        else
            writeDown(writer, by);
        into.largest = std::max(into.largest, glm::length(_high - _low));
        into.widest = std::max(into.widest, isEndless() ? infinite : across());
    }

private:
    static constexpr double far = 1e6; // times a caster's size: beyond all that is seen

    struct Memory {
        std::vector<glm::dvec3> corners; ///< of the silhouette, counter-clockwise from the light.
        std::vector<Seen> seen, other;
    };
    static Memory& memory() {
        thread_local Memory kept;
        return kept;
    }
    bool isEndless() const { return !(_end < infinite); }

    /// False if the light meets it edge on.
    bool findSilhouette(const LightView& view) {
        std::vector<Seen>& seen = _kept.seen;
        seen.clear();
        for (unsigned i = 0; i < _part.corners.size(); ++i)
            seen.push_back(view.seen(glm::dvec3(_part.corners[i]), i, _part.size));
        if (seen.size() < 3) return false;
        const Seen top =
            *std::max_element(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.near < b.near; });
        keepHull(seen, _kept.other);
        if (seen.size() < 3) return false;
        double area = 0.0, wide = 0.0;
        _kept.corners.clear();
        bool isTopSeen = false;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            _kept.corners.emplace_back(_part.corners[seen[i].corner]);
            _low = glm::min(_low, _kept.corners.back());
            _high = glm::max(_high, _kept.corners.back());
            if (i > 1) area += turn(seen[0], seen[i - 1], seen[i]);
            wide = std::max(wide, glm::length(seen[i].at - seen[0].at));
            isTopSeen = isTopSeen || seen[i].near == top.near;
            _seen.add(seen[i].at);
        }
        if (!isTopSeen) _top = glm::dvec3(_part.corners[top.corner]);
        return area > 1e-9 * wide * wide;
    }

    bool isUnder(const glm::dvec3& place) const {
        const glm::dvec3 there = place + _part.anchor;
        const double spare = rounding * _part.size;
        const auto height = _ground.ground.height(there.x, there.y);
        if (!height || !(there.z <= *height + spare)) return false;
        return !_ground.hasStoreys || !_ground.ground.hit(there - glm::dvec3(0.0, 0.0, 2.0 * spare), {0.0, 0.0, -1.0});
    }
    /// As a rug is: it would lie in the very surface that receives.
    bool isInGround() const {
        glm::dvec3 middle(0.0);
        for (const glm::dvec3& corner : _kept.corners) {
            if (!isUnder(corner)) return false;
            middle += corner / double(_kept.corners.size());
        }
        return isUnder(middle);
    }

    glm::dvec3 towards(const glm::dvec3& corner) const { return glm::dvec3(_light) - _light.w * corner; }
    /// How far along the light down to a height, in lengths of the way from it.
    double lengthTo(double z, const glm::dvec3& corner) const { return (corner.z - z) / towards(corner).z; }
    /// Where what is above a height comes down to it, and what is not stands.
    PlanBox boxAt(double z) const {
        PlanBox box;
        for (const glm::dvec3& corner : _kept.corners)
            box.add(glm::dvec2(corner) - lengthTo(std::min(z, corner.z), corner) * glm::dvec2(towards(corner)));
        return box;
    }
    double across() const {
        const double top = std::min(_high.z, _highest);
        PlanBox box = boxAt(_bottom);
        box.add(boxAt(top));
        return std::hypot(box.diameter(), std::max(0.0, top - _bottom));
    }

    /// Slice by slice, until one is wholly in the ground.
    HullOutcome findBottom() {
        const double lowest = _ground.all.low - _part.anchor.z, highest = _ground.all.high - _part.anchor.z;
        if (!(lowest <= highest)) return HullOutcome::noGround;
        const glm::dvec3 way = towards(_kept.corners.front());
        double z = std::min(_high.z, highest), next = z;
        double step = std::max((z - lowest) / 64.0, boxAt(_high.z).diameter() * way.z /
                                                        std::max(glm::length(glm::dvec2(way)), 1e-9 * way.z));
        for (PlanBox above = boxAt(z); next > lowest || next == z; step *= 1.25) {
            next = std::max(z - step, lowest);
            const PlanBox below = boxAt(next);
            PlanBox slice = above;
            slice.add(below);
            const glm::dvec2 anchor(_part.anchor);
            if (const auto range = _ground.ground.range(anchor + slice.low, anchor + slice.high)) {
                const double low = range->low - _part.anchor.z, high = range->high - _part.anchor.z;
                if (low > z && !range->holes) break;
                if (low <= z && high >= next) {
                    _bottom = std::min(_bottom, std::max(low, next));
                    _highest = std::max(_highest, std::min(high, z));
                }
            }
            if (next <= lowest) break;
            z = next;
            above = below;
        }
        if (!(_bottom < infinite)) return HullOutcome::noGround;
        const double spare = _ground.margin * std::max(across(), _high.z - _bottom) + rounding * _part.size;
        _end = _bottom - spare;
        return HullOutcome::cast;
    }

    void writeDown(Writer& writer, const glm::dvec3& by) const {
        for (const glm::dvec3& corner : _kept.corners) {
            const bool goesOn = corner.z > _bottom + rounding * _part.size; // else no ground is below it
            writer.corner({corner + by, 0.0},
                          goesOn ? std::optional(glm::dvec4(corner + by, lengthTo(_end, corner))) : std::nullopt);
        }
        if (_top) writer.top(*_top + by);
        PlanBox box = boxAt(_end);
        box.add(boxAt(_high.z));
        finish(writer, box, std::min(_end, _low.z), _high.z, by);
    }
    void writeEndless(Writer& writer, const glm::dvec3& by) const {
        for (const glm::dvec3& corner : _kept.corners) writer.corner({corner + by, 0.0}, glm::dvec4(corner + by, -1.0));
        if (_top) writer.top(*_top + by);
        const double all = far * _part.size;
        finish(writer, {glm::dvec2(_low) - all, glm::dvec2(_high) + all}, -all, all, by);
    }
    void finish(Writer& writer, const PlanBox& box, double bottom, double top, const glm::dvec3& by) const {
        const glm::dvec2 spare = 0.05 * (box.high - box.low); // for what a sun turns by until it is found anew
        const PlanBox all{box.low - spare + glm::dvec2(by), box.high + spare + glm::dvec2(by)};
        const double rise = 0.05 * (top - bottom);
        writer.end(all, bottom - rise + by.z, top + rise + by.z, _light.w == 0.0 ? seenBox() : all);
    }
    /// Of all parts in the plane across a sun, with some to spare as above.
    PlanBox seenBox() const {
        const Across both = gnomon::across(glm::normalize(glm::dvec3(_light)));
        const glm::dvec2 by(glm::dot(both.u, _part.anchor), glm::dot(both.v, _part.anchor));
        const glm::dvec2 spare = 0.05 * (_seen.high - _seen.low);
        return {_seen.low - spare + by, _seen.high + spare + by};
    }

    const HullGround& _ground;
    const HullPart& _part;
    const glm::dvec4 _light;
    Memory& _kept;
    glm::dvec3 _low{infinite}, _high{-infinite};     ///< bounds of the silhouette.
    PlanBox _seen;                                   ///< the same across the light.
    std::optional<glm::dvec3> _top;                  ///< the corner nearest to the light, if it is none of them.
    double _bottom = infinite, _highest = -infinite; ///< of the ground that the solid may meet.
    double _end = infinite;                          ///< its own lowest height; infinite: it has no end.
};

/// All that is seen, whatever the light.
void writeEverything(const HullPart& part, Writer& writer, HullSolids& into) {
    const glm::dvec3 middle = part.anchor - into.origin;
    const double far = 1e6 * (1.0 + glm::length(middle));
    writer.begin();
    for (const auto& [x, y] : {std::pair(-far, -far), {far, -far}, {far, far}, {-far, far}})
        writer.corner({x, y, far, 0.0}, glm::dvec4(x, y, -far, 0.0));
    const PlanBox all{glm::dvec2(-far), glm::dvec2(far)};
    writer.end(all, -far, far, all);
    into.widest = infinite;
}

} // namespace

HullPart::HullPart(const ConvexPart& part) {
    const std::vector<glm::dvec3>& all = part.hull.vertices;
    if (all.empty()) return;
    anchor = all.front();
    for (const glm::dvec3& corner : all) {
        corners.emplace_back(corner - anchor);
        size = std::max(size, glm::length(corner - anchor));
    }
    const auto about = [this](const glm::dvec4& plane) {
        return glm::dvec4(glm::dvec3(plane), plane.w + glm::dot(glm::dvec3(plane), anchor));
    };
    for (const ConvexHull::Face& face : part.hull.faces) {
        const glm::vec4 plane(about(face.plane));
        if (std::find(faces.begin(), faces.end(), plane) == faces.end()) faces.push_back(plane);
    }
    if (part.front) front = about(*part.front);
}

HullGround::HullGround(const Ground& of, double share)
    : ground(of), margin(share), all{infinite, -infinite, 0.0}, hasStoreys(!dynamic_cast<const HeightPyramid*>(&of)) {
    if (const auto range = of.range(glm::dvec2(-infinite), glm::dvec2(infinite))) all = *range;
}

bool isLightBelow(const Ground& ground, const glm::dvec4& light) {
    if (light.w == 0.0) return !(light.z > 0.0);
    const glm::dvec3 lamp = glm::dvec3(light) / light.w;
    const auto height = ground.height(lamp.x, lamp.y);
    return height && lamp.z <= *height;
}

int HullSolids::around(const glm::dvec3& place) const {
    const glm::dvec3 at = place - origin;
    if (glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high))) return 0;
    constexpr double far = 1e6; // times the way from a lamp
    const auto placeOf = [this](unsigned corner) {
        const glm::dvec4 vertex(vertices[corner]);
        const glm::dvec3 from(vertex), away = light.w * from - glm::dvec3(light);
        return from + (vertex.w < 0.0 ? far : vertex.w) * away;
    };
    int count = 0;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const GroundTriangle triangle{placeOf(corners[i]), placeOf(corners[i + 1]), placeOf(corners[i + 2])};
        if (meet(triangle, at, {0.0, 0.0, 1.0}))
            count += doubleArea(triangle[0], triangle[1], triangle[2]) > 0.0 ? 1 : -1;
    }
    return count;
}

void hullSolids(const HullGround& ground, const std::vector<HullPart>& parts, const glm::dvec4& light,
                const glm::dvec3& origin, HullSolids& into) {
    Writer writer(into, light, origin);
    const auto count = [&into](HullOutcome outcome) -> std::size_t& { return into.outcomes[std::size_t(outcome)]; };
    if (!std::isfinite(light.x + light.y + light.z + light.w))
        count(HullOutcome::unseen) = parts.size();
    else if (isLightBelow(ground.ground, light))
        count(HullOutcome::lightBelow) = parts.size();
    else
        for (const HullPart& part : parts) {
            Solid solid(ground, part, light);
            const HullOutcome outcome = solid.find();
            ++count(outcome);
            if (outcome == HullOutcome::cast) solid.write(writer, into);
            if (outcome == HullOutcome::lightInside) writeEverything(part, writer, into);
        }
    writer.finish();
    if (light.w == 0.0) into.turn = mostTurn * std::min(1.0, light.z / glm::length(glm::dvec2(light)));
}

void boxSolids(const HullGround& ground, const std::vector<BoxCaster>& boxes, const glm::dvec4& light,
               const glm::dvec3& origin, HullSolids& into) {
    Writer writer(into, {0.0, 0.0, 1.0, 0.0}, origin); // from straight above
    for (const BoxCaster& box : boxes) {
        const bool isBelow = light.w == 0.0 && !(light.z > 0.0);
        const auto shadow = isBelow ? std::nullopt : boxShadow(ground.ground, box, light);
        const HullOutcome outcome = isBelow                                   ? HullOutcome::lightBelow
                                    : !shadow                                 ? HullOutcome::noGround
                                    : isBoxOutline(ground.ground, box, light) ? HullOutcome::cast
                                                                              : HullOutcome::boxed;
        ++into.outcomes[std::size_t(outcome)];
        if (!shadow) continue;
        auto pentagon = boxPentagon(*shadow);
        double area = 0.0;
        PlanBox plan;
        for (std::size_t i = 0; i < pentagon.size(); ++i) {
            plan.add(pentagon[i]);
            area += cross(pentagon[i] - pentagon[0], pentagon[(i + 1) % 5] - pentagon[0]);
        }
        if (area < 0.0) std::reverse(pentagon.begin(), pentagon.end());
        const auto range = ground.ground.range(plan.low, plan.high);
        if (!range) continue;
        const double spare = ground.margin * plan.diameter(), low = range->low - spare - origin.z,
                     high = range->high + spare - origin.z;
        const glm::dvec2 by(origin);
        writer.begin();
        for (const glm::dvec2& corner : pentagon)
            writer.corner({corner - by, high, 0.0}, glm::dvec4(corner - by, low, 0.0));
        const PlanBox all{plan.low - by, plan.high - by};
        writer.end(all, low, high, all);
        into.widest = std::max(into.widest, std::hypot(plan.diameter(), range->high - range->low));
    }
    writer.finish();
}

} // namespace gnomon
