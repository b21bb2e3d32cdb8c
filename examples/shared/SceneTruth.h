// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"
#include "SceneTriangles.h"

#include <metrics/PixelSets.h>

#include <osg/Node>
#include <osg/Vec4d>
#include <osg/ref_ptr>

#include <memory>

namespace gnomon::examples {

/// What is true of a scene: rays at its triangles, each object (a drawable under one way down to it) with an id, and
/// what OpenGL draws where. Texels that fail an alpha test are not there: they neither are seen nor block.
///
/// Cost    making it: a tree over the triangles, about 1 µs each; maps(): 34 rays a pixel, and two small frames.
/// Needs   a HeadlessContext of its own, which it makes.
class SceneTruth {
public:
    /// @param scene  world; everything in it casts. Kept.
    /// @throws std::runtime_error, one sentence, if it has no triangles, see RayScene and HeadlessContext.
    explicit SceneTruth(osg::Node& scene, Clear clear = Clear::HIDES);
    ~SceneTruth();

    /// All maps but litByDisc. Positions are about origin(). @param light  homogeneous, world.
    metrics::TruthMaps maps(const SceneCamera& camera, const osg::Vec4d& light) const;
    /// T_a of a sun 0.533 degrees across.
    metrics::Picture litByDisc(const SceneCamera& camera, const osg::Vec4d& light) const;

    /// Where a body is seen and nothing else casts on it, nor within 2 px: 1; else 0.
    /// @param body  a node of the scene.
    metrics::Mask alone(const SceneCamera& camera, const osg::Vec4d& light, const osg::Node& body) const;

    osg::Vec3d origin() const;
    std::size_t triangles() const;

private:
    struct Parts;
    std::unique_ptr<Parts> _parts;
};

} // namespace gnomon::examples
