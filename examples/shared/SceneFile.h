// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Node>
#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace gnomon::examples {

/// Reads files as any OpenSceneGraph program does, pseudo-loader suffixes and -O options included.
/// @return one node that holds all of them.
/// @throws std::runtime_error, one sentence, for a file that is missing, a directory, damaged, of another type or
/// empty. A reader that crashes on a damaged file ends the program with the same sentence and status 1.
osg::ref_ptr<osg::Node> readScene(const std::vector<std::string>& files, const std::string& program);

} // namespace gnomon::examples
