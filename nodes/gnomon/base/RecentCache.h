// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon {

/// Results that are dear to make, in the order of their use: the most recently used one stands last.
///
/// Ask find() first. Make what it does not find, and add() it. The drop functions bound how many are kept.
/// Pointers and references to entries hold until the next call.
///
/// Cost
/// - A look at every entry: for few entries.
/// Threads
/// - One at a time. The owner locks.
template <class Entry>
class RecentCache {
public:
    /// The entry that `isWanted` accepts. It becomes the most recently used one. Null if there is none.
    template <class Test>
    Entry* find(const Test& isWanted) {
        const auto found = std::find_if(_entries.begin(), _entries.end(), isWanted);
        if (found == _entries.end()) return nullptr;
        std::rotate(found, found + 1, _entries.end());
        return &_entries.back();
    }

    /// Adds an entry as the most recently used one.
    Entry& add(Entry entry) {
        _entries.push_back(std::move(entry));
        return _entries.back();
    }

    /// Drops the least recently used entry if there are more than `most`.
    void dropOldestBeyond(std::size_t most) {
        if (_entries.size() > most) _entries.erase(_entries.begin());
    }

    /// Drops the least recently used entries as long as `isOld` accepts them.
    template <class Test>
    void dropWhile(const Test& isOld) {
        _entries.erase(_entries.begin(), std::find_if_not(_entries.begin(), _entries.end(), isOld));
    }

    /// Drops all entries that `isOld` accepts.
    template <class Test>
    void dropIf(const Test& isOld) {
        _entries.erase(std::remove_if(_entries.begin(), _entries.end(), isOld), _entries.end());
    }

    /// The least recently used entry.
    auto begin() const { return _entries.begin(); }
    /// Past the most recently used entry.
    auto end() const { return _entries.end(); }

private:
    std::vector<Entry> _entries;
};

} // namespace gnomon
