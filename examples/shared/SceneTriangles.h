// SPDX-License-Identifier: MIT
#pragma once
#include "Cutout.h"

#include <osg/Node>
#include <osg/Vec3d>

#include <vector>

namespace gnomon::examples {

/// A scene's triangles as its truth sees them: world, double, each with the object it is of. Shares no code with
/// VertexTraverser, which the techniques use, so that an error of one is seen by the other.
struct SceneTriangles {
    /// A drawable under one way down to it.
    struct Object {
        std::optional<Cutout> cutout;
    };

    std::vector<osg::Vec3d> vertices;
    std::vector<osg::Vec2d> texcoords; ///< of unit 0, a vertex each; (0, 0) where a drawable has none.
    std::vector<unsigned> indices;     ///< three a triangle.
    std::vector<unsigned> object;      ///< a triangle each: its place in `objects`.
    std::vector<Object> objects;

    std::size_t count() const { return object.size(); }
    /// Whether a triangle is there at weights u and v of its second and third corner.
    bool solidAt(unsigned triangle, double u, double v) const;
    bool hasCutouts() const;
    /// Scene's unit.
    double longestEdge(unsigned triangle) const;
};

/// What is in a scene besides what hides all behind it.
enum class Clear {
    HIDES, ///< what blends counts as solid.
    PASSES ///< texels that blend with an alpha below one half are not there.
};

/// What is switched on is taken, of an LOD its nearest range; other cameras' subgraphs, projections, text, points and
/// lines are not.
/// Limits  billboards stand as they are modelled, and what a vertex program moves stays.
SceneTriangles sceneTriangles(osg::Node& scene, Clear clear = Clear::HIDES);

} // namespace gnomon::examples
