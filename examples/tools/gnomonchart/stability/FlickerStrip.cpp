// SPDX-License-Identifier: MIT
#include "FlickerStrip.h"

#include "../measure/Pictures.h"

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr int gap = 2; // px

/// What is not measured is black.
double greyOf(double visibility) {
    return std::isfinite(visibility) ? 0.15 + 0.7 * std::clamp(visibility, 0.0, 1.0) : 0.0;
}

glm::dvec3 changedColour(double visibility, double beyond) {
    return glm::mix(glm::dvec3(0.4 * greyOf(visibility)), glm::dvec3(1.0, 0.1, 0.1), std::min(1.0, beyond));
}

} // namespace

osg::ref_ptr<osg::Image> flickerStrip(const metrics::FlickerChange& change) {
    const int width = change.after.width, height = change.after.height;
    ShadedPicture strip(3 * width + 2 * gap, height, glm::dvec3(1.0));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            strip.at(x, y) = glm::dvec3(greyOf(change.before.at(x, y)));
            strip.at(x + width + gap, y) = glm::dvec3(greyOf(change.after.at(x, y)));
            strip.at(x + 2 * (width + gap), y) = changedColour(change.after.at(x, y), change.beyond.at(x, y));
        }
    return bytesOf(strip);
}

} // namespace gnomon::examples
