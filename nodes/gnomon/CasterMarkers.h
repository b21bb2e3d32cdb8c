// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Marks a node whose drawables, and whatever is below it, never cast.
class GNOMON_EXPORT NeverCasts {
public:
    virtual ~NeverCasts() = default;
};

/// Marks a group that may show all its children and do nothing else with them.
class GNOMON_EXPORT ShowsChildren {
public:
    virtual ~ShowsChildren() = default;
    /// False for a derived class, which may traverse in its own way.
    virtual bool showsAllChildren() const = 0;
};

} // namespace gnomon
