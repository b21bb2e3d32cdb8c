// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/PixelSets.h>
#include <osg/Image>

namespace gnomon::examples {

/// The visibility in grey, dark outside R+; missed shadow red, false shadow blue, both pale on edge pixels; magenta
/// where it is not measured on a surface that faces the light.
osg::ref_ptr<osg::Image> errorOverlay(const metrics::Picture& visibility, const metrics::TruthMaps& truth);

} // namespace gnomon::examples
