// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/ground/GroundSearch.h>
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
    explicit Layers(const std::vector<PlanBox>& boxes) {
        PlanBox all;
        std::vector<double> sizes;
        for (const PlanBox& box : boxes) all.add(box), sizes.push_back(box.diameter());
        std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
        const glm::dvec2 size = all.high - all.low;
        const double side = std::ceil(2.0 * std::sqrt(double(boxes.size())));
        _low = all.low;
        _cell = std::max({sizes[sizes.size() / 2], size.x / side, size.y / side, std::numeric_limits<double>::min()});
        _columns = std::size_t(size.x / _cell) + 1;
        _cells.resize(_columns * (std::size_t(size.y / _cell) + 1));
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
    /// Where a solid begins, and ends, as vertices. Without an end it does not go on.
    struct Corner {
        glm::dvec4 from;
        std::optional<glm::dvec4> end;
    };

    Writer(const glm::dvec4& light, const glm::dvec3& origin) {
        solids.origin = origin;
        solids.light = light.w == 0.0 ? light : glm::dvec4(glm::dvec3(light) / light.w - origin, 1.0);
        solids.low = glm::dvec3(infinite);
        solids.high = glm::dvec3(-infinite);
    }
    /// @param corners   counter-clockwise from the light.
    /// @param top       nearer to the light than these: the fan of a solid that does not begin flat.
    /// @param low,high  bounds of all of it.
    /// @param seen      in a plane in which those that hold one place overlap.
    void add(const std::vector<Corner>& corners, const std::optional<glm::dvec3>& top, const glm::dvec3& low,
             const glm::dvec3& high, const PlanBox& seen) {
        Beginning at{unsigned(solids.vertices.size()), unsigned(corners.size()), 0, _under.size()};
        for (const Corner& corner : corners) solids.vertices.emplace_back(corner.from);
        for (unsigned i = 0; i < at.count; ++i) {
            _under.push_back(corners[i].end ? unsigned(solids.vertices.size()) : at.first + i);
            if (corners[i].end) solids.vertices.emplace_back(*corners[i].end);
        }
        if (top) {
            at.top = unsigned(solids.vertices.size());
            solids.vertices.emplace_back(glm::dvec4(*top, 0.0));
        }
        _beginnings.push_back(at);
        _boxes.push_back(seen);
        solids.low = glm::min(solids.low, low);
        solids.high = glm::max(solids.high, high);
    }
    HullSolids finish();

    HullSolids solids; ///< finish() adds triangles and layers.

private:
    /// `count` vertices from `first` on, counter-clockwise from the light; and the one before all of them, 0: there is none.
    struct Beginning {
        unsigned first, count, top;
        std::size_t under; ///< place of its ends in `_under`.
        unsigned layer = 0;
    };
    void add(unsigned a, unsigned b, unsigned c) {
        if (a != b && b != c && c != a) solids.corners.insert(solids.corners.end(), {a, b, c});
    }
    void addSides(const Beginning& at);
    void addEnd(const Beginning& at) {
        const unsigned* under = &_under[at.under];
        for (unsigned i = 2; i < at.count; ++i) add(under[0], under[i], under[i - 1]);
    }

    std::vector<Beginning> _beginnings;
    std::vector<PlanBox> _boxes;
    std::vector<unsigned> _under; ///< the end of each corner that a solid begins with, or itself.
};

void Writer::addSides(const Beginning& at) {
    const unsigned* under = &_under[at.under];
    for (unsigned i = 0; i < at.count; ++i) {
        const unsigned j = i + 1 < at.count ? i + 1 : 0, a = at.first + i, b = at.first + j;
        add(under[i], under[j], b);
        add(under[i], b, a);
        if (at.top)
            add(at.top, a, b);
        else if (i > 1)
            add(at.first, a - 1, a);
    }
}

HullSolids Writer::finish() {
    if (_beginnings.empty()) {
        solids.low = solids.high = glm::dvec3(0.0);
        return std::move(solids);
    }
    Layers layers(_boxes);
    for (std::size_t i = 0; i < _boxes.size(); ++i) _beginnings[i].layer = layers.place(_boxes[i]);
    solids.mostOver = layers.mostOver;
    std::stable_sort(_beginnings.begin(), _beginnings.end(),
                     [](const Beginning& a, const Beginning& b) { return a.layer < b.layer; });
    const auto addAll = [this](const auto& addPart, std::vector<unsigned>& layerEnds) {
        for (const Beginning& at : _beginnings) {
            addPart(at);
            layerEnds.resize(at.layer + 1);
            layerEnds.back() = unsigned(solids.corners.size());
        }
    };
    addAll([this](const Beginning& at) { addSides(at); }, solids.sides);
    addAll([this](const Beginning& at) { addEnd(at); }, solids.ends);
    return std::move(solids);
}

