// SPDX-License-Identifier: MIT
#include <glm/geometric.hpp>
#include <metrics/BoundaryDistance.h>
#include <metrics/CauseSplit.h>
#include <metrics/PixelSets.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::metrics {
namespace {

using glm::dvec3;

/// Area and breadth of one gap.
struct Extent {
    double area = 0.0; ///< m²
    double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// How far the surface goes from one pixel to the next along (dx, dy): towards a neighbour of the same receiver.
dvec3 stepOf(const TruthMaps& truth, int x, int y, int dx, int dy) {
    for (const int sign : {1, -1}) {
        const int nx = x + sign * dx, ny = y + sign * dy;
        if (truth.receiver.holds(nx, ny) && truth.receiver.at(nx, ny) == truth.receiver.at(x, y))
            return static_cast<double>(sign) * (truth.position.at(nx, ny) - truth.position.at(x, y));
    }
    return dvec3(0.0);
}

void addPixel(const TruthMaps& truth, const dvec3& across, int x, int y, Extent& extent) {
    const dvec3 right = stepOf(truth, x, y, 1, 0), upwards = stepOf(truth, x, y, 0, 1);
    const double half = 0.5 * (std::abs(glm::dot(right, across)) + std::abs(glm::dot(upwards, across)));
    const double place = glm::dot(truth.position.at(x, y), across);
    extent.area += std::abs(glm::dot(glm::cross(right, upwards), truth.up));
    extent.low = std::min(extent.low, place - half);
    extent.high = std::max(extent.high, place + half);
}

std::vector<Extent> extentsOf(const Mask& gaps, const TruthMaps& truth, const dvec3& across) {
    const Components parts = components(gaps);
    std::vector<Extent> extents(static_cast<std::size_t>(parts.count));
    for (int y = 0; y < gaps.height; ++y)
        for (int x = 0; x < gaps.width; ++x)
            if (gaps.at(x, y)) addPixel(truth, across, x, y, extents[static_cast<std::size_t>(parts.part.at(x, y))]);
    return extents;
}

using Places = std::vector<std::pair<int, int>>;

void visit(const Mask& mask, int x, int y, Components& result, Places& open) {
    if (!mask.holds(x, y) || !mask.at(x, y) || result.part.at(x, y) >= 0) return;
    result.part.at(x, y) = result.count;
    open.emplace_back(x, y);
}

/// Gives the part of (x, y) the next number.
void fill(const Mask& mask, int x, int y, Components& result) {
    Places open;
    visit(mask, x, y, result, open);
    while (!open.empty()) {
        const auto [cx, cy] = open.back();
        open.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) visit(mask, cx + dx, cy + dy, result, open);
    }
    ++result.count;
}

constexpr double overDark = -0.05, overBright = 1.05;

/// FS, or FL: what is shown shadowed, or lit, and is truly not.
Mask wrongPixels(const Picture& visibility, const TruthMaps& truth, const Mask& certain, bool shownShadowed) {
    Mask wrong(certain.width, certain.height);
    for (std::size_t i = 0; i < wrong.cells.size(); ++i)
        wrong.cells[i] = certain.cells[i] && isShadowed(visibility.cells[i]) == shownShadowed &&
                         static_cast<bool>(truth.litCentre.cells[i]) == shownShadowed;
    return wrong;
}

/// Whether one of 8 neighbours in `within` is truly shadowed in part (or lit in part).
bool touches(const TruthMaps& truth, const Mask& within, int x, int y, bool shadowed) {
    for (int ny = y - 1; ny <= y + 1; ++ny)
        for (int nx = x - 1; nx <= x + 1; ++nx)
            if (within.holds(nx, ny) && within.at(nx, ny) &&
                (shadowed ? truth.lit.at(nx, ny) < 1.0 : truth.lit.at(nx, ny) > 0.0))
                return true;
    return false;
}

/// The connected parts of `wrong` that touch a true boundary.
std::vector<bool> touchingParts(const Components& parts, const TruthMaps& truth, const Mask& within, bool shadowed) {
    std::vector<bool> touching(static_cast<std::size_t>(parts.count), false);
    for (int y = 0; y < within.height; ++y)
        for (int x = 0; x < within.width; ++x) {
            const int part = parts.part.at(x, y);
            if (part >= 0 && touches(truth, within, x, y, shadowed)) touching[static_cast<std::size_t>(part)] = true;
        }
    return touching;
}

/// The pixels of `wrong` that are attached to a true boundary.
Mask attachedPixels(const Mask& wrong, const TruthMaps& truth, const Mask& within, const NearestSegment& boundary,
                    double near, bool shadowed) {
    const Components parts = components(wrong);
    const std::vector<bool> touching = touchingParts(parts, truth, within, shadowed);
    Mask attached(wrong.width, wrong.height);
    for (int y = 0; y < wrong.height; ++y)
        for (int x = 0; x < wrong.width; ++x)
            attached.at(x, y) = wrong.at(x, y) && (touching[static_cast<std::size_t>(parts.part.at(x, y))] ||
                                                   boundary.distance({x + 0.5, y + 0.5}) <= near);
    return attached;
}

/// The pixels of `mask` at their blocker's foot.
Mask atContact(const Mask& mask, const TruthMaps& truth, double contact) {
    Mask result(mask.width, mask.height);
    for (std::size_t i = 0; i < mask.cells.size(); ++i)
        result.cells[i] = mask.cells[i] && !truth.litCentre.cells[i] && truth.blockerDistance.cells[i] < contact;
    return result;
}

std::optional<double> share(std::size_t part, std::size_t whole) {
    return whole ? std::optional(static_cast<double>(part) / static_cast<double>(whole)) : std::nullopt;
}

std::size_t litPixels(const TruthMaps& truth, const Mask& within) {
    std::size_t lit = 0;
    for (std::size_t i = 0; i < within.cells.size(); ++i) lit += within.cells[i] && truth.litCentre.cells[i];
    return lit;
}

void splitFalseShadow(const Mask& wrong, const Mask& attached, CauseSplit& split) {
    split.halo = count(attached);
    split.acne = count(wrong) - split.halo;
}

void splitFalseLit(const Mask& wrong, const Mask& attached, const Mask& contact, CauseSplit& split) {
    for (std::size_t i = 0; i < wrong.cells.size(); ++i)
        if (wrong.cells[i]) ++(contact.cells[i] ? split.peterPanning : attached.cells[i] ? split.erosion : split.leak);
}

void countBeyond(const Picture& visibility, const Mask& within, CauseSplit& split) {
    for (std::size_t i = 0; i < within.cells.size(); ++i) {
        split.overDark += within.cells[i] && visibility.cells[i] < overDark;
        split.overBright += within.cells[i] && visibility.cells[i] > overBright;
    }
}

} // namespace

