// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/ProgramText.h>

#include <osg/StateAttribute>
#include <osg/StateSet>
#include <osg/Vec2d>
#include <osgUtil/RenderBin>
#include <osgUtil/StateGraph>

#include <tuple>
#include <vector>

namespace gnomon {

/// A bin may have a state set of its own, which lies under those of its leaves and is not among their graphs. Puts it there, for
/// this frame: what is drawn stays the same, and all that is asked of a leaf's state counts it. Sets of alpha tests alone,
/// as every transparent bin has one, stay where they are. Call it in cull.
void moveBinStatesToGraphs(osgUtil::RenderBin& bin);

/// While one lives in a thread, each graph that the functions below are asked about is resolved once; without one, each time.
/// State sets must stay as they are meanwhile. They may lie within one another.
class KnownStates {
public:
    KnownStates();
    ~KnownStates();
    KnownStates(const KnownStates&) = delete;
    KnownStates& operator=(const KnownStates&) = delete;
};

/// True if a mode is on after all state sets from the root to `graph`, as osg::State resolves it.
/// @param unset  where no state set gives the mode.
bool isOn(const osgUtil::StateGraph* graph, osg::StateAttribute::GLMode mode, bool unset = false);

/// An attribute after all state sets from the root to `graph`; null if none of them has it.
/// @param overrides  gets whether it holds against the sets below; may be null.
const osg::StateAttribute* resolvedAttribute(const osgUtil::StateGraph* graph, osg::StateAttribute::Type type,
                                             bool* overrides = nullptr);

template <typename Attribute>
const Attribute* resolved(const osgUtil::StateGraph* graph, osg::StateAttribute::Type type) {
    return dynamic_cast<const Attribute*>(
        resolvedAttribute(graph, type)); // a type is a number that others may take, too
}

/// The same of a texture unit's attributes and modes; a mode that no state set gives is off.
const osg::StateAttribute* resolvedTextureAttribute(const osgUtil::StateGraph* graph, unsigned unit,
                                                    osg::StateAttribute::Type type);
bool isTextureModeOn(const osgUtil::StateGraph* graph, unsigned unit, osg::StateAttribute::GLMode mode);

/// What the program that draws so says of where, and what, it draws; nothing where none does.
/// @param matrices  as of placesOf().
ProgramPlaces placesIn(const osgUtil::StateGraph* graph, const std::vector<MatrixUniform>& matrices = {});

/// True if what is drawn so leaves its depth: depth test and depth mask are on.
bool writesDepth(const osgUtil::StateGraph* graph);

/// False if what is drawn so leaves no colour: osg::ColorMask closes all three channels.
bool writesColor(const osgUtil::StateGraph* graph);

/// True if what is drawn so can show only where it is nearest, and never over what was drawn before it at the same depth: depth
/// test LESS with writing, no blending, offset, stencil, depth range or colour mask.
bool isPlain(const osgUtil::StateGraph* graph);

/// True if it writes depth and does not blend: where its depth stands, its colour is what one sees.
bool isOpaque(const osgUtil::StateGraph* graph);

/// True if triangles are drawn filled.
bool isFilled(const osgUtil::StateGraph* graph);

/// True if a shadow could be expected on what is drawn so, unlike on a sky: it is lit, or a program draws it.
bool isShaded(const osgUtil::StateGraph* graph);

/// Where a state puts depths, besides where the projection does.
struct DepthPlacement {
    double nearest = 0.0, farthest = 1.0; ///< osg::Depth's range.
    double pixels = 0.0; ///< pushed back by what the depth changes over so many pixels: osg::PolygonOffset's factor.
    double steps = 0.0;  ///< and by so many steps of the depth buffer: its units.

    bool isPlain() const { return *this == DepthPlacement(); }
    bool operator==(const DepthPlacement& other) const { return key() == other.key(); }
    bool operator<(const DepthPlacement& other) const { return key() < other.key(); }

private:
    std::tuple<double, double, double, double> key() const { return {nearest, farthest, pixels, steps}; }
};

/// What an offset brings nearer to the eye counts as in its place: shadows find it all the same.
DepthPlacement depthPlacementOf(const osgUtil::StateGraph* graph);

/// The polygon offset that is on: in pixels of the surface's slope, and in steps of the depth buffer; away from the eye where
/// positive. Zeros where none is on.
osg::Vec2d polygonOffsetOf(const osgUtil::StateGraph* graph);

} // namespace gnomon
