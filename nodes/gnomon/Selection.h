// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Node>
#include <osg/ref_ptr>

namespace gnomon {

/// Part of a scene graph: what lies under `node` (empty: anything) and is let through by `mask` on its whole way
/// down, as a traversal mask works. Both must hold.
struct Selection {
    osg::ref_ptr<osg::Node> node;
    osg::Node::NodeMask mask = ~0u;

    bool operator==(const Selection& other) const { return node == other.node && mask == other.mask; }
    bool operator!=(const Selection& other) const { return !(*this == other); }
};

} // namespace gnomon
