// SPDX-License-Identifier: MIT
#include <gnomon/GroundQuery.h>
#include <gnomon/ShadowPrisms.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
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
    Corners(const GroundBox& box, Plan& plan) : _low(box.low), _step(1e-6 * diameterOf(box)), _plan(plan) {}
    unsigned of(const glm::dvec3& place) {
        const glm::dvec3 steps = glm::floor((place - _low) / _step + 0.5);
        const auto [found, isNew] = _places.try_emplace(
            {std::int64_t(steps.x), std::int64_t(steps.y), std::int64_t(steps.z)}, unsigned(_plan.corners.size()));
        if (isNew) _plan.corners.push_back(place);
        return found->second;
    }

private:
    const glm::dvec3 _low;
    const double _step;
    Plan& _plan;
    std::map<std::array<std::int64_t, 3>, unsigned> _places;
};

struct Planned {
    Plan plan;
    bool folded = false; ///< some triangle was clockwise.
};

Planned planOf(const Drape& shadow, const GroundBox& box) {
    Planned result;
    Plan& plan = result.plan;
    Corners corners(box, plan);
    for (std::size_t i = 0; i + 2 < shadow.size(); i += 3) {
        std::array<unsigned, 3> t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = corners.of(shadow[i + k]);
        const double area = doubleArea(plan.corners[t[0]], plan.corners[t[1]], plan.corners[t[2]]);
        result.folded = result.folded || area < 0.0;
        if (area < 0.0) std::swap(t[1], t[2]);
        if (area != 0.0) plan.triangles.push_back(t);
    }
    return result;
}

/// Numbers of the triangles' connected parts.
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
std::vector<Plan> unfolded(const Planned& planned) {
    const std::vector<unsigned> parts = partsOf(planned.plan);
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

/// How often the outline goes along each edge, more often than back.
using Outline = std::map<std::pair<unsigned, unsigned>, int>;

Outline outlineOf(const Plan& plan) {
    Outline outline;
    for (const auto& t : plan.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto back = outline.find({t[(k + 1) % 3], t[k]});
            if (back != outline.end() && back->second > 0)
                --back->second;
            else
                ++outline[{t[k], t[(k + 1) % 3]}];
        }
    return outline;
}

/// Layers by cells of plan: a prism goes above all that were put into the cells it touches.
class Layers {
public:
    explicit Layers(double cell) : _cell(cell) {}
    std::size_t place(const GroundBox& box) {
        const glm::dvec2 from = glm::floor(glm::dvec2(box.low) / _cell), to = glm::floor(glm::dvec2(box.high) / _cell);
        std::size_t layer = 0;
        each(from, to, [&](std::size_t& above) { layer = std::max(layer, above); });
        each(from, to, [&](std::size_t& above) { above = layer + 1; });
        return layer;
    }

private:
    template <typename Step>
    void each(const glm::dvec2& from, const glm::dvec2& to, const Step& step) {
        for (double y = from.y; y <= to.y; ++y)
            for (double x = from.x; x <= to.x; ++x) step(_above[{std::int64_t(x), std::int64_t(y)}]);
    }
    const double _cell;
    std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> _above;
};

class Builder {
public:
    Builder(ShadowPrisms& prisms, const glm::dvec3& origin) : _prisms(prisms), _origin(origin) {}

    void add(const Plan& plan, double bottom, double top, std::vector<unsigned>& layer) {
        const auto first = static_cast<unsigned>(_prisms.vertices.size());
        for (const glm::dvec3& corner : plan.corners)
            for (const double height : {bottom, top})
                _prisms.vertices.emplace_back(glm::dvec3(corner.x, corner.y, height) - _origin);
        const auto low = [first](unsigned corner) { return first + 2 * corner; };
        const auto high = [first](unsigned corner) { return first + 2 * corner + 1; };
        for (const auto& [a, b, c] : plan.triangles)
            layer.insert(layer.end(), {high(a), high(b), high(c), low(a), low(c), low(b)});
        for (const auto& [edge, times] : outlineOf(plan))
            for (int i = 0; i < times; ++i)
                layer.insert(layer.end(), {low(edge.first), low(edge.second), high(edge.second), low(edge.first),
                                           high(edge.second), high(edge.first)});
    }

private:
    ShadowPrisms& _prisms;
    const glm::dvec3 _origin;
};

/// So that a prism touches few cells, and few others touch the same.
double cellFor(const std::vector<GroundBox>& boxes) {
    std::vector<double> sizes;
    for (const GroundBox& box : boxes) sizes.push_back(diameterOf(box));
    std::nth_element(sizes.begin(), sizes.begin() + std::ptrdiff_t(sizes.size() / 2), sizes.end());
    return std::max(sizes[sizes.size() / 2], 1e-3 * *std::max_element(sizes.begin(), sizes.end()));
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
    Layers layers(cellFor(boxes));
    Builder builder(prisms, origin);
    GroundBox all = boxes.front();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double margin = 0.5 * diameterOf(boxes[i]);
        boxes[i].low.z -= margin;
        boxes[i].high.z += margin;
        for (const Plan& plan : unfolded(planOf(*there[i], boxes[i]))) {
            const std::size_t layer = layers.place(boxOf(plan.corners));
            if (prisms.layers.size() <= layer) prisms.layers.resize(layer + 1);
            builder.add(plan, boxes[i].low.z, boxes[i].high.z, prisms.layers[layer]);
        }
        all = {glm::min(all.low, boxes[i].low), glm::max(all.high, boxes[i].high)};
    }
    prisms.low = all.low - origin;
    prisms.high = all.high - origin;
    return prisms;
}

ShadowPrisms shadowPrisms(const PackedShadows& shadows) {
    std::vector<Drape> drapes;
    for (std::size_t i = 0; i < shadows.size(); ++i) drapes.push_back(shadows.triangles(i));
    return shadowPrisms(drapes, shadows.origin);
}

} // namespace gnomon
