// SPDX-License-Identifier: MIT
#include "ImageFile.h"
#include "InputFile.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace gnomon::examples {
namespace {

/// What readColours() understands.
bool isUnderstood(const osg::Image& image) {
    const auto isOneOf = [](GLenum value, std::initializer_list<GLenum> allowed) {
        return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
    };
    return image.r() == 1 && isOneOf(image.getDataType(), {GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT}) &&
           isOneOf(image.getPixelFormat(), {GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA, GL_BGR, GL_BGRA});
}

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

metrics::Picture readGrey(const std::string& file, const std::string& program) {
    const osg::ref_ptr<osg::Image> image = readImage(file, program);
    if (!isUnderstood(*image))
        throw std::runtime_error(
            quoted(file) +
            " has a pixel format that cannot be compared. Give grey or colour in bytes, shorts or floats.");
    if (image->getOrigin() == osg::Image::TOP_LEFT) image->flipVertical();
    return greysOf(*image);
}

metrics::Picture greysOf(const osg::Image& image) {
    metrics::Picture greys(image.s(), image.t());
    auto grey = greys.cells.begin();
    readColours(image, [&](float r, float g, float b) { *grey++ = (double(r) + double(g) + double(b)) / 3.0; });
    return greys;
}

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
