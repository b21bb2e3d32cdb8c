// SPDX-License-Identifier: MIT
#pragma once
#include <osg/BoundingBox>
#include <osg/Matrixd>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gnomon {

/// 64 bits that stand for all that was mixed in, in its order.
///
/// Each step is one to one, in the word and in what came before: two that differ in one word never agree. The odd factor
/// carries a difference up, the shift down again, so that it reaches all bits and the words' order matters.
class Fingerprint {
public:
    void mix(std::uint64_t bits) {
        _hash = (_hash ^ bits) * 0x9e3779b97f4a7c15u + 1;
        _hash ^= _hash >> 32;
    }
    void mix(double value) {
        std::uint64_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        mix(bits);
    }
    void mix(const void* address) { mix(std::uint64_t{reinterpret_cast<std::uintptr_t>(address)}); }
    void mix(const osg::BoundingBox& box) {
        std::uint64_t words[(sizeof box._min + sizeof box._max) / sizeof(std::uint64_t)];
        std::memcpy(words, box._min.ptr(), sizeof box._min);
        std::memcpy(reinterpret_cast<char*>(words) + sizeof box._min, box._max.ptr(), sizeof box._max);
        for (const std::uint64_t word : words) mix(word);
    }
    void mix(const osg::Matrixd& matrix) {
        for (int i = 0; i < 16; ++i) mix(matrix.ptr()[i]);
    }
    /// In four ways side by side, for each step waits for the one before.
    void mixBytes(const void* data, std::size_t size) {
        const auto* at = static_cast<const unsigned char*>(data);
        Fingerprint ways[4];
        std::uint64_t words[4];
        const auto mixWords = [&] {
            for (int i = 0; i < 4; ++i) ways[i].mix(words[i]);
        };
        for (; size >= sizeof words; at += sizeof words, size -= sizeof words) {
            std::memcpy(words, at, sizeof words);
            mixWords();
        }
        std::memset(words, 0, sizeof words);
        std::memcpy(words, at, size);
        mixWords();
        for (const Fingerprint& way : ways) mix(way.value());
    }
    std::uint64_t value() const { return _hash; }

private:
    std::uint64_t _hash = 0;
};

} // namespace gnomon
