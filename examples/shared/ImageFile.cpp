// SPDX-License-Identifier: MIT
#include "ImageFile.h"
#include "InputFile.h"

#include <array>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr FileKind picture{"an image", "tif, osgb, png, …"};

template <std::size_t N>
bool isOneOf(GLenum value, const std::array<GLenum, N>& allowed) {
    for (const GLenum one : allowed)
        if (value == one) return true;
    return false;
}

/// What osg::Image::getColor() understands.
bool isUnderstood(const osg::Image& image) {
    constexpr std::array<GLenum, 3> types{GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT};
    constexpr std::array<GLenum, 6> formats{GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA, GL_BGR, GL_BGRA};
    return isOneOf(image.getDataType(), types) && isOneOf(image.getPixelFormat(), formats) && image.r() == 1;
}

double grey(const osg::Vec4& colour) { return (double(colour.r()) + double(colour.g()) + double(colour.b())) / 3.0; }

} // namespace

osg::ref_ptr<osg::Image> readImage(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, picture, [](osgDB::Registry& registry, const std::string& name) {
        return registry.readImage(name, registry.getOptions());
    });
    osg::ref_ptr<osg::Image> image = result.getImage();
    if (!image || image->s() < 1 || image->t() < 1 || !image->data())
        throw std::runtime_error(damagedSentence(file, picture));
    return image;
}

metrics::Picture readGrey(const std::string& file, const std::string& program) {
    const osg::ref_ptr<osg::Image> image = readImage(file, program);
    if (!isUnderstood(*image))
        throw std::runtime_error(quoted(file) + " holds pixels of a kind that cannot be compared: grey or colour, in "
                                                "bytes, shorts or floats, is needed.");
    if (image->getOrigin() == osg::Image::TOP_LEFT) image->flipVertical();
    return greysOf(*image);
}

metrics::Picture greysOf(const osg::Image& image) {
    metrics::Picture greys(image.s(), image.t());
    for (int y = 0; y < greys.height; ++y)
        for (int x = 0; x < greys.width; ++x)
            greys.at(x, y) = grey(image.getColor(static_cast<unsigned>(x), static_cast<unsigned>(y)));
    return greys;
}

} // namespace gnomon::examples
