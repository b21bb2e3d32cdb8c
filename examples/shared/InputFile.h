// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Image>
#include <osg/Node>
#include <osg/Shape>
#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace gnomon::examples {

/// Reads files as any OpenSceneGraph program does, pseudo-loader suffixes and -O options included.
/// @return one node that holds all of them.
/// @throws std::runtime_error, one sentence, for a file that is missing, a directory, damaged, of another type or
/// empty. A reader that crashes on a damaged file ends the program with the same sentence and status 1.
osg::ref_ptr<osg::Node> readScene(const std::vector<std::string>& files, const std::string& program);

/// Reads an elevation model as OpenSceneGraph does: what GDAL reads with the suffix .gdal, as in "dem.tif.gdal".
/// It puts posts on the north-west corners of GDAL's cells: half a cell off where heights stand for the cells' middles.
/// @return a field of 2 × 2 posts at least.
/// @throws std::runtime_error, one sentence, for a file that is missing, a directory, damaged, of another type, or level
/// at 0 all over: so GDAL's reader gives a model whose data cannot be read.
osg::ref_ptr<osg::HeightField> readElevation(const std::string& file, const std::string& program);

/// An image file by OSG's readers. @throws std::runtime_error, one sentence, if there is none or it cannot be read.
/// @param program  whose name goes before that sentence should a reader crash.
osg::ref_ptr<osg::Image> readImage(const std::string& file, const std::string& program);

std::string quoted(const std::string& file);

} // namespace gnomon::examples
