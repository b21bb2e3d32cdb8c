// SPDX-License-Identifier: MIT
#include <gnomon/auto/CasterSplit.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/CasterBodies.h>

#include <utility>

namespace gnomon {
namespace {

constexpr std::size_t mostSplits = 4; // as CasterRevisions has choices
constexpr unsigned keptCalls = 8;     // of retired casters: other views may be about to follow
constexpr double large = 0.5;         // of the radius of all: so large a part is not told from the whole

bool isForMap(const CasterDrawable& piece, double radius) {
    return CasterSplit::isDense(piece, radius) || piece.cutOut;
}

} // namespace

bool CasterSplit::isDense(const CasterDrawable& piece, double radius) {
    return piece.triangles >= CasterBodies::fewestTriangles && piece.bounds.radius() < large * radius;
}

void CasterSplit::follow(const CasterDrawables& all) {
    if (isOf(all)) return;
    _all = &all;
    CasterDrawables::List simple, dense;
    for (const auto& piece : all.list) {
        if (!piece->bounds.valid()) continue;
        (isForMap(*piece, all.bounds.radius()) ? dense : simple).push_back(piece);
    }
    set(_simple, std::move(simple), {}, all.choice);
    set(_dense, std::move(dense), all.own, all.choice);
}

/// What is the same stays, and with it all that was made of it.
void CasterSplit::set(Part& part, CasterDrawables::List pieces, CasterDrawables::OwnList own, std::uint64_t choice) {
    if (pieces.empty() && own.empty()) {
        part.pieces.set(nullptr);
        part.layers.set(nullptr);
        return;
    }
    const osg::ref_ptr<const CasterDrawables> before = part.pieces.get();
    if (before && before->list == pieces && before->own == own) return;
    Fingerprint fingerprint;
    for (const auto& piece : pieces) fingerprint.mix(piece->fingerprint);
    for (const auto& drawing : own) fingerprint.mix(static_cast<const void*>(drawing.get()));
    part.pieces.set(new CasterDrawables(std::move(pieces), fingerprint.value(), choice, std::move(own)));
}

FrameCasters CasterSplit::partOf(const FrameCasters& all, const Part& part) {
    const osg::ref_ptr<const CasterLayers> known = part.layers.get();
    if (!known || known->pieces != part.pieces.get())
        part.layers.set(all.group().castersAmong(*part.pieces.get(), known ? *known : all.layers()));
    return all.part(*part.layers.get());
}

void CasterSplits::forgetOthersThan(const CasterDrawables& all) {
    _splits.dropIf([&](const Entry& entry) { return entry.choice == all.choice && !entry.split->isOf(all); });
}

CasterSplit& CasterSplits::of(const CasterDrawables& all) {
    Entry* known = _splits.find([&](const Entry& entry) { return entry.choice == all.choice; });
    if (!known) {
        _splits.dropOldestBeyond(mostSplits - 1);
        known = &_splits.add({all.choice, std::make_unique<CasterSplit>()});
    }
    known->lastCall = ++_calls;
    CasterSplit& split = *known->split;
    split.follow(all);
    _splits.dropIf(
        [this](const Entry& entry) { return entry.split->isRetired() && _calls - entry.lastCall > keptCalls; });
    return split;
}

} // namespace gnomon
