// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Group>

namespace gnomon::examples {

/// Four hundred boxes of various sizes and turns on level ground, 110 m square; the ground is named "ground".
osg::ref_ptr<osg::Group> flatTown();
/// The same boxes dug into hills of up to 6 m. Nothing in it is flat enough for a planar shadow.
osg::ref_ptr<osg::Group> hillyTown();
/// Mountains, 10 km square, 800 m between valley and summit, one drawable of 125,000 triangles.
osg::ref_ptr<osg::Group> mountains();
/// A room of 6 × 5 × 2.8 m, seen from inside, its floor named "ground", with a table, two chairs, a cupboard and a shelf.
osg::ref_ptr<osg::Group> furnishedRoom();

} // namespace gnomon::examples
