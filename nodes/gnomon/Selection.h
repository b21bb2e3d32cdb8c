// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Node>
#include <osg/ref_ptr>

namespace gnomon {

/// Selects part of a scene graph by a node, by a mask, or by both.
///
/// Use it to say which nodes cast (ShadowCasterGroup::setCasters()) and which receive (ShadowTechnique::setReceiver()).
/// A drawable is selected if it lies under `node` and `mask` lets every node on the way down to it pass.
/// The default selects everything.
struct Selection {
    osg::ref_ptr<osg::Node> node;   ///< Root of the part. Null selects any node.
    osg::Node::NodeMask mask = ~0u; ///< Compared with node masks as a traversal mask is. Default: all bits.

    /// True if node and mask are equal.
    bool operator==(const Selection& other) const { return node == other.node && mask == other.mask; }
    /// True if node or mask differs.
    bool operator!=(const Selection& other) const { return !(*this == other); }
};

} // namespace gnomon
