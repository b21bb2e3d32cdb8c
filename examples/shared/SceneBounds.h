// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/SceneProps.h>

#include <osg/MatrixTransform>

namespace gnomon::examples {

/// A subgraph moved and scaled so that the box about it has its middle at the origin and its corners this far away.
osg::ref_ptr<osg::MatrixTransform> fitted(osg::Node& root, double radius);

} // namespace gnomon::examples
