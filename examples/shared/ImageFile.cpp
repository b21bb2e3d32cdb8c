// SPDX-License-Identifier: MIT
#include "ImageFile.h"
#include "InputFile.h"

#include <array>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr FileKind picture{"an image", "tif, osgb, png, …"};

constexpr ReadMethod images{
    [](osgDB::Registry& registry, const std::string& name) { return registry.readImage(name, registry.getOptions()); },
    [](osgDB::ReaderWriter& reader, std::istream& in, const osgDB::Options* options) {
        return reader.readImage(in, options);
    }};

template <std::size_t N>
bool isOneOf(GLenum value, const std::array<GLenum, N>& allowed) {
    for (const GLenum one : allowed)
        if (value == one) return true;
    return false;
}

/// What readColours() understands.
bool isUnderstood(const osg::Image& image) {
    constexpr std::array<GLenum, 3> types{GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT};
    constexpr std::array<GLenum, 6> formats{GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA, GL_BGR, GL_BGRA};
    return isOneOf(image.getDataType(), types) && isOneOf(image.getPixelFormat(), formats) && image.r() == 1;
}

} // namespace

osg::ref_ptr<osg::Image> readImage(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, picture, images);
    osg::ref_ptr<osg::Image> image = result.getImage();
    if (!image || image->s() < 1 || image->t() < 1 || !image->data())
        throw std::runtime_error(damagedSentence(file, picture));
    return image;
}

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

} // namespace gnomon::examples
