// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/RecalledCauses.h>

#include <osg/Matrixd>
#include <osg/Vec2d>

#include <string>

namespace gnomon {

/// How far from the eye a step of a depth buffer of 24 bits becomes as long as a pixel is wide, as w in clip space.
/// Buffers of 32-bit float have steps of that size at most depths.
/// @param projection  as drawn, near and far included. @param pixels  of the viewport.
double coarseDepthFrom(const osg::Matrixd& projection, const osg::Vec2d& pixels);

/// True if the casters' box reaches that far: quickly asked.
bool reachesCoarseDepth(const LitView& view, const osg::Matrixd& projection, const osg::Vec2d& pixels);

/// Finds a caster that is so far away that depths do not tell where its shadow falls, for diagnose().
///
/// Cost    a look at the casters' boxes. See RecalledCauses.
/// @return the name of the first such caster that covers a pixel or more of the view; empty if there is none.
std::string coarselyPlaced(const LitView& view, const osg::Matrixd& projection, const osg::Vec2d& pixels);

} // namespace gnomon
