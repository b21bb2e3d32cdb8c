// SPDX-License-Identifier: MIT
#include <metrics/CauseSplit.h>
#include <metrics/Components.h>
#include <metrics/Confusion.h>
#include <metrics/ContactGap.h>
#include <metrics/NearestSegment.h>

namespace gnomon::metrics {
namespace {

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
