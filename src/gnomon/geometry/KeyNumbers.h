// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <vector>

namespace gnomon {

/// KeyNumbers for keys, in the order in which they come: a table without memory of its own for each, used again.
template <class Key>
class KeyNumbers {
public:
    std::vector<Key> keys;

    /// @param expected  keys at least, a guess: more of them are no error.
    void clear(std::size_t expected) {
        keys.clear();
        std::size_t size = 16;
        while (size < 2 * expected) size *= 2;
        _slots.assign(size, none);
    }
    /// None, if it has none.
    unsigned find(const Key& key) const { return _slots[slot(key)]; }
    unsigned of(const Key& key) {
        const std::size_t at = slot(key);
        if (_slots[at] != none) return _slots[at];
        const auto number = unsigned(keys.size());
        _slots[at] = number;
        keys.push_back(key);
        if (2 * keys.size() > _slots.size()) grow();
        return number;
    }
    static constexpr unsigned none = ~0u;

private:
    static std::size_t hash(std::uint64_t key) { return mixed(key); }
    static std::size_t hash(const std::array<std::int64_t, 3>& key) {
        return mixed(std::uint64_t(key[0]) + 0x10001u * std::uint64_t(key[1]) + 0x100000007u * std::uint64_t(key[2]));
    }
    static std::size_t hash(const glm::dvec3& key) {
        std::array<std::int64_t, 3> bits;
        std::memcpy(bits.data(), &key, sizeof bits);
        return hash(bits);
    }
    static std::size_t hash(const glm::vec3& key) {
        std::uint32_t bits[3];
        std::memcpy(bits, &key, sizeof bits);
        return mixed(bits[0] + 0x10001u * std::uint64_t(bits[1]) + 0x100000007u * std::uint64_t(bits[2]));
    }
    static std::size_t mixed(std::uint64_t value) {
        return std::size_t((value ^ value >> 29) * 0x9E3779B97F4A7C15u >> 20);
    }
    std::size_t slot(const Key& key) const {
        std::size_t at = hash(key) & (_slots.size() - 1);
        while (_slots[at] != none && keys[_slots[at]] != key) at = (at + 1) & (_slots.size() - 1);
        return at;
    }
    void grow() {
        _slots.assign(2 * _slots.size(), none);
        for (std::size_t i = 0; i < keys.size(); ++i) _slots[slot(keys[i])] = unsigned(i);
    }
    std::vector<unsigned> _slots;
};

} // namespace gnomon
