// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/CandidateFacts.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Vec4d>
#include <osg/observer_ptr>

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// A convex body, group frame: a connected part of a drawable, or the box about one.
struct ConvexBody {
    std::vector<glm::dvec3> corners;
    std::vector<glm::dvec4> planes; ///< of its faces, outwards, unit normals.
    glm::dvec3 middle{0.0};
    double radius = 0.0;  ///< all corners are within it of the middle.
    bool isPlate = false; ///< all corners lie in one plane, planes.front().
};

/// A caster as bodies.
struct DrawableBodies {
    std::vector<ConvexBody> bodies; ///< its convex parts; else one, the box about it.
    bool convex = false;            ///< all parts that are connected are convex, so that none shadows itself.
    bool flatShaded = false;        ///< Its normals are those of its faces: OpenGL shades no face that is turned away.
};

/// Casters as bodies, each found once. Keeps no caster alive.
class CasterShapes {
public:
    static constexpr std::size_t mostTriangles = 4000; ///< of a drawable that is looked at; others are boxes.
    /// Reads the graph as a cull traversal does, see meshOf().
    const DrawableBodies& of(const Caster& piece);
    /// Forgets casters that are gone.
    void prune();

private:
    struct Entry {
        osg::observer_ptr<const Caster> piece; // null if another has its address now
        DrawableBodies shape;
    };
    std::unordered_map<const Caster*, Entry> _known;
};

/// True if a caster may stand between a light and any part of a body; it errs towards true.
/// @param light  group frame: w = 0 the way towards a sun, length 1; w = 1 a lamp.
bool mayShadow(const ConvexBody& caster, const ConvexBody& body, const glm::dvec4& light);

/// The planes on which all of a light's shadow in a view falls, or why it does not all fall on planes.
struct FlatReceivers {
    std::vector<osg::Vec4d>
        planes;           ///< group frame, normals to the light's side; only those that something stands above.
    LeafSet leaves;       ///< that lie in these planes.
    bool whole = true;    ///< nothing of these leaves is outside of their planes.
    std::string obstacle; ///< empty: a PlanarShadowNode of these planes draws all of the shadow.

    /// True if no receiver gets any shadow.
    bool nothing() const { return planes.empty() && obstacle.empty(); }
};

/// True if relighting can draw the planes' leaves alone; see Mark::surfaces.
bool isRelitAlone(const AutoView& view, const FlatReceivers& flat);

/// @param shapes  of the view's casters; those that are asked for are found.
///
/// Techniques that shadow whatever they see darken sides that are turned away from the light, and planar does not. So none of
/// these may be in sight, unless OpenGL gives them no light anyway.
FlatReceivers findFlatReceivers(const AutoView& view, CasterShapes& shapes);

/// FlatReceivers::leaves of a view, for as long as nothing in it moves.
///
/// Cost  in a frame: a look at each of them. They are collected anew only where OSG keeps them at other addresses.
class FlatLeaves {
public:
    using Leaves = std::vector<const osgUtil::RenderLeaf*>;

    FlatLeaves() = default;
    /// @param seen  see ViewFrame::seen. @param flat  some of them.
    FlatLeaves(const Leaves& seen, const FlatReceivers& flat);
    /// @param seen  of the same drawables in the same order.
    const std::shared_ptr<const LeafSet>& in(const Leaves& seen);
    bool whole = false; ///< see FlatReceivers.

private:
    void take(const Leaves& seen);

    std::vector<std::size_t> _places; ///< among those that are seen.
    Leaves _leaves;                   ///< that stood there last.
    std::shared_ptr<const LeafSet> _set;
};

} // namespace gnomon
