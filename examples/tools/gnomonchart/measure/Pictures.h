// SPDX-License-Identifier: MIT
#pragma once
#include "Yardstick.h"

#include <osg/Image>

#include <string>

namespace gnomon::examples {

/// Red, green and blue as they stand in an image whose lowest row comes first.
ShadedPicture coloursOf(const osg::Image& image);

/// Bytes, clamped, without gamma: as a window shows it.
osg::ref_ptr<osg::Image> bytesOf(const ShadedPicture& picture);

/// A name for a file: small letters, digits and "-".
std::string fileName(const std::vector<std::string>& parts, const std::string& ending);

} // namespace gnomon::examples
