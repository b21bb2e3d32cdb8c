// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/PixelSets.h>
#include <osg/Image>
#include <osg/ImageUtils>

#include <string>

namespace gnomon::examples {

/// Calls `take(red, green, blue)` for each pixel of an image as osg::Image::getColor() has them, row by row, the lowest
/// first. Other than getColor() it asks once an image what kind its pixels are.
template <typename Take>
void readColours(const osg::Image& image, const Take& take) {
    struct Operator : osg::CastAndScaleToFloatOperation {
        const Take& take;
        explicit Operator(const Take& given) : take(given) {}
        void luminance(float l) const { take(l, l, l); }
        void alpha(float) const { take(1.0f, 1.0f, 1.0f); }
        void luminance_alpha(float l, float) const { take(l, l, l); }
        void rgb(float r, float g, float b) const { take(r, g, b); }
        void rgba(float r, float g, float b, float) const { take(r, g, b); }
    };
    Operator each(take);
    osg::readImage(&image, each);
}

/// A picture's grey, the mean of red, green and blue as they stand in the file, which must be linear. Bytes and shorts
/// go from 0 to 1; 32-bit floats (.tif, .osgb, .osgt, .osgx, .ktx in OSG 3.6.5) keep every value, NaN too.
/// @throws std::runtime_error, one sentence, for other kinds of pixels.
metrics::Picture readGrey(const std::string& file, const std::string& program);

/// The same of an image in memory, whose lowest row comes first.
metrics::Picture greysOf(const osg::Image& image);

/// The visibility in grey, dark outside R+; missed shadow red, false shadow and teeth blue, pale on edge pixels; magenta
/// where it is not measured on a surface that faces the light.
osg::ref_ptr<osg::Image> errorOverlay(const metrics::Picture& visibility, const metrics::TruthMaps& truth);

/// A truth in a file: one osg::Image of 32-bit floats (GL_LUMINANCE), a layer a map, as .osgb, .osgt or .osgx keep it.
/// Its descriptions name the layers, in any order; the lowest row comes first.
///
///     lit, litCentre, blockerDistance, receiver, facing                 needed
///     drawn, litByDisc, blocker, edgeLength, x, y, z                    optional; x, y, z together are `position`
///     user values towardsLight, up                                      Vec3d, optional
///
/// All as metrics::TruthMaps has them. Ids are whole numbers below 2^24; positions are rounded to floats, so give them
/// about a local origin. Layers of other names are passed over.
osg::ref_ptr<osg::Image> truthImage(const metrics::TruthMaps& truth);

/// The same from an image. `file` is named in errors.
/// @throws std::runtime_error, one sentence, if it is no truth: another kind of image, a needed layer missing, or on
/// the surface a number that is none, or a share outside 0 to 1.
metrics::TruthMaps truthOf(const osg::Image& image, const std::string& file);

metrics::TruthMaps readTruth(const std::string& file, const std::string& program);

} // namespace gnomon::examples