/// Memory that is used again for part after part.
struct Outline {
    std::vector<glm::dvec3> corners; ///< of the silhouette, counter-clockwise from the light.
    std::vector<Seen> seen, other;
    std::vector<Writer::Corner> solid;
};

/// A part's solid, about its anchor.
class Solid {
public:
    Solid(const HullGround& ground, const HullPart& part, const glm::dvec4& light, Outline& outline)
        : _ground(ground),
          _part(part),
          _light(light.w == 0.0 ? light : glm::dvec4(glm::dvec3(light) / light.w - part.anchor, 1.0)),
          _outline(outline) {}

    HullOutcome find() {
        if (_part.front != glm::dvec4(0.0) && !(glm::dot(_part.front, _light) > 0.0)) return HullOutcome::unseen;
        const auto view = LightView::of(_part, _light);
        if (!view) return _part.faces.size() > 2 ? HullOutcome::lightInside : HullOutcome::unseen;
        if (!findSilhouette(*view) || isInGround()) return HullOutcome::unseen;
        if (_light.w != 0.0 && !(_light.z - _high.z > rounding * _part.size)) return HullOutcome::cast; // endless
        return findBottom();
    }

    /// What find() says that is cast.
    void write(Writer& writer) const {
        const glm::dvec3 by = _part.anchor - writer.solids.origin;
        _outline.solid.clear();
        for (const glm::dvec3& corner : _outline.corners)
            _outline.solid.push_back({{corner + by, 0.0}, endOf(corner, corner + by)});
        const double all = far * _part.size;
        PlanBox box = isEndless() ? PlanBox{glm::dvec2(_low) - all, glm::dvec2(_high) + all} : boxAt(_end);
        if (!isEndless()) box.add(boxAt(_high.z));
        const double bottom = isEndless() ? -all : std::min(_end, _low.z), top = isEndless() ? all : _high.z;
        const glm::dvec2 spare = 0.05 * (box.high - box.low); // for what a sun turns by until it is found anew
        const double rise = 0.05 * (top - bottom);
        const PlanBox plan{box.low - spare + glm::dvec2(by), box.high + spare + glm::dvec2(by)};
        writer.add(_outline.solid, _top ? std::optional(*_top + by) : std::nullopt, {plan.low, bottom - rise + by.z},
                   {plan.high, top + rise + by.z}, _light.w == 0.0 ? seenBox() : plan);
        HullSolids& solids = writer.solids;
        solids.largest = std::max(solids.largest, glm::length(_high - _low));
        solids.widest = std::max(solids.widest, isEndless() ? infinite : across());
    }

private:
    static constexpr double far = 1e6; // times a caster's size: beyond all that is seen

    bool isEndless() const { return !(_end < infinite); }

