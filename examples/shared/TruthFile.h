// SPDX-License-Identifier: MIT
#pragma once
#include <metrics/PixelSets.h>
#include <osg/Image>

#include <string>

namespace gnomon::examples {

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
