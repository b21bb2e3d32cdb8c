// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Ground.h>

#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Node>
#include <osg/Vec3d>
#include <osg/Vec4d>

namespace gnomon {

/// One object on terrain, as the class of ARL-TN-156 takes it.
struct BoxShadowObject {
    osg::ref_ptr<osg::Node> graphic = {}; ///< The object. Each of its connected parts gets a box.
    osg::Vec3d position = {};             ///< Where it stands, frame of the terrain.
    double heading = 0.0;                 ///< Degrees, counter-clockwise from above.
    /// Bounds about the position, along the terrain's axes. Default: an invalid box, which stands for the object's own.
    osg::BoundingBoxd bounds = {};
};

/// Finds the shadow of one object by the bounding-box method, as plain geometry. The published class works like this.
///
/// It needs no ShadowCasterGroup, no stencil buffer and no second pass. Use TerrainShadowGeode for many objects, and for
/// shadows that darken a place once.
///
///     const auto ground = gnomon::groundOf(*terrain);
///     osg::ref_ptr<osg::Geode> shadow = new osg::Geode;
///     if (auto geometry = gnomon::boxShadow({house, {120.0, 80.0, 0.0}}, *ground, sun)) shadow->addDrawable(geometry);
///
/// @param terrain  see groundOf().
/// @param light    homogeneous, frame of the terrain: w = 0 is the direction towards a sun, w = 1 a lamp's position.
/// @return         12 triangles a connected part, counter-clockwise from above, black at half opacity, in the transparent
///                 bin. Null if there is no shadow: the light is below the horizon, or a ray or corner meets no terrain.
///
/// Limits
/// - It is wrong for objects whose outline differs from that of their box along the axes.
/// - It spans rough ground between its eleven points, and edges may sink into it. Overlaps darken twice.
/// - Vertices are floats about the terrain's origin.
/// Source
/// - ARL-TN-156, "Real-Time Shadows for Terrain Objects by the Bounding-Box Method".
GNOMON_EXPORT osg::ref_ptr<osg::Geometry> boxShadow(const BoxShadowObject& object, const Ground& terrain,
                                                    const osg::Vec4d& light);

} // namespace gnomon
