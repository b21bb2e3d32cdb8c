// SPDX-License-Identifier: MIT
#include <gnomon/geometry/KeyNumbers.h>
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/overlay/ShadowDecals.h>
#include <gnomon/overlay/ShadowPrisms.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

namespace gnomon {
namespace {

double diameterOf(const GroundBox& box) { return glm::length(glm::dvec2(box.high - box.low)); } // in plan

/// Whether there is a prism over it: it has corners, all finite, not all at one place.
bool isThere(const Drape& shadow) {
    const auto isFinite = [](const glm::dvec3& corner) { return std::isfinite(corner.x + corner.y + corner.z); };
    const auto isElsewhere = [&](const glm::dvec3& corner) { return glm::dvec2(corner) != glm::dvec2(shadow.front()); };
    return std::all_of(shadow.begin(), shadow.end(), isFinite) &&
           std::any_of(shadow.begin(), shadow.end(), isElsewhere);
}

GroundBox boxOf(const Drape& shadow) {
    GroundBox box{shadow.front(), shadow.front()};
    for (const glm::dvec3& corner : shadow) box = {glm::min(box.low, corner), glm::max(box.high, corner)};
    return box;
}

/// A shadow in plan, or a part of it that does not lie over itself: corners, each once, and triangles, counter-clockwise.
struct Plan {
    std::vector<glm::dvec3> corners;
    std::vector<std::array<unsigned, 3>> triangles;
};

/// Corners of neighbours that rounding has parted are one to a millionth of the shadow's size.
class Corners {
public:
    /// @param most  corners at most.
    void begin(const GroundBox& box, std::size_t most) {
        _low = box.low;
        _step = 1e-6 * diameterOf(box);
        _numbers.clear(most);
    }
    unsigned of(const glm::dvec3& place, Plan& plan) {
        const glm::dvec3 steps = glm::floor((place - _low) / _step + 0.5);
        const unsigned number = _numbers.of({std::int64_t(steps.x), std::int64_t(steps.y), std::int64_t(steps.z)});
        if (number == plan.corners.size()) plan.corners.push_back(place);
        return number;
    }

private:
    glm::dvec3 _low{0.0};
    double _step = 1.0;
    KeyNumbers<std::array<std::int64_t, 3>> _numbers;
};

struct Planned {
    Plan plan;
    bool folded = false; ///< some triangle was clockwise.
};

Planned planOf(const Drape& shadow, const GroundBox& box, Corners& corners) {
    Planned result;
    Plan& plan = result.plan;
    corners.begin(box, shadow.size());
    for (std::size_t i = 0; i + 2 < shadow.size(); i += 3) {
        std::array<unsigned, 3> t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = corners.of(shadow[i + k], plan);
        const double area = doubleArea(plan.corners[t[0]], plan.corners[t[1]], plan.corners[t[2]]);
        result.folded = result.folded || area < 0.0;
        if (area < 0.0) std::swap(t[1], t[2]);
        if (area != 0.0) plan.triangles.push_back(t);
    }
    return result;
}

/// KeyNumbers of the triangles' connected parts.
std::vector<unsigned> partsOf(const Plan& plan) {
    std::vector<unsigned> above(plan.corners.size());
    std::iota(above.begin(), above.end(), 0u);
    const auto root = [&](unsigned corner) {
        while (above[corner] != corner) corner = above[corner] = above[above[corner]];
        return corner;
    };
    for (const auto& t : plan.triangles) above[root(t[1])] = above[root(t[2])] = root(t[0]);
    std::vector<unsigned> parts;
    for (const auto& t : plan.triangles) parts.push_back(root(t[0]));
    return parts;
}

/// Ground of several storeys gives parts that lie over one another, a folded mesh triangles that do: a prism each.
std::vector<Plan> unfolded(Planned planned) {
    const std::vector<unsigned> parts = partsOf(planned.plan);
    const auto isFirst = [&](unsigned part) { return part == parts.front(); };
    if (!planned.folded && std::all_of(parts.begin(), parts.end(), isFirst)) return {std::move(planned.plan)};
    std::map<unsigned, Plan> plans;
    std::map<std::pair<unsigned, unsigned>, unsigned> places;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const unsigned part = planned.folded ? unsigned(i) : parts[i];
        Plan& plan = plans[part];
        std::array<unsigned, 3> triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned corner = planned.plan.triangles[i][k];
            const auto [found, isNew] = places.try_emplace({part, corner}, unsigned(plan.corners.size()));
            if (isNew) plan.corners.push_back(planned.plan.corners[corner]);
            triangle[k] = found->second;
        }
        plan.triangles.push_back(triangle);
    }
    std::vector<Plan> result;
    for (auto& [part, plan] : plans) result.push_back(std::move(plan));
    return result;
}

/// How often an outline goes along edges, more often than back.
class Outline {
public:
    void of(const Plan& plan) {
        _numbers.clear(3 * plan.triangles.size());
        times.clear();
        for (const auto& t : plan.triangles)
            for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3]);
    }
    std::vector<int> times; ///< of each edge.
    unsigned from(std::size_t edge) const { return unsigned(_numbers.keys[edge] >> 32); }
    unsigned to(std::size_t edge) const { return unsigned(_numbers.keys[edge]); }

