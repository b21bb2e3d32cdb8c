// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/Matrixd>
#include <osg/Node>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A node found by its name, and where it stands.
struct NamedNode {
    osg::ref_ptr<osg::Node> node;
    osg::Matrixd
        rootFromParent; ///< from the frame that the node stands in (its own transform left out) to that of the root.
};

/// First node called exactly `name` under `root` (itself included), depth first, whatever masks and switches say.
/// nullopt if there is none, or `name` is empty.
GNOMON_EXPORT std::optional<NamedNode> findNamed(osg::Node& root, const std::string& name);

/// Names under `root`, in the order they are met, each once; at most `limit`. For messages.
GNOMON_EXPORT std::vector<std::string> nodeNames(osg::Node& root, std::size_t limit = 10);

} // namespace gnomon
