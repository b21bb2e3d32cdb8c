// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Shape>
#include <osg/ref_ptr>

#include <string>

namespace gnomon::examples {

/// Reads an elevation model as OpenSceneGraph does: what GDAL reads with the suffix .gdal, as in "dem.tif.gdal".
/// It puts posts on the north-west corners of GDAL's cells: half a cell off where heights stand for the cells' middles.
/// @return a field of 2 × 2 posts at least.
/// @throws std::runtime_error, one sentence, for a file that is missing, a directory, damaged, of another type, or level
/// at 0 all over: so GDAL's reader gives a model whose data cannot be read.
osg::ref_ptr<osg::HeightField> readElevation(const std::string& file, const std::string& program);

} // namespace gnomon::examples
