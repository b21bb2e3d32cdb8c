// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/group/RecalledCauses.h>

#include <osg/Matrixd>
#include <osg/Vec2d>

#include <string>

namespace gnomon {

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
bool reachesCoarseDepth(const LitView& view, const osg::Matrixd& projection, const DepthPixels& pixels);

/// Finds a caster that is so far away that depths do not tell where its shadow falls, for diagnose().
///
/// Cost    a look at the casters' boxes. See RecalledCauses.
/// @return the name of the first such caster that covers a pixel or more of the view; empty if there is none.
std::string coarselyPlaced(const LitView& view, const osg::Matrixd& projection, const DepthPixels& pixels);

} // namespace gnomon
