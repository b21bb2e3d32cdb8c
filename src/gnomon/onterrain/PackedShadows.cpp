// SPDX-License-Identifier: MIT
#include <gnomon/geometry/ReusedBuffer.h>
#include <gnomon/onterrain/PackedShadows.h>
#include <gnomon/onterrain/PartShadow.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

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
};

/// A part over its shadow, or several.
struct Over {
    double height = 0.0; ///< at most, of a point of a part over that of its shadow.
    PlanBox plan;        ///< of the parts.
};

/// Of one that has a shadow, see Over. In single precision as corners are kept: all are looked at whenever the sun moves.
double heightOver(const PackedParts& parts, std::size_t part, const PackedShadows& found) {
    const PackedShadow shadow = found[part];
    float lowest = shadow.corners[0].z; // about the shadows' origin
    float top = 0.0f;                   // about the anchor, which is a corner, too
    for (std::size_t k = 1; k < shadow.cornerCount; ++k) lowest = std::min(lowest, shadow.corners[k].z);
    const glm::vec3* others = parts.others(part);
    for (unsigned k = 0; k + 1 < parts.topology(part).corners; ++k) top = std::max(top, others[k].z);
    return parts.anchor(part).z + top - (found.origin.z + lowest);
}

PlanBox planOf(const PackedParts& parts, std::size_t part) {
    PlanBox plan;
    const glm::dvec2 anchor(parts.anchor(part));
    plan.take(anchor);
    for (unsigned k = 0; k + 1 < parts.topology(part).corners; ++k)
        plan.take(anchor + glm::dvec2(glm::vec2(parts.others(part)[k])));
    return plan;
}

/// Of all that have a shadow; the plan may be larger than theirs.
Over overAll(const PackedParts& parts, const PackedShadows& found) {
    Over all;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].cornerCount == 0) continue;
        all.height = std::max(all.height, heightOver(parts, i, found));
        all.plan.take(glm::dvec2(parts.anchor(i)));
    }
    all.plan.low += glm::dvec2(glm::vec2(parts.low()));
    all.plan.high += glm::dvec2(glm::vec2(parts.high()));
    return all;
}

/// Writes shadows in memory that is there from before.
class Writer {
public:
    Writer(PackedShadows& found, std::size_t parts) : _found(found) {
        found.cornerEnds.resize(parts);
        found.indexEnds.resize(parts);
        found.outcomes.resize(parts);
    }

    void addFan(const FanBatch& batch, std::size_t i) {
        const FanBatch::Entry& entry = batch.entry(i);
        const std::size_t first = grow(_found.corners, _corners, entry.corners);
        glm::vec3* to = _found.corners.data() + first;
        const KernelEdge* edges = batch.edges(entry);
        for (std::size_t k = 0; k < entry.corners; ++k) {
            const glm::dvec3 corner(edges[k].endX[entry.lane], edges[k].endY[entry.lane], edges[k].endZ[entry.lane]);
            to[k] = rounded(_found, entry.anchor, corner);
        }
    }
    void addDrape(const glm::dvec3& anchor, const DrapeMesh& drape) {
        std::size_t to = grow(_found.corners, _corners, drape.corners.size());
        for (const glm::dvec3& corner : drape.corners) _found.corners[to++] = rounded(_found, anchor, corner);
        const std::size_t first = grow(_found.indices, _indices, drape.indices.size());
        std::copy(drape.indices.begin(), drape.indices.end(), _found.indices.begin() + std::ptrdiff_t(first));
    }
    /// Of the next part, what was added since the last one.
    void end(TerrainOutcome outcome) {
        _found.cornerEnds[_parts] = unsigned(_corners);
        _found.indexEnds[_parts] = unsigned(_indices);
        _found.outcomes[_parts++] = outcome;
    }

    /// After the last part: lets go of what is there from before.
    void finish() {
        _found.corners.resize(_corners);
        _found.indices.resize(_indices);
    }

private:
    PackedShadows& _found;
    std::size_t _parts = 0, _corners = 0, _indices = 0; ///< that are written.
};

/// About shadows and the way of their rays, in the ground's frame, with what they may move by before they are found again.
PlanBox reachOf(const PackedShadows& shadows, const glm::vec3* first, const glm::vec3* end, const Over& over) {
    glm::vec2 low(infinite), high(-infinite);
    for (; first != end; ++first) {
        low = glm::min(low, glm::vec2(*first));
        high = glm::max(high, glm::vec2(*first));
    }
    const glm::dvec2 origin(shadows.origin), margin(reach * over.height);
    PlanBox box{origin + glm::dvec2(low), origin + glm::dvec2(high)};
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

Slopes slopesUnderAll(const Ground& ground, const PackedShadows& found, const Over& highest, const Way& way) {
    if (found.corners.empty()) return {};
    const glm::vec3* corners = found.corners.data();
    return slopesIn(ground, reachOf(found, corners, corners + found.corners.size(), highest), way);
}

/// By the ground under all together.
void findRates(const Ground& ground, const PackedParts& parts, const glm::dvec4& light, PackedShadows& found) {
    if (light.w != 0.0) return;
    const Way way(wayOf(light));
    const Over highest = overAll(parts, found);
    const bool mayOneAppear = std::any_of(found.outcomes.begin(), found.outcomes.end(), mayAppear);
    const Slopes slopes = slopesUnderAll(ground, found, highest, way);
    found.steepest = slopes.steepest;
    found.rates.take({mayOneAppear ? infinite : highest.height, slopes.along, slopes.across}, way.length);
}

/// @return false if the light is below the ground: then there are none.
bool findAll(const TerrainRequest& request, const PackedParts& parts, PackedShadows& found) {
    Writer writer(found, parts.size());
    if (isLightBelow(request.ground, request.light)) {
        for (std::size_t i = 0; i < parts.size(); ++i) writer.end(TerrainOutcome::lightBelow);
        writer.finish();
        return false;
    }
    FanBatch& batch = threadsBatch();
    batch.begin(request.ground, request.light, request.kernel);
    for (std::size_t first = 0; first < parts.size(); first += together) {
        findTogether(batch, request, parts, first, std::min(first + together, parts.size()));
        for (std::size_t i = 0; i < batch.size(); ++i) {
            const PartShadow one = partShadow(batch, i, request, parts, first + i);
            if (one.outcome == TerrainOutcome::fan) writer.addFan(batch, i);
            if (one.drape) writer.addDrape(batch.entry(i).anchor, *one.drape);
            writer.end(one.outcome);
        }
    }
    writer.finish();
    return true;
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
                   double error, const glm::dvec3& origin, PackedShadows& found, const ShadowKernel* kernel) {
    found.origin = origin;
    found.rates = {};
    found.steepest = 0.0;
    if (findAll({ground, light, method, error, kernel ? *kernel : bestShadowKernel()}, parts, found))
        findRates(ground, parts, light, found);
}

/// By the ground under all together; where that tells too little, by what is under each.
void findMotions(const Ground& ground, const PackedParts& parts, const PackedShadows& found, const glm::dvec4& sun,
                 std::vector<ShadowMotion>& motions) {
    constexpr double enough = 0.25; // more than what shadows move by on level ground
    const Way way(wayOf(sun));
    const Slopes all = slopesUnderAll(ground, found, overAll(parts, found), way);
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
        const double height = heightOver(parts, i, found);
        const auto box = [&] {
            return reachOf(found, shadow.corners, shadow.corners + shadow.cornerCount, {height, planOf(parts, i)});
        };
        const Slopes slopes = isEnough ? all : under(box());
        motions[i] = {height, slopes.along, slopes.across};
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