std::optional<double> contactGap(const Mask& peterPanning, const TruthMaps& truth) {
    const dvec3 sideways = glm::cross(truth.up, truth.towardsLight);
    if (truth.position.empty() || !(glm::length(sideways) > 0.0)) return std::nullopt;
    double area = 0.0, breadth = 0.0;
    for (const Extent& extent : extentsOf(peterPanning, truth, glm::normalize(sideways))) {
        area += extent.area;
        breadth += extent.high - extent.low;
    }
    return breadth > 0.0 ? std::optional(area / breadth) : std::nullopt;
}

Components components(const Mask& mask) {
    Components result{Grid<int>(mask.width, mask.height, -1)};
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            if (mask.at(x, y) && result.part.at(x, y) < 0) fill(mask, x, y, result);
    return result;
}

CauseSplit causeSplit(const Picture& visibility, const TruthMaps& truth, const PixelSets& sets,
                      const CauseLimits& limits) {
    const std::vector<Segment> line = isoLine(truth.lit, 0.5, sets.facing);
    const NearestSegment boundary(line);
    const Mask falseShadow = wrongPixels(visibility, truth, sets.certain, true);
    const Mask falseLit = wrongPixels(visibility, truth, sets.certain, false);
    const Mask contact = atContact(falseLit, truth, limits.contact);
    CauseSplit split;
    splitFalseShadow(falseShadow, attachedPixels(falseShadow, truth, sets.facing, boundary, limits.boundary, true),
                     split);
    splitFalseLit(falseLit, attachedPixels(falseLit, truth, sets.facing, boundary, limits.boundary, false), contact,
                  split);
    countBeyond(visibility, sets.facing, split);
    split.acneShare = share(split.acne, litPixels(truth, sets.certain));
    split.peterPanningShare = share(split.peterPanning, count(atContact(sets.certain, truth, limits.contact)));
    split.gap = contactGap(contact, truth);
    return split;
}

} // namespace gnomon::metrics
