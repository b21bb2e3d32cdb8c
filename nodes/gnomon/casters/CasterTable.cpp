// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/CasterTable.h>

#include <OpenThreads/ScopedLock>

#include <memory>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr std::size_t mostChoices = 4; // of levels: those of some views, or of a way to and fro
constexpr unsigned pruneEvery = 60;    // calls: levels may leave the graph unseen

const void* keyOf(const CasterView* view) { return view ? view->key : nullptr; }

} // namespace

/// Casters of no group, or of one that is gone, have a table for themselves.
const CasterLayers& Casters::madeLayers() const {
    osg::ref_ptr<CasterTable> table;
    if (!_table.lock(table)) table = new CasterTable;
    table->makeLayers(*this);
    return *_layers;
}

void CasterTable::clear() {
    Lock lock(_mutex);
    _choices.dropIf([](const Choice&) { return true; });
    _known.clear();
}

void CasterTable::setRule(const CastingRule& rule) {
    Lock lock(_mutex);
    _rule = rule;
}

unsigned CasterTable::count() const {
    Lock lock(_mutex);
    return _count;
}

osg::ref_ptr<const Casters> CasterTable::casters(osg::Node& root, const Selection& casters, const CasterView* view) {
    Lock lock(_mutex);
    _culls = 0;
    const osg::ref_ptr<const Casters> before = knownTo(view),
                                      now = Casters::of(root, casters, before, view, &_known, _rule);
    if (now != before) now->_table = this;
    Choice& entry = take(*now, view);
    if (entry.casters.get()) return entry.casters.get();
    entry.casters.set(now);
    if (now->empty()) make(*now); // nobody else might, and the former ones' layers are kept until then
    _known.pruneLevels();
    return now;
}

/// The entry of a choice. Whatever it held of another revision is gone, but for what its layers are made from.
CasterTable::Choice& CasterTable::take(const Casters& now, const CasterView* view) {
    ++_calls;
    _choices.dropIf([this](const Choice& entry) { return _calls - entry.lastCall > keptCalls; });
    Choice* known = _choices.find([&](const Choice& entry) { return entry.choice == now.choice; });
    const bool isSame = known && known->casters.get()->fingerprint == now.fingerprint;
    if (!isSame) ++_count;
    if (!known) {
        _choices.dropOldestBeyond(mostChoices - 1); // before adding, for all would be in memory
        known = &_choices.add({now.choice});
    } else if (!isSame) {
        if (known->casters.get()->hasLayers()) {
            known->former = known->casters.get();
            known->formerSince = _calls;
        }
        known->casters.set(nullptr);
    }
    if (_calls - known->formerSince > keptCalls) known->former = nullptr;
    known->view = keyOf(view);
    known->lastCall = _calls;
    if (_calls % pruneEvery == 0) {
        _known.pruneLevels();
        _known.pruneBodies();
    }
    return *known;
}

void CasterTable::makeLayers(const Casters& casters) {
    Lock lock(_mutex);
    if (!casters.hasLayers()) make(casters);
}

void CasterTable::make(const Casters& casters) {
    Choice* entry = _choices.find([&](const Choice& known) { return known.casters.get() == &casters; });
    osg::ref_ptr<const Casters> from = layersKnownTo(entry ? entry->view : nullptr);
    casters._layers = std::make_shared<const CasterLayers>(casters, from ? &from->layers() : nullptr, _known);
    casters._hasLayers = true;
    if (entry) entry->former = nullptr;
    from = nullptr;
    _known.pruneBodies();
}

/// Those that a view had last, or any that are known.
osg::ref_ptr<const Casters> CasterTable::knownTo(const CasterView* view) const {
    osg::ref_ptr<const Casters> known;
    for (const Choice& entry : _choices) {
        known = entry.casters.get();
        if (entry.view == keyOf(view)) break;
    }
    return known;
}

/// Those with layers that a view had last, or any that are known.
osg::ref_ptr<const Casters> CasterTable::layersKnownTo(const void* view) const {
    osg::ref_ptr<const Casters> known;
    bool isOfView = false;
    for (const Choice& entry : _choices) {
        const bool hasLayers = entry.casters.get()->hasLayers();
        const osg::ref_ptr<const Casters>& withLayers = hasLayers ? entry.casters.get() : entry.former;
        if (!withLayers || (isOfView && entry.view != view)) continue;
        known = withLayers;
        isOfView = entry.view == view;
    }
    return known;
}

} // namespace gnomon
