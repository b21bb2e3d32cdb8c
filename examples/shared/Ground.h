// SPDX-License-Identifier: MIT
#pragma once
#include <osg/BoundingBox>
#include <osg/Node>
#include <osg/ref_ptr>

namespace gnomon::examples {

/// Matt white square, z up, its centre under that of `scene` and at its lowest point; the node is named "ground".
/// @param side  scene's unit, > 0.
osg::ref_ptr<osg::Node> makeGround(const osg::BoundingBoxd& scene, double side);

} // namespace gnomon::examples
