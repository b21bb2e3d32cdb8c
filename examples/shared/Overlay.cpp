// SPDX-License-Identifier: MIT
#include "Overlay.h"

#include <metrics/Confusion.h>
#include <metrics/PixelSets.h>

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

using Colour = glm::dvec3;

const Colour missedShadow(0.9, 0.1, 0.1), falseShadow(0.1, 0.2, 1.0), noNumber(1.0, 0.0, 1.0), turnedAway(0.1);

Colour colourAt(const metrics::Picture& visibility, const metrics::TruthMaps& truth, const metrics::PixelSets& sets,
                std::size_t i) {
    const double v = visibility.cells[i];
    if (!std::isfinite(v)) {
        if (truth.receiver.cells[i] == 0) return Colour(0.0);
        return truth.facing.cells[i] > 0.05 ? noNumber : turnedAway; // no renderer shows light there
    }
    const Colour grey(0.15 + 0.7 * std::clamp(v, 0.0, 1.0));
    if (!sets.facing.cells[i]) return 0.4 * grey;
    const bool lit = truth.litCentre.cells[i];
    if (metrics::isShadowed(v) != lit) return grey;
    const Colour wrong = lit ? falseShadow : missedShadow;
    return sets.certain.cells[i] ? wrong : 0.5 * (wrong + grey);
}

} // namespace

osg::ref_ptr<osg::Image> errorOverlay(const metrics::Picture& visibility, const metrics::TruthMaps& truth) {
    const metrics::PixelSets sets = metrics::pixelSets(truth, visibility);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(visibility.width, visibility.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (std::size_t i = 0; i < visibility.cells.size(); ++i) {
        const Colour colour = colourAt(visibility, truth, sets, i);
        const int width = visibility.width, at = static_cast<int>(i);
        unsigned char* pixel = image->data(static_cast<unsigned>(at % width), static_cast<unsigned>(at / width));
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<unsigned char>(std::lround(255.0 * colour[c]));
    }
    return image;
}

} // namespace gnomon::examples
