// SPDX-License-Identifier: MIT
#pragma once
#include <osg/BoundingBox>
#include <osg/MatrixTransform>

namespace gnomon::examples {

/// Box about everything finite that a subgraph draws, in the frame that its root stands in; invalid if there is
/// nothing.
osg::BoundingBoxd sceneBounds(osg::Node& root);

/// A subgraph moved and scaled so that the box about it has its middle at the origin and its corners this far away.
osg::ref_ptr<osg::MatrixTransform> fitted(osg::Node& root, double radius);

} // namespace gnomon::examples