private:
    static std::uint64_t key(unsigned from, unsigned to) { return std::uint64_t(from) << 32 | to; }
    void add(unsigned from, unsigned to) {
        const unsigned back = _numbers.find(key(to, from));
        if (back != KeyNumbers<std::uint64_t>::none && times[back] > 0) {
            --times[back];
            return;
        }
        const unsigned number = _numbers.of(key(from, to));
        if (number == times.size()) times.push_back(0);
        ++times[number];
    }
    KeyNumbers<std::uint64_t> _numbers;
};

/// Layers by cells of plan: a prism goes above all that were put into the cells it touches.
class Layers {
public:
    /// @param cell  smaller ones than that many prisms are worth are not taken.
    Layers(const GroundBox& all, double cell, std::size_t prisms) : _low(all.low) {
        const double side = std::ceil(2.0 * std::sqrt(double(prisms)));
        const glm::dvec2 size(all.high - all.low);
        _cell = std::max({cell, size.x / side, size.y / side, std::numeric_limits<double>::min()});
        _columns = std::size_t(size.x / _cell) + 1;
        _cells.resize(_columns * (std::size_t(size.y / _cell) + 1));
    }
    unsigned place(const GroundBox& box) {
        unsigned layer = 0;
        each(box, [&](const Cell& cell) { layer = std::max(layer, cell.above); });
        each(box, [&](Cell& cell) {
            cell.above = layer + 1;
            mostOver = std::max(mostOver, ++cell.prisms);
        });
        return layer;
    }
    unsigned mostOver = 0; ///< prisms in a cell.

private:
    struct Cell {
        unsigned above = 0, prisms = 0;
    };
    template <typename Step>
    void each(const GroundBox& box, const Step& step) {
        const glm::dvec2 from = (glm::dvec2(box.low) - _low) / _cell, to = (glm::dvec2(box.high) - _low) / _cell;
        for (auto y = std::size_t(from.y); y <= std::size_t(to.y); ++y)
            for (auto x = std::size_t(from.x); x <= std::size_t(to.x); ++x) step(_cells[y * _columns + x]);
    }
    const glm::dvec2 _low;
    double _cell;
    std::size_t _columns;
    std::vector<Cell> _cells;
};

class Builder {
public:
    Builder(ShadowPrisms& prisms, const glm::dvec3& origin) : _prisms(prisms), _origin(origin) {}

    void add(const Plan& plan, double bottom, double top, std::vector<unsigned>& layer) {
        const unsigned first = nextVertex();
        for (const glm::dvec3& corner : plan.corners) stand(corner - _origin, bottom - _origin.z, top - _origin.z);
        for (const auto& [a, b, c] : plan.triangles) addCaps(layer, first, a, b, c);
        _outline.of(plan);
        for (std::size_t edge = 0; edge < _outline.times.size(); ++edge)
            for (int i = 0; i < _outline.times[edge]; ++i)
                addWall(layer, first, _outline.from(edge), _outline.to(edge));
    }
    /// @param fan  a polygon of which its first corner sees all; it and the heights about the origin.
    void add(const PackedShadow& fan, double bottom, double top, std::vector<unsigned>& layer) {
        const unsigned first = nextVertex(), count = unsigned(fan.cornerCount);
        for (unsigned i = 0; i < count; ++i) stand(glm::dvec3(fan.corners[i]), bottom, top);
        for (unsigned i = 2; i < count; ++i) addCaps(layer, first, 0, i - 1, i);
        for (unsigned i = 0; i < count; ++i) addWall(layer, first, i, i + 1 < count ? i + 1 : 0);
    }
    Corners corners;

private:
    unsigned nextVertex() const { return unsigned(_prisms.vertices.size()); }
    void stand(const glm::dvec3& corner, double bottom, double top) {
        _prisms.vertices.emplace_back(glm::dvec3(corner.x, corner.y, bottom));
        _prisms.vertices.emplace_back(glm::dvec3(corner.x, corner.y, top));
    }
    static void addCaps(std::vector<unsigned>& layer, unsigned first, unsigned a, unsigned b, unsigned c) {
        const unsigned low = first, high = first + 1;
        layer.insert(layer.end(), {high + 2 * a, high + 2 * b, high + 2 * c, low + 2 * a, low + 2 * c, low + 2 * b});
    }
    static void addWall(std::vector<unsigned>& layer, unsigned first, unsigned from, unsigned to) {
        const unsigned low = first, high = first + 1;
        layer.insert(layer.end(),
                     {low + 2 * from, low + 2 * to, high + 2 * to, low + 2 * from, high + 2 * to, high + 2 * from});
    }

    ShadowPrisms& _prisms;
    const glm::dvec3 _origin;
    Outline _outline;
};

