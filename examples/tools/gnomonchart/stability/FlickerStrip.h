// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/Flicker.h>
#include <osg/Image>

namespace gnomon::examples {

/// Three pictures side by side: the visibility of a frame and of the next one, then the next one dark, with the change
/// that the truth does not have in red.
osg::ref_ptr<osg::Image> flickerStrip(const metrics::FlickerChange& change);

} // namespace gnomon::examples
