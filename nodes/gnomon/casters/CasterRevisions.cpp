// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterRevisions.h>

#include <OpenThreads/ScopedLock>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr std::size_t mostChoices = 4; // of levels: those of some views, or of a way to and fro
constexpr unsigned keptCalls = 240;    // choices that nobody asked for since are let go
constexpr unsigned pruneEvery = 60;    // calls: levels may leave the graph unseen

const void* keyOf(const CasterView* view) { return view ? view->key : nullptr; }

} // namespace

void CasterRevisions::clear() {
    Lock lock(_mutex);
    _choices.dropIf([](const Choice&) { return true; });
    _levels.clear();
    _bodies.clear();
}

void CasterRevisions::setRule(const CastingRule& rule) {
    Lock lock(_mutex);
    _rule = rule;
}

unsigned CasterRevisions::count() const {
    Lock lock(_mutex);
    return _count;
}

/// The entry of a choice. Whatever it held of another revision is gone.
CasterRevisions::Choice& CasterRevisions::take(std::uint64_t choice, std::uint64_t fingerprint,
                                               const CasterView* view) {
    ++_calls;
    _choices.dropIf([this](const Choice& entry) { return _calls - entry.lastCall > keptCalls; });
    Choice* known = _choices.find([choice](const Choice& entry) { return entry.choice == choice; });
    if (!known || known->fingerprint != fingerprint) ++_count;
    if (!known) {
        _choices.dropOldestBeyond(mostChoices - 1); // before adding, for all would be in memory
        known = &_choices.add({choice, fingerprint, nullptr, 0, {}, {}, nullptr, 0});
    }
    if (known->fingerprint != fingerprint) {
        if (known->layers.get()) known->former = known->layers.get();
        known->layers.set(nullptr);
        known->pieces.set(nullptr);
    }
    if (_calls - known->lastLayersCall > keptCalls) known->former = nullptr;
    known->fingerprint = fingerprint;
    known->view = keyOf(view);
    known->lastCall = _calls;
    if (_calls % pruneEvery == 0) {
        _levels.prune();
        _bodies.prune();
    }
    return *known;
}

osg::ref_ptr<const CasterLayers> CasterRevisions::layers(osg::Node& root, const Selection& casters,
                                                         const CasterView* view) {
    Lock lock(_mutex);
    osg::ref_ptr<const CasterLayers> before = layersKnownTo(view);
    Choice& known = findDrawables(root, casters, view);
    known.lastLayersCall = _calls;
    if (known.layers.get()) return known.layers.get();
    known.layers.set(CasterLayers::of(*known.pieces.get(), before, _bodies));
    before = known.former = nullptr;
    _bodies.prune();
    return known.layers.get();
}

osg::ref_ptr<const CasterLayers> CasterRevisions::layersOf(const CasterDrawables& some, const CasterLayers& before) {
    Lock lock(_mutex);
    return CasterLayers::of(some, &before, _bodies);
}

osg::ref_ptr<const CasterDrawables> CasterRevisions::drawables(osg::Node& root, const Selection& casters,
                                                               const CasterView* view) {
    Lock lock(_mutex);
    return findDrawables(root, casters, view).pieces.get();
}

CasterRevisions::Choice& CasterRevisions::findDrawables(osg::Node& root, const Selection& casters,
                                                        const CasterView* view) {
    const osg::ref_ptr<const CasterDrawables> before = knownTo(view),
                                              now = CasterDrawables::of(root, casters, before, view, &_levels, &_bodies,
                                                                        _rule);
    Choice& known = take(now->choice, now->fingerprint, view);
    if (known.pieces.get()) return known;
    known.pieces.set(now);
    _levels.prune();
    return known;
}

/// The drawables that a view had last, or any that are known.
osg::ref_ptr<const CasterDrawables> CasterRevisions::knownTo(const CasterView* view) const {
    osg::ref_ptr<const CasterDrawables> known;
    for (const Choice& entry : _choices) {
        if (!entry.pieces.get()) continue;
        known = entry.pieces.get();
        if (entry.view == keyOf(view)) break;
    }
    return known;
}

/// The layers that a view had last, or any that are known.
osg::ref_ptr<const CasterLayers> CasterRevisions::layersKnownTo(const CasterView* view) const {
    osg::ref_ptr<const CasterLayers> known;
    bool isOwn = false;
    for (const Choice& entry : _choices) {
        const osg::ref_ptr<const CasterLayers> own = entry.layers.get() ? entry.layers.get() : entry.former;
        if (!own || (isOwn && entry.view != keyOf(view))) continue;
        known = own;
        isOwn = entry.view == keyOf(view);
    }
    return known;
}

} // namespace gnomon