/// So that a prism touches few cells, and few others touch the same.
double cellFor(const std::vector<GroundBox>& boxes) {
    std::vector<double> sizes;
    for (const GroundBox& box : boxes) sizes.push_back(diameterOf(box));
    std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
    return std::max(sizes[sizes.size() / 2], 1e-3 * *std::max_element(sizes.begin(), sizes.end()));
}

GroundBox boundsOf(const std::vector<GroundBox>& boxes) {
    GroundBox all = boxes.front();
    for (const GroundBox& box : boxes) all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
    return all;
}

std::vector<unsigned>& layerAt(ShadowPrisms& prisms, std::size_t layer) {
    if (prisms.layers.size() <= layer) prisms.layers.resize(layer + 1);
    return prisms.layers[layer];
}

void clear(ShadowPrisms& prisms) {
    prisms.vertices.clear();
    for (std::vector<unsigned>& layer : prisms.layers) layer.clear();
    prisms.mostOver = 0;
    prisms.low = prisms.high = glm::dvec3(0.0);
}

/// Layers that another time needed, and this one does not.
void finish(ShadowPrisms& prisms, const Layers& layers) {
    while (!prisms.layers.empty() && prisms.layers.back().empty()) prisms.layers.pop_back();
    prisms.mostOver = layers.mostOver;
}

/// Nothing if it has no area, or is over no ground.
std::optional<GroundBox> boxOver(const Ground& ground, const PackedShadow& shadow, const glm::dvec3& origin,
                                 double margin) {
    if (shadow.cornerCount < 3) return std::nullopt;
    glm::vec3 low = shadow.corners[0], high = low;
    for (std::size_t i = 1; i < shadow.cornerCount; ++i)
        low = glm::min(low, shadow.corners[i]), high = glm::max(high, shadow.corners[i]);
    GroundBox box{glm::dvec3(low), glm::dvec3(high)};
    const double diameter = diameterOf(box);
    const auto range = ground.range(glm::dvec2(box.low + origin), glm::dvec2(box.high + origin));
    if (!range || !(diameter > 0.0)) return std::nullopt;
    box.low.z = std::min(box.low.z, range->low - origin.z) - margin * diameter;
    box.high.z = std::max(box.high.z, range->high - origin.z) + margin * diameter;
    return box;
}

} // namespace

ShadowPrisms shadowPrisms(const std::vector<Drape>& shadows, const glm::dvec3& origin) {
    ShadowPrisms prisms;
    std::vector<GroundBox> boxes;
    std::vector<const Drape*> there;
    for (const Drape& shadow : shadows) {
        if (!isThere(shadow)) continue;
        boxes.push_back(boxOf(shadow));
        there.push_back(&shadow);
    }
    if (boxes.empty()) return prisms;
    Layers layers(boundsOf(boxes), cellFor(boxes), boxes.size());
    Builder builder(prisms, origin);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double margin = 0.5 * diameterOf(boxes[i]);
        boxes[i].low.z -= margin;
        boxes[i].high.z += margin;
        for (const Plan& plan : unfolded(planOf(*there[i], boxes[i], builder.corners)))
            builder.add(plan, boxes[i].low.z, boxes[i].high.z, layerAt(prisms, layers.place(boxOf(plan.corners))));
    }
    finish(prisms, layers);
    const GroundBox all = boundsOf(boxes);
    prisms.low = all.low - origin;
    prisms.high = all.high - origin;
    return prisms;
}

void shadowPrisms(const Ground& ground, const PackedShadows& shadows, double margin, const HeightPyramid* drawn,
                  ShadowPrisms& into) {
    clear(into);
    thread_local std::vector<std::size_t> parts;
    thread_local std::vector<GroundBox> boxes;
    parts.clear();
    boxes.clear();
    for (std::size_t i = 0; i < shadows.size(); ++i)
        if (const auto box = drawn && isDecal(*drawn, shadows[i], shadows.origin)
                                 ? std::nullopt
                                 : boxOver(ground, shadows[i], shadows.origin, margin)) {
            parts.push_back(i);
            boxes.push_back(*box);
        }
    if (boxes.empty()) {
        into.layers.clear();
        return;
    }
    const GroundBox all = boundsOf(boxes);
    Layers layers(all, cellFor(boxes), boxes.size());
    Builder builder(into, glm::dvec3(0.0));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const PackedShadow shadow = shadows[parts[i]];
        const double low = boxes[i].low.z, high = boxes[i].high.z;
        if (shadow.isFan()) {
            builder.add(shadow, low, high, layerAt(into, layers.place(boxes[i])));
            continue;
        }
        Drape drape;
        for (std::size_t k = 0; k < shadow.indexCount; ++k) drape.emplace_back(shadow.corners[shadow.indices[k]]);
        for (const Plan& plan : unfolded(planOf(drape, boxes[i], builder.corners)))
            builder.add(plan, low, high, layerAt(into, layers.place(boxOf(plan.corners))));
    }
    finish(into, layers);
    into.low = all.low;
    into.high = all.high;
}

} // namespace gnomon
