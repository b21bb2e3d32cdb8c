// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Node>
#include <osg/ref_ptr>

#include <algorithm>
#include <vector>

namespace gnomon {

/// Selects part of a scene graph by one or more nodes, by a mask, or by both.
///
/// Use it to say which nodes cast (ShadowCasterGroup::setCasters()) and which receive (ShadowTechnique::setReceiver()).
/// A drawable is selected if it lies under `node`, or under one of `others`, and `mask` lets every node on the way down to it pass.
/// The default selects everything.
struct Selection {
    osg::ref_ptr<osg::Node> node;   ///< Root of the part. Null selects any node.
    osg::Node::NodeMask mask = ~0u; ///< Compared with node masks as a traversal mask is. Default: all bits.
    std::vector<osg::ref_ptr<osg::Node>> others = {}; ///< More roots. They count only if `node` is set.

    /// All roots: `node` first, then the others. Empty if any node is selected.
    std::vector<osg::ref_ptr<osg::Node>> roots() const {
        std::vector<osg::ref_ptr<osg::Node>> all;
        if (node) all.push_back(node);
        if (node) std::copy_if(others.begin(), others.end(), std::back_inserter(all), [](const auto& n) { return n; });
        return all;
    }
    /// True if nodes and mask are equal.
    bool operator==(const Selection& other) const {
        return node == other.node && mask == other.mask && others == other.others;
    }
    /// True if a node or the mask differs.
    bool operator!=(const Selection& other) const { return !(*this == other); }
};

} // namespace gnomon
