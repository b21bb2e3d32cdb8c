// SPDX-License-Identifier: MIT
#include "ImageFile.h"
#include "CrashGuard.h"

#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <array>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using Result = osgDB::ReaderWriter::ReadResult;

std::string quoted(const std::string& file) { return "\"" + file + "\""; }

std::string damagedSentence(const std::string& file) {
    return quoted(file) +
           " cannot be read as an image: it is damaged or not what its name says (tif, osgb, png, … can be read).";
}

Result read(const std::string& file, const std::string& program) {
    const CrashGuard guard(program + ": " + damagedSentence(file));
    try {
        osgDB::Registry* registry = osgDB::Registry::instance();
        return registry->readImage(file, registry->getOptions());
    } catch (const std::exception&) {
        return Result::ERROR_IN_READING_FILE;
    }
}

std::string whyNot(const std::string& file, const Result& result) {
    if (osgDB::fileType(file) == osgDB::DIRECTORY) return quoted(file) + " is a directory; an image file is needed.";
    if (osgDB::findDataFile(file).empty() && result.status() != Result::ERROR_IN_READING_FILE)
        return "there is no file " + quoted(file) + ", or no reader for its type.";
    return damagedSentence(file);
}

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
    Result result = read(file, program);
    osg::ref_ptr<osg::Image> image = result.getImage();
    if (!image) throw std::runtime_error(whyNot(file, result));
    if (image->s() < 1 || image->t() < 1 || !image->data()) throw std::runtime_error(damagedSentence(file));
    return image;
}

metrics::Picture readGrey(const std::string& file, const std::string& program) {
    const osg::ref_ptr<osg::Image> image = readImage(file, program);
    if (!isUnderstood(*image))
        throw std::runtime_error(quoted(file) + " holds pixels of a kind that cannot be compared: grey or colour, in "
                                                "bytes, shorts or floats, is needed.");
    if (image->getOrigin() == osg::Image::TOP_LEFT) image->flipVertical();
    metrics::Picture picture(image->s(), image->t());
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            picture.at(x, y) = grey(image->getColor(static_cast<unsigned>(x), static_cast<unsigned>(y)));
    return picture;
}

} // namespace gnomon::examples
