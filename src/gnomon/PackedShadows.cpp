// SPDX-License-Identifier: MIT
#include <gnomon/PackedShadows.h>
#include <gnomon/TerrainSteps.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr double reach = 0.25;        // of a part's height: how far its shadow is followed before it is found again
constexpr std::size_t together = 256; // what is found of so many parts stays in the nearest cache

glm::vec3 rounded(const PackedShadows& found, const glm::dvec3& anchor, const glm::dvec3& corner) {
    return glm::vec3(anchor + corner - found.origin);
}

/// Room for more, at the end. @return the first of them.
template <class Kept>
Kept* room(std::vector<Kept>& kept, std::size_t count) {
    if (kept.capacity() < kept.size() + count) kept.reserve(2 * (kept.size() + count));
    kept.resize(kept.size() + count);
    return kept.data() + kept.size() - count;
}

struct PlanBox {
    glm::dvec2 low{infinite}, high{-infinite};
    void take(const glm::dvec2& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    void take(const PlanBox& box) {
        low = glm::min(low, box.low);
        high = glm::max(high, box.high);
    }
    bool holds(const PlanBox& box) const {
        return glm::all(glm::lessThanEqual(low, box.low)) && glm::all(glm::greaterThanEqual(high, box.high));
    }
};

/// A part over its shadow.
struct Over {
    double height = 0.0; ///< at most, of a point of the part over that of its shadow.
    PlanBox
        plan; ///< of the part, unless all of it is over what of it stands in the ground: then it is in its shadow's.
};

/// Of one that has a shadow.
Over overOf(const PackedParts& parts, std::size_t part, const PackedShadows& found) {
    const PackedShadow shadow = found[part];
    double lowest = infinite, high = -infinite;
    for (std::size_t k = 0; k < shadow.cornerCount; ++k) lowest = std::min(lowest, double(shadow.corners[k].z));
    lowest += found.origin.z;
    PlanBox plan, standing;
    const auto take = [&](const glm::dvec3& corner) {
        high = std::max(high, corner.z);
        plan.take(glm::dvec2(corner));
        if (corner.z <= lowest) standing.take(glm::dvec2(corner));
    };
    take(parts.anchor(part));
    for (unsigned k = 0; k + 1 < parts.topology(part).corners; ++k)
        take(parts.anchor(part) + glm::dvec3(parts.others(part)[k]));
    return {high - lowest, standing.holds(plan) ? PlanBox() : plan};
}

void addFan(PackedShadows& found, const FanBatch& batch, std::size_t i) {
    const FanBatch::Entry& entry = batch.entry(i);
    glm::vec3* to = room(found.corners, entry.corners);
    const KernelEdge* edges = batch.edges(entry);
    for (std::size_t k = 0; k < entry.corners; ++k) {
        const glm::dvec3 corner(edges[k].endX[entry.lane], edges[k].endY[entry.lane], edges[k].endZ[entry.lane]);
        to[k] = rounded(found, entry.anchor, corner);
    }
}

void addDrape(PackedShadows& found, const glm::dvec3& anchor, const DrapeMesh& drape) {
    glm::vec3* to = room(found.corners, drape.corners.size());
    for (const glm::dvec3& corner : drape.corners) *to++ = rounded(found, anchor, corner);
    std::copy(drape.indices.begin(), drape.indices.end(), room(found.indices, drape.indices.size()));
}

void addEnds(PackedShadows& found, TerrainOutcome outcome) {
    found.cornerEnds.push_back(unsigned(found.corners.size()));
    found.indexEnds.push_back(unsigned(found.indices.size()));
    found.outcomes.push_back(outcome);
}

void clear(PackedShadows& found) {
    found.corners.clear();
    found.indices.clear();
    found.cornerEnds.clear();
    found.indexEnds.clear();
    found.outcomes.clear();
    found.rates = {};
    found.steepest = 0.0;
}

/// About shadows and the way of their rays, in the ground's frame, with what they may move by before they are found again.
PlanBox reachOf(const PackedShadows& shadows, const glm::vec3* first, const glm::vec3* end, const Over& over) {
    PlanBox box;
    for (; first != end; ++first) box.take(glm::dvec2(glm::vec2(*first)));
    const glm::dvec2 origin(shadows.origin), margin(reach * over.height);
    box = {origin + box.low, origin + box.high};
    box.take(over.plan);
    return {box.low - margin, box.high + margin};
}

/// The light's way in plan.
struct Way {
    explicit Way(const glm::dvec2& of) : way(of), length(glm::length(of)), along(length > 0.0 ? of / length : axis()) {}
    double ofAlong(const glm::dvec2& v) const { return glm::dot(v, along); }
    double ofAcross(const glm::dvec2& v) const { return along.x * v.y - along.y * v.x; }

