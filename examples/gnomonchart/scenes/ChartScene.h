// SPDX-License-Identifier: MIT
#pragma once
#include "SceneTruth.h"

#include <osg/Group>
#include <osg/Vec4d>

#include <string>

namespace gnomon::examples {

/// What every contender draws: one scene, one light, one camera.
struct ChartScene {
    std::string name;                 ///< for file names and --scene: a-z, 0-9 and "-".
    std::string title;                ///< for people.
    osg::ref_ptr<osg::Group> content; ///< what is seen and casts; z up; holds no light.
    osg::Vec4d light;                 ///< homogeneous, world: w = 0 the way towards a sun, w = 1 a lamp's position.
    SceneCamera camera;               ///< of the still pictures; its near and far planes are fixed.
    std::string receiver;             ///< name of the flat node that planar shadows fall on; empty: there is none.
    double radius = 1.0;              ///< of the scene's bounds without its ground, scene's unit.
};

/// The camera moved on by `step` degrees about the vertical through what it looks at; the light turned likewise.
SceneCamera movedCamera(const ChartScene& scene, double step);
osg::Vec4d movedLight(const ChartScene& scene, double step);

} // namespace gnomon::examples
