// SPDX-License-Identifier: MIT
#include "Pictures.h"
#include "ImageFile.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace gnomon::examples {
namespace {

unsigned char byteOf(double value) {
    return static_cast<unsigned char>(value > 0.0 ? std::lround(255.0 * std::min(value, 1.0)) : 0); // NaN is black
}

} // namespace

ShadedPicture coloursOf(const osg::Image& image) {
    ShadedPicture picture(image.s(), image.t());
    auto colour = picture.cells.begin();
    readColours(image, [&](float r, float g, float b) { *colour++ = glm::dvec3(double(r), double(g), double(b)); });
    return picture;
}

osg::ref_ptr<osg::Image> bytesOf(const ShadedPicture& picture) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(picture.width, picture.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < 3; ++c)
                image->data(static_cast<unsigned>(x), static_cast<unsigned>(y))[c] = byteOf(picture.at(x, y)[c]);
    return image;
}

std::string fileName(const std::vector<std::string>& parts, const std::string& ending) {
    std::string name;
    for (const std::string& part : parts) {
        if (!name.empty()) name += '-';
        for (const char c : part)
            name += std::isalnum(static_cast<unsigned char>(c))
                        ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                        : '-';
    }
    return name + ending;
}

} // namespace gnomon::examples
