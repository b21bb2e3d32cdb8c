// SPDX-License-Identifier: MIT
#pragma once
#include <osg/NodeVisitor>

namespace gnomon {

/// Keeps what osgUtil::Optimizer would change against a node of the kit. Called from the node's traverse().
///
/// The transforms above the node, and those that it or a node below names, become DYNAMIC: planes and lights are given
/// in the node's frame. What is named outside of the node gets marks that the optimizer respects.
/// @return true if the optimizer must not visit the children, because something below the node is named, or a node of
///         the kit stands below a transform there. False for all other visitors.
bool keptFromOptimizer(osg::Node& node, osg::NodeVisitor& visitor);

/// Shows the optimizer a graph that ends with the node. Called from ascend().
/// @return false for all other visitors, which ascend.
bool endsForOptimizer(osg::NodeVisitor& visitor);

} // namespace gnomon
