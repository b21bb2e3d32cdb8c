// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Selection.h>

#include <OpenThreads/Mutex>
#include <osg/observer_ptr>

#include <string>
#include <vector>

namespace gnomon {

/// Names a node for another node, its owner, without keeping it alive. The node may therefore stand above its owner.
///
/// A copy of the owner names the copy's own node as soon as the copied graph is whole. It looks where the original's node
/// stands as seen from the original owner: so many parents up, then down by the same children. If the copy of the owner
/// stands in the original's graph, it names the original's node.
///
/// Limits
/// - If nothing else keeps the node, the node is deleted, and the reference is gone.
/// - A copied graph that is changed above its owner before its first frame may keep naming the original's node.
/// Threads
/// - Any number.
class GNOMON_EXPORT ObservedNode {
public:
    /// Names a node, or none.
    ObservedNode(osg::Node* node = nullptr);
    /// For a copy of `owner`, whose reference `other` is.
    ObservedNode(const ObservedNode& other, const osg::Node& owner);
    /// For the same owner.
    ObservedNode(const ObservedNode& other);
    /// For the same owner.
    ObservedNode& operator=(const ObservedNode& other);
    ~ObservedNode();

    /// The node that `owner` names; null if none is named or it is gone.
    osg::ref_ptr<osg::Node> in(const osg::Node& owner) const;
    /// True if a node was named and has been deleted since.
    bool isGone(const osg::Node& owner) const { return _names && !in(owner); }

private:
    /// Where the node stands as seen from its owner.
    struct Way {
        osg::observer_ptr<osg::Node> top; ///< above both.
        unsigned up = 0;                  ///< parents from the owner to `top`.
        std::vector<unsigned> down;       ///< children from `top` to the node.
        std::string kind;                 ///< and name of the node; empty if there is nothing to follow.
    };
    static Way wayFrom(const osg::Node& owner, osg::Node& named);
    static osg::Node* endOf(const Way& way, const osg::Node& top);
    osg::ref_ptr<osg::Node> node() const;
    void followCopy(const osg::Node& owner) const;

    mutable OpenThreads::Mutex _mutex;
    mutable osg::observer_ptr<osg::Node> _node;
    mutable Way _way;
    bool _names = false;
};

/// A Selection that a node names, as ObservedNode does.
class GNOMON_EXPORT ObservedSelection {
public:
    /// Everything.
    ObservedSelection() = default;
    /// The same part.
    ObservedSelection(const Selection& selection);
    /// For a copy of `owner`.
    ObservedSelection(const ObservedSelection& other, const osg::Node& owner);

    /// The part that `owner` names, without nodes that are gone. Null and the mask 0, which select nothing, if all are.
    Selection in(const osg::Node& owner) const;
    /// True if nodes were named, and all of them have been deleted since.
    bool isGone(const osg::Node& owner) const;

private:
    std::vector<ObservedNode> _nodes;
    osg::Node::NodeMask _mask = ~0u;
};

} // namespace gnomon
