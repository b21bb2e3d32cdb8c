// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ViewFrame.h>
#include <gnomon/base/RecentCache.h>

#include <memory>

namespace gnomon {

/// What a technique keeps for each light in each view. What nobody has asked for in the last 60 rounds is let go, however
/// much there is. A round is a frame. A light that is asked for twice begins a round as well, for views may count no frames.
///
/// Cost
/// - A look at every entry: for few entries.
/// Threads
/// - One at a time. The owner locks.
template <class T>
class PerView {
public:
    struct Entry {
        ViewKey view;
        int light;              ///< number.
        unsigned lastRound = 0; ///< that asked for it.
        T value{};
    };
    static constexpr unsigned keptRounds = 60;

    /// That of a light in a view; a new one at first. Others stay in their places in memory, or are let go.
    T& of(const ViewKey& view, int light, unsigned frame) {
        auto* known = _entries.find([&](const auto& each) { return each->view == view && each->light == light; });
        Entry& entry = known ? **known : *_entries.add(std::unique_ptr<Entry>(new Entry{view, light}));
        if (frame != _frame || entry.lastRound == _round) {
            _frame = frame;
            ++_round;
        }
        entry.lastRound = _round;
        _entries.dropWhile([this](const auto& old) { return _round - old->lastRound > keptRounds; });
        return entry.value;
    }

    /// Drops the values that `isOld` accepts.
    template <class Test>
    void dropIf(const Test& isOld) {
        _entries.dropIf([&](const auto& entry) { return isOld(entry->value); });
    }

    /// The current round. It never goes back.
    unsigned round() const { return _round; }
    /// Pointers to the entries, in the order in which they were asked for last.
    auto begin() const { return _entries.begin(); }
    auto end() const { return _entries.end(); }

private:
    RecentCache<std::unique_ptr<Entry>> _entries;
    unsigned _round = 1, _frame = 0;
};

} // namespace gnomon