    glm::dvec2 way; ///< a unit of height.
    double length;
    glm::dvec2 along;

private:
    static glm::dvec2 axis() { return {1.0, 0.0}; } // under a sun overhead one is as good as another
};

/// Of the ground in some place.
struct Slopes {
    double steepest = 0.0;
    double along = 0.0, across = 0.0; ///< see ShadowMotion; infinite where some of it is as steep as the light.
    void take(const glm::dvec2& gradient, const Way& way) {
        const double left = 1.0 - glm::dot(gradient, way.way);
        steepest = std::max(steepest, glm::length(gradient));
        along = std::max(along, left > 0.0 ? std::abs(way.ofAlong(gradient)) / left : infinite);
        across = std::max(across, left > 0.0 ? std::abs(way.ofAcross(gradient)) / left : infinite);
    }
    double grazing() const { return glm::length(glm::dvec2(along, across)); }
};

constexpr Slopes unknown{infinite, infinite, infinite};

Slopes slopesIn(const Ground& ground, const PlanBox& box, const Way& way) {
    const auto range = ground.range(box.low, box.high);
    if (!range) return unknown;
    if (range->holes) return {range->steepest, infinite, infinite};
    const double left = 1.0 - range->steepest * way.length, grazing = left > 0.0 ? range->steepest / left : infinite;
    return {range->steepest, grazing, grazing};
}

/// Which of a cell's triangles a box touches that touches the cell. @param box  in cells, from the cell's own corner.
struct Touched {
    Touched(const PlanBox& box, bool falls)
        : right(falls ? box.high.x + box.high.y >= 1.0 : box.high.x >= box.low.y),
          left(falls ? box.low.x + box.low.y <= 1.0 : box.low.x <= box.high.y) {}
    bool right, left; ///< the one that has all of its right side, of its left side.
};

/// By each triangle's own gradient, which tells slopes that face the light from those that turn away.
/// @param box  in cells.
Slopes slopesIn(const HeightField& field, const HeightPyramid::Cells& cells, const PlanBox& box, const Way& way) {
    Slopes slopes;
    const auto take = [&](double x, double y) { slopes.take(glm::dvec2(x, y) / field.step(), way); };
    for (int y = cells.low; y <= cells.high; ++y)
        for (int x = cells.left; x <= cells.right; ++x) {
            if (field.isHole(x, y)) return unknown;
            const double a = field.post(x, y).z, b = field.post(x + 1, y).z, c = field.post(x + 1, y + 1).z,
                         d = field.post(x, y + 1).z;
            const bool falls = field.cut(x, y) == CellCut::falling;
            const glm::dvec2 corner(x, y);
            const Touched touched({box.low - corner, box.high - corner}, falls);
            if (touched.left) take(falls ? b - a : c - d, d - a);
            if (touched.right) take(falls ? c - d : b - a, c - b);
        }
    return slopes;
}

Slopes slopesIn(const HeightPyramid& grid, const PlanBox& box, const Way& way) {
    constexpr int mostCells = 256; // of a tower on a mountain
    const HeightField& field = grid.field();
    const PlanBox inCells{field.cellOf(box.low.x, box.low.y), field.cellOf(box.high.x, box.high.y)};
    const auto cells = grid.cells(inCells.low, inCells.high);
    const bool isFew = cells && (cells->right - cells->left + 1) * (cells->high - cells->low + 1) <= mostCells;
    if (isFew) return slopesIn(field, *cells, inCells, way);
    return slopesIn(static_cast<const Ground&>(grid), box, way);
}

/// How far it moves at most, a unit that the light's way turns by, for turns up to `turned` whichever way.
double rateOf(const ShadowMotion& motion, double way, double turned) {
    const double grazing = glm::length(glm::dvec2(motion.along, motion.across)), left = 1.0 - turned * grazing;
    const double rate = 1.0 + (way + turned) * grazing / left;
    return left > 0.0 && turned * rate <= reach ? motion.height * rate : infinite;
}

/// Of parts that have no shadow, but may have one as soon as the light turns: where and how large it is not known.
bool mayAppear(TerrainOutcome outcome) {
    return outcome == TerrainOutcome::edgeOn || outcome == TerrainOutcome::noGround;
}

/// All together. @param each  is told that of each part with its place.
template <class Each>
Over highestOf(const PackedParts& parts, const PackedShadows& found, const Each& each) {
    Over highest;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].cornerCount == 0) continue;
        const Over over = overOf(parts, i, found);
        highest.height = std::max(highest.height, over.height);
        highest.plan.take(over.plan);
        each(i, over);
    }
    return highest;
}

