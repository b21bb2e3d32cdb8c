// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/group/ViewFrame.h>

#include <string>

namespace gnomon {

/// Finds one drawable that keeps a light from nearly all that a view sees, as the dome of a sky does: nobody wants that, and
/// the picture does not say why it is dark. Samples the boxes of what is seen, and casts rays at the largest casters.
///
/// Cost    a few thousand tests of boxes; rays at casters whose boxes block them, of 20,000 triangles at most: two
///         milliseconds. Ask seldom.
/// @param view  with the leaves that are seen.
/// @return the cause, as ShadowTechnique::report() takes it; empty if there is no such drawable.
std::string whatDarkensAll(const CasterDrawables& casters, const ViewFrame& view, const ShadowLight& light);

} // namespace gnomon
