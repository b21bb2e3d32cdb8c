// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

class CopiedNodes;

/// Marks a node that names other nodes, which it does not own as children.
class GNOMON_EXPORT NamesNodes {
public:
    virtual ~NamesNodes() = default;
    /// Called after a deep copy. The node names the copies from then on.
    virtual void followCopies(const CopiedNodes& copied) = 0;
};

} // namespace gnomon
