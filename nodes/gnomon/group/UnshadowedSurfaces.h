// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/group/RecalledCauses.h>

#include <osg/Drawable>

#include <set>
#include <string>

namespace gnomon {

/// Finds a surface that the casters' shadow can reach, for diagnose().
///
/// Cost    the boxes of the casters for each of the 32 largest surfaces, until one is met, and the triangles of
///         a surface that culls faces. See RecalledCauses.
/// Limits  a drawable's shadow on itself does not count. Boxes are larger than what they hold, and so are shrunk: a shadow on
///         the outermost tenth of a surface's box, to each side, is not looked for.
/// @param view        its receivers are the surfaces in view that get no shadow.
/// @param shadowed    those that get one: what is sunk in a flat one of them is not looked at.
/// @param notCasting  drawables that cast nothing there.
/// @return the name of the largest surface that a caster can shadow; empty if there is none.
std::string unshadowedSurface(const LitView& view, const LeafSet& shadowed,
                              const std::set<const osg::Drawable*>& notCasting);

} // namespace gnomon