Slopes slopesUnderAll(const Ground& ground, const PackedShadows& found, const Over& highest, const Way& way) {
    if (found.corners.empty()) return {};
    const glm::vec3* corners = found.corners.data();
    return slopesIn(ground, reachOf(found, corners, corners + found.corners.size(), highest), way);
}

/// By the ground under all together.
void findRates(const Ground& ground, const PackedParts& parts, const glm::dvec4& light, PackedShadows& found) {
    if (light.w != 0.0) return;
    const Way way(wayOf(light));
    const Over highest = highestOf(parts, found, [](std::size_t, const Over&) {});
    const bool mayOneAppear = std::any_of(found.outcomes.begin(), found.outcomes.end(), mayAppear);
    const Slopes slopes = slopesUnderAll(ground, found, highest, way);
    found.steepest = slopes.steepest;
    found.rates.take({mayOneAppear ? infinite : highest.height, slopes.along, slopes.across}, way.length);
}

} // namespace

void ShadowRates::take(const ShadowMotion& motion, double way) {
    for (std::size_t i = 0; i < _rates.size(); ++i) _rates[i] = std::max(_rates[i], rateOf(motion, way, turns[i]));
}

double ShadowRates::movedAtMost(double turned) const {
    for (std::size_t i = 0; i < _rates.size(); ++i)
        if (turned <= turns[i]) return turned > 0.0 ? turned * _rates[i] : 0.0;
    return infinite;
}

glm::dvec2 wayOf(const glm::dvec4& sun) { return glm::dvec2(sun) / sun.z; }

PackedShadow PackedShadows::operator[](std::size_t part) const {
    const unsigned corner = part > 0 ? cornerEnds[part - 1] : 0u, index = part > 0 ? indexEnds[part - 1] : 0u;
    return {corners.data() + corner, cornerEnds[part] - corner, indices.data() + index, indexEnds[part] - index,
            outcomes[part]};
}

Drape PackedShadows::triangles(std::size_t part) const {
    const PackedShadow shadow = (*this)[part];
    const auto at = [&](std::size_t corner) { return origin + glm::dvec3(shadow.corners[corner]); };
    Drape result;
    for (std::size_t i = 0; i < shadow.indexCount; ++i) result.push_back(at(shadow.indices[i]));
    for (std::size_t i = 2; i < shadow.cornerCount && shadow.isFan(); ++i)
        result.insert(result.end(), {at(0), at(i - 1), at(i)});
    return result;
}

std::size_t PackedShadows::triangleCount() const {
    std::size_t count = indices.size() / 3;
    for (std::size_t i = 0; i < size(); ++i)
        if ((*this)[i].isFan()) count += (*this)[i].cornerCount - 2;
    return count;
}

