// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/DrawnLeaves.h>

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Vec2d>
#include <osgUtil/RenderLeaf>

#include <set>
#include <string>
#include <vector>

namespace gnomon {

/// Casters and what receives their shadow, in one view.
struct CastersInView {
    const Casters& casters;
    const std::vector<const osgUtil::RenderLeaf*>& receivers;
    const osg::Matrixd& eyeFromGroup;
};

/// Finds the node that keeps lights from nearly all that is seen, for diagnose(): a sky dome among the casters, for one.
///
/// A node is named if it holds nearly all receivers, stands between them and the light, and closes most other ways as well:
/// so neither a mountain at dusk nor a table is. Its drawables do not count as receivers.
///
/// Cost    a look at the casters' boxes. If a node holds the receivers, a tree of its triangles, some 200 ms for 200,000, and 128
///         rays a light.
/// Limits  receivers are taken by the boxes of the seven largest drawables in sight. Drawables below one node count together.
/// @return a cause for each light that has such a node. Reads the graph: call in cull.
std::vector<std::string> enclosingCauses(const CastersInView& seen, const std::vector<ShadowLight>& lights);

/// Finds a surface that the casters' shadow can reach, for diagnose().
///
/// Cost    the boxes of the casters for each of the 32 largest surfaces, until one is met, and the triangles of
///         a surface that culls faces.
/// Limits  a drawable's shadow on itself does not count. Boxes are larger than what they hold, and so are shrunk: a shadow on
///         the outermost tenth of a surface's box, to each side, is not looked for.
/// @param seen        its receivers are the surfaces in view that get no shadow.
/// @param shadowed    those that get one: what is sunk in a flat one of them is not looked at.
/// @param notCasting  drawables that cast nothing there.
/// @return the name of the largest surface that a caster can shadow; empty if there is none.
std::string unshadowedSurface(const CastersInView& seen, const ShadowLight& light, const LeafSet& shadowed,
                              const std::set<const osg::Drawable*>& notCasting);

/// Pixels of a viewport, and how many steps of its depth buffer a surface may be off.
struct DepthPixels {
    osg::Vec2d size;
    double steps = 1.0;
};

/// How far from the eye so many steps of a depth buffer of 24 bits become as long as a pixel is wide, as w in clip space.
/// Buffers of 32-bit float have steps of that size at most depths.
/// @param projection  as drawn, near and far included.
double coarseDepthFrom(const osg::Matrixd& projection, const DepthPixels& pixels);

/// True if the casters' box reaches that far: quickly asked.
bool reachesCoarseDepth(const CastersInView& seen, const osg::Matrixd& projection, const DepthPixels& pixels);

/// Finds a caster that is so far away that depths do not tell where its shadow falls, for diagnose().
///
/// Cost    a look at the casters' boxes.
/// @return the name of the first such caster that covers a pixel or more of the view; empty if there is none.
std::string coarselyPlaced(const CastersInView& seen, const osg::Matrixd& projection, const DepthPixels& pixels);

/// Finds what OpenGL draws off its place, because its vertices lie far from their origin and it reckons in floats, for diagnose():
/// a city in national coordinates. Places found by depths, and shadows, are off with it.
///
/// Cost    a look at the leaves' boxes.
/// @return the name of the first leaf that may lie more than four pixels, measured along the line of sight, off its place; empty if
///         there is none.
std::string drawnOffItsPlace(const std::vector<const osgUtil::RenderLeaf*>& leaves, const osg::Matrixd& projection,
                             const osg::Vec2d& pixels);

} // namespace gnomon
