// SPDX-License-Identifier: MIT
#pragma once
#include <osg/BoundingBox>
#include <osg/Node>

namespace gnomon::examples {

/// Box about everything finite that a subgraph draws, in the frame that its root stands in; invalid if there is
/// nothing.
osg::BoundingBoxd sceneBounds(osg::Node& root);

} // namespace gnomon::examples