std::size_t PackedShadows::bytes() const {
    return corners.size() * sizeof(glm::vec3) +
           (indices.size() + cornerEnds.size() + indexEnds.size()) * sizeof(unsigned) +
           outcomes.size() * sizeof(TerrainOutcome);
}

void packedShadows(const Ground& ground, const PackedParts& parts, const glm::dvec4& light, TerrainMethod method,
                   double error, const glm::dvec3& origin, PackedShadows& found) {
    found.origin = origin;
    clear(found);
    if (isLightBelow(ground, light)) {
        for (std::size_t i = 0; i < parts.size(); ++i) addEnds(found, TerrainOutcome::lightBelow);
        return;
    }
    const TerrainAsk asked{ground, light, method, error};
    FanBatch& batch = threadsBatch();
    batch.begin(ground, light);
    for (std::size_t first = 0; first < parts.size(); first += together) {
        findTogether(batch, asked, parts, first, std::min(first + together, parts.size()));
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const Settled one = settled(batch, i, asked, parts, first + i);
            if (one.outcome == TerrainOutcome::fan) addFan(found, batch, i);
            if (one.drape) addDrape(found, batch.entry(i).anchor, *one.drape);
            addEnds(found, one.outcome);
        }
    }
    findRates(ground, parts, light, found);
}

/// By the ground under all together; where that tells too little, by what is under each.
void findMotions(const Ground& ground, const PackedParts& parts, const PackedShadows& found, const glm::dvec4& sun,
                 std::vector<ShadowMotion>& motions) {
    constexpr double enough = 0.25; // more than what shadows move by on level ground
    const Way way(wayOf(sun));
    thread_local std::vector<Over> overs; // memory that is used again
    overs.assign(found.size(), {});
    const Over highest = highestOf(parts, found, [&](std::size_t i, const Over& over) { overs[i] = over; });
    const Slopes all = slopesUnderAll(ground, found, highest, way);
    const auto* grid = dynamic_cast<const HeightPyramid*>(&ground);
    const bool isEnough = all.grazing() * way.length <= enough;
    const auto under = [&](const PlanBox& box) {
        return grid ? slopesIn(*grid, box, way) : slopesIn(ground, box, way);
    };
    motions.assign(found.size(), {});
    for (std::size_t i = 0; i < found.size(); ++i) {
        const PackedShadow shadow = found[i];
        if (mayAppear(shadow.outcome)) motions[i].height = infinite;
        if (shadow.cornerCount == 0) continue;
        const Over& over = overs[i];
        const auto box = [&] { return reachOf(found, shadow.corners, shadow.corners + shadow.cornerCount, over); };
        const Slopes slopes = isEnough ? all : under(box());
        motions[i] = {over.height, slopes.along, slopes.across};
    }
}

/// The ground's rise along d is at most |G| |d - d'| more than along d'.
double movedAtMost(const PackedShadows& shadows, const glm::dvec4& then, const glm::dvec4& now) {
    if (then == now) return 0.0;
    if (then.w != 0.0 || now.w != 0.0 || !(then.z > 0.0) || !(now.z > 0.0)) return infinite;
    return shadows.rates.movedAtMost(glm::length(wayOf(now) - wayOf(then)));
}

SunTurn::SunTurn(const glm::dvec2& then, const glm::dvec2& now) : turned(glm::length(now - then)) {
    const Way of(then);
    way = of.length;
    along = std::abs(of.ofAlong(now - then));
    across = std::abs(of.ofAcross(now - then));
}

double movedAtMost(const ShadowMotion& motion, const SunTurn& turn) {
    if (!(turn.turned > 0.0)) return 0.0;
    const double left = 1.0 - turn.turned * glm::length(glm::dvec2(motion.along, motion.across));
    if (!(left > 0.0)) return infinite;
    const double rise =
        (motion.along * turn.along + motion.across * turn.across) / left; // of the ground, a unit of height
    const double moved = glm::length(glm::dvec2(turn.along + rise * turn.way, turn.across)) + rise * turn.turned;
    return moved <= reach ? motion.height * moved : infinite;
}

} // namespace gnomon
