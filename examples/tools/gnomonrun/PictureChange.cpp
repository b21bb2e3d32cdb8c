// SPDX-License-Identifier: MIT
#include "PictureChange.h"

#include <algorithm>

namespace gnomon::examples {
namespace {

constexpr int channels = 3; // alpha is not seen

/// All pixels about (x, y), as far as the picture goes, are as it is.
bool isEven(const PictureChange& of, int x, int y, int reach) {
    const std::uint8_t here = of.darker[std::size_t(y) * std::size_t(of.width) + std::size_t(x)];
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, of.height - 1); ++v)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, of.width - 1); ++u)
            if (of.darker[std::size_t(v) * std::size_t(of.width) + std::size_t(u)] != here) return false;
    return true;
}

} // namespace

PictureChange changeOf(const osg::Image& without, const osg::Image& with, int least) {
    PictureChange change;
    change.width = without.s();
    change.height = without.t();
    change.darker.resize(std::size_t(change.width) * std::size_t(change.height));
    if (with.s() != change.width || with.t() != change.height) return change;
    for (int y = 0; y < change.height; ++y)
        for (int x = 0; x < change.width; ++x) {
            const unsigned char *before = without.data(unsigned(x), unsigned(y)),
                                *after = with.data(unsigned(x), unsigned(y));
            bool darker = false, brighter = false;
            for (int i = 0; i < channels; ++i) {
                darker |= before[i] - after[i] > least;
                brighter |= after[i] - before[i] > least;
            }
            change.brighterPixels += brighter;
            change.darkerPixels += darker && !brighter;
            change.darker[std::size_t(y) * std::size_t(change.width) + std::size_t(x)] = darker && !brighter;
        }
    return change;
}

int disagreement(const PictureChange& a, const PictureChange& b, int reach) {
    if (a.width != b.width || a.height != b.height) return std::max(a.darkerPixels, b.darkerPixels);
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(a.width) + std::size_t(x);
            count += a.darker[i] != b.darker[i] && isEven(a, x, y, reach) && isEven(b, x, y, reach);
        }
    return count;
}

} // namespace gnomon::examples
