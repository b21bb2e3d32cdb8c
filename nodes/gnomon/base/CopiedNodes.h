// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Group>

#include <unordered_map>

namespace gnomon {

/// Which node of a copied subgraph stands for which of the original's. Nodes that both share stand for themselves, as
/// after a shallow copy. Of a node that the original holds twice, and the copy as two, the first counts.
class CopiedNodes {
public:
    CopiedNodes(const osg::Node& original, osg::Node& copy) { pair(original, copy); }

    /// The copy's node for `original`; `original` itself if it was not copied.
    osg::Node* of(osg::Node* original) const {
        const auto found = _copies.find(original);
        return found == _copies.end() ? original : found->second;
    }

    /// Calls `visit` with each node that was copied.
    template <class Visit>
    void forEachCopy(const Visit& visit) const {
        for (const auto& entry : _copies) visit(*entry.second);
    }

private:
    /// A copied group has its children in the same order.
    void pair(const osg::Node& original, osg::Node& copy) {
        if (&original == &copy || !_copies.emplace(&original, &copy).second) return;
        const osg::Group* from = original.asGroup();
        osg::Group* to = copy.asGroup();
        if (!from || !to || from->getNumChildren() != to->getNumChildren()) return;
        for (unsigned i = 0; i < from->getNumChildren(); ++i) pair(*from->getChild(i), *to->getChild(i));
    }

    std::unordered_map<const osg::Node*, osg::Node*> _copies;
};

} // namespace gnomon
