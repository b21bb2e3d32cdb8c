// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Base of nodes that never cast, neither their drawables nor any node below them.
///
/// Derive a node from it in addition to its osg base class, as ShadowTechnique does.
class GNOMON_EXPORT NeverCasts {
public:
    virtual ~NeverCasts() = default;
};

/// Base of groups that traverse all their children and do nothing else. A search for one node below is then faster.
///
/// Derive a group from it in addition to its osg base class, as ShadowCasterGroup does.
class GNOMON_EXPORT ShowsChildren {
public:
    virtual ~ShowsChildren() = default;
    /// True if the group traverses all its children. A derived class that traverses in its own way returns false.
    virtual bool showsAllChildren() const = 0;
};

} // namespace gnomon
