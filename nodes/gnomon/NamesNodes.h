// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Selection.h>

#include <vector>

namespace gnomon {

/// Marks a node that names other nodes, which it does not own as children.
class GNOMON_EXPORT NamesNodes {
public:
    virtual ~NamesNodes() = default;
    /// The parts of the scene that it names, without those that select everything.
    virtual std::vector<Selection> namedParts() const = 0;
};

} // namespace gnomon
