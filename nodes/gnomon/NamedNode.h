// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Selection.h>

#include <osg/Matrixd>
#include <osg/Node>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A node found by its name, with its place in the graph.
struct NamedNode {
    osg::ref_ptr<osg::Node> node; ///< The node itself.
    osg::Matrixd
        rootFromParent; ///< Transform from the node's parent frame to the root's. The node's own transform is left out.
};

/// Finds a node by its exact name, depth first. It looks at `root` too, and ignores node masks and switches.
/// @return the first match; nullopt if there is none or `name` is empty.
GNOMON_EXPORT std::optional<NamedNode> findNamed(osg::Node& root, const std::string& name);

/// Finds all nodes of this exact name, in traversal order, as findNamed() does. It does not look below a match.
/// A node with several places is found once a place.
GNOMON_EXPORT std::vector<NamedNode> findAllNamed(osg::Node& root, const std::string& name);

/// The part of the scene under these nodes, each of them once. Everything if there are none.
GNOMON_EXPORT Selection selectionOf(const std::vector<NamedNode>& nodes);

/// Lists the names under `root` for a message: each once, in traversal order, at most `limit` of them.
GNOMON_EXPORT std::vector<std::string> nodeNames(osg::Node& root, std::size_t limit = 10);

} // namespace gnomon
