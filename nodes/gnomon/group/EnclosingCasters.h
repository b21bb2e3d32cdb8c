// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/RecalledCauses.h>

#include <string>

namespace gnomon {

/// Finds the node that keeps a light from nearly all that is seen, for diagnose(): a sky dome among the casters, for one.
///
/// A node is named if it holds nearly all receivers, stands between them and the light, and closes most other ways as well:
/// so neither a mountain at dusk nor a table is. Its drawables do not count as receivers.
///
/// Cost    a look at the casters' boxes. Rays, 128 of them, only if a node holds the receivers. See RecalledCauses.
/// Limits  receivers are taken by the boxes of the seven largest drawables in sight. Drawables below one node count together.
/// @return a cause for ShadowTechnique::report(); empty if there is no such node. Reads the graph: call in cull.
std::string enclosingCause(const LitView& view);

} // namespace gnomon