    /// False if the light meets it edge on.
    bool findSilhouette(const LightView& view) {
        std::vector<Seen>& seen = _outline.seen;
        seen.clear();
        for (unsigned i = 0; i < _part.corners.size(); ++i)
            seen.push_back(view.seen(glm::dvec3(_part.corners[i]), i, _part.size));
        if (seen.size() < 3) return false;
        const Seen top =
            *std::max_element(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.near < b.near; });
        keepHull(seen, _outline.other);
        if (seen.size() < 3) return false;
        double area = 0.0, wide = 0.0;
        _outline.corners.clear();
        bool isTopSeen = false;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            _outline.corners.emplace_back(_part.corners[seen[i].corner]);
            _low = glm::min(_low, _outline.corners.back());
            _high = glm::max(_high, _outline.corners.back());
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
        for (const glm::dvec3& corner : _outline.corners) {
            if (!isUnder(corner)) return false;
            middle += corner / double(_outline.corners.size());
        }
        return isUnder(middle);
    }

    glm::dvec3 towards(const glm::dvec3& corner) const { return glm::dvec3(_light) - _light.w * corner; }
    /// How far along the light down to a height, in lengths of the way from it.
    double lengthTo(double z, const glm::dvec3& corner) const { return (corner.z - z) / towards(corner).z; }
    /// Where what is above a height comes down to it, and what is not stands.
    PlanBox boxAt(double z) const {
        PlanBox box;
        for (const glm::dvec3& corner : _outline.corners)
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
        const glm::dvec3 way = towards(_outline.corners.front());
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

    /// @param vertex  the same about the origin of all.
    std::optional<glm::dvec4> endOf(const glm::dvec3& corner, const glm::dvec3& vertex) const {
        if (isEndless()) return glm::dvec4(vertex, -1.0);
        const bool goesOn = corner.z > _bottom + rounding * _part.size; // else no ground is below it
        return goesOn ? std::optional(glm::dvec4(vertex, lengthTo(_end, corner))) : std::nullopt;
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
    Outline& _outline;
    glm::dvec3 _low{infinite}, _high{-infinite};     ///< bounds of the silhouette.
    PlanBox _seen;                                   ///< the same across the light.
    std::optional<glm::dvec3> _top;                  ///< the corner nearest to the light, if it is none of them.
    double _bottom = infinite, _highest = -infinite; ///< of the ground that the solid may meet.
    double _end = infinite;                          ///< its own lowest height; infinite: it has no end.
};

/// All that is seen, whatever the light.
void writeEverything(const HullPart& part, Writer& writer) {
    const double far = 1e6 * (1.0 + glm::length(part.anchor - writer.solids.origin));
    std::vector<Writer::Corner> corners;
    for (const auto& [x, y] : {std::pair(-far, -far), {far, -far}, {far, far}, {-far, far}})
        corners.push_back({{x, y, far, 0.0}, glm::dvec4(x, y, -far, 0.0)});
    writer.add(corners, std::nullopt, glm::dvec3(-far), glm::dvec3(far), {glm::dvec2(-far), glm::dvec2(far)});
    writer.solids.widest = infinite;
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

HullSolids hullSolids(const HullGround& ground, const std::vector<HullPart>& parts, const glm::dvec4& light,
                      const glm::dvec3& origin) {
    Writer writer(light, origin);
    const auto count = [&](HullOutcome outcome) -> std::size_t& {
        return writer.solids.outcomes[std::size_t(outcome)];
    };
    if (light.w == 0.0) writer.solids.turn = mostTurn * std::min(1.0, light.z / glm::length(glm::dvec2(light)));
    if (!std::isfinite(light.x + light.y + light.z + light.w))
        count(HullOutcome::unseen) = parts.size();
    else if (isLightBelow(ground.ground, light))
        count(HullOutcome::lightBelow) = parts.size();
    else {
        Outline outline;
        for (const HullPart& part : parts) {
            Solid solid(ground, part, light, outline);
            const HullOutcome outcome = solid.find();
            ++count(outcome);
            if (outcome == HullOutcome::cast) solid.write(writer);
            if (outcome == HullOutcome::lightInside) writeEverything(part, writer);
        }
    }
    return writer.finish();
}

HullSolids boxSolids(const HullGround& ground, const std::vector<BoxCaster>& boxes, const glm::dvec4& light,
                     const glm::dvec3& origin) {
    Writer writer({0.0, 0.0, 1.0, 0.0}, origin); // from straight above
    for (const BoxCaster& box : boxes) {
        const bool isBelow = light.w == 0.0 && !(light.z > 0.0);
        const auto shadow = isBelow ? std::nullopt : boxShadow(ground.ground, box, light);
        const HullOutcome outcome = isBelow                                   ? HullOutcome::lightBelow
                                    : !shadow                                 ? HullOutcome::noGround
                                    : isBoxOutline(ground.ground, box, light) ? HullOutcome::cast
                                                                              : HullOutcome::boxed;
        ++writer.solids.outcomes[std::size_t(outcome)];
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
        std::vector<Writer::Corner> corners;
        for (const glm::dvec2& corner : pentagon)
            corners.push_back({{corner - by, high, 0.0}, glm::dvec4(corner - by, low, 0.0)});
        const PlanBox all{plan.low - by, plan.high - by};
        writer.add(corners, std::nullopt, {all.low, low}, {all.high, high}, all);
        double& widest = writer.solids.widest;
        widest = std::max(widest, std::hypot(plan.diameter(), range->high - range->low));
    }
    return writer.finish();
}

} // namespace gnomon
