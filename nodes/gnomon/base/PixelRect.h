// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Viewport>

namespace gnomon {

/// A rectangle of pixels, in window coordinates.
struct PixelRect {
    int x = 0, y = 0;
    int width = 0, height = 0;

    bool empty() const { return width <= 0 || height <= 0; }
};

/// The viewport that OpenGL has: osg::Viewport has fractions, after a resize say, and osg::Viewport::apply() drops them. Whatever
/// reckons in pixels takes this one.
inline PixelRect pixelsOf(const osg::Viewport& viewport) {
    return {static_cast<int>(viewport.x()), static_cast<int>(viewport.y()), static_cast<int>(viewport.width()),
            static_cast<int>(viewport.height())};
}

} // namespace gnomon
