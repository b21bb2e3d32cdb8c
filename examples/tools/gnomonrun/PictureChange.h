// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Image>

#include <cstdint>
#include <vector>

namespace gnomon::examples {

/// Which pixels of a picture are not those of the same picture without shadows. Both are RGBA bytes of one size.
struct PictureChange {
    int width = 0, height = 0;
    std::vector<std::uint8_t>
        darker; ///< a pixel each: 1 if a channel is darker by more than `least`, and none brighter.
    int darkerPixels = 0;
    int brighterPixels = 0; ///< with a channel that is brighter by more than `least`.
};

/// @param least  of 255: smaller differences do not count.
PictureChange changeOf(const osg::Image& without, const osg::Image& with, int least = 2);

/// Pixels at which two changes differ although neither has an edge near. @param reach  pixels that are near.
int disagreement(const PictureChange& a, const PictureChange& b, int reach = 3);

} // namespace gnomon::examples
