// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Image>
#include <osg/ImageUtils>

namespace gnomon::examples {

/// Calls `take(red, green, blue)` for each pixel of an image as osg::Image::getColor() has them, row by row, the lowest
/// first. Other than getColor() it asks once an image what kind its pixels are.
template <typename Take>
void readColours(const osg::Image& image, const Take& take) {
    struct Operator : osg::CastAndScaleToFloatOperation {
        const Take& take;
        explicit Operator(const Take& given) : take(given) {}
        void luminance(float l) const { take(l, l, l); }
        void alpha(float) const { take(1.0f, 1.0f, 1.0f); }
        void luminance_alpha(float l, float) const { take(l, l, l); }
        void rgb(float r, float g, float b) const { take(r, g, b); }
        void rgba(float r, float g, float b, float) const { take(r, g, b); }
    };
    Operator each(take);
    osg::readImage(&image, each);
}

} // namespace gnomon::examples
