// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"
#include "ViewOptions.h"

#include <osg/BoundingBox>
#include <osg/Group>
#include <osg/Vec4d>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// What every contender draws: one scene, one light, one camera.
struct ChartScene {
    std::string name;                 ///< for --scene a-z, 0-9 and "-"; of files of the user's own any text.
    std::string title;                ///< for people.
    osg::ref_ptr<osg::Group> content; ///< what is seen and casts; z up; holds no light.
    osg::Vec4d light;                 ///< homogeneous, world: w = 0 the way towards a sun, w = 1 a lamp's position.
    SceneCamera camera;               ///< of the still pictures; its near and far planes are fixed.
    std::string receiver;             ///< name of the flat node that planar shadows fall on; empty: there is none.
    std::string terrain;              ///< name of the node that box and hull fall on; empty: there is none.
    std::string round;                ///< name of a body as metrics::teeth() judges it; empty: there is none.
    osg::BoundingBoxd bounds;         ///< of the content, world.
    osg::Vec3d center;                ///< what the camera looks at, world.
    double radius = 1.0;              ///< of the scene's bounds without its ground, scene's unit.
    int framesBefore = 0;             ///< that are drawn before what is measured: until then vertices change.
    /// Puts all that a contender draws below or beside more: a camera, a backdrop. Empty: nothing.
    std::function<osg::ref_ptr<osg::Node>(osg::Node& root)> around;
};

/// Name of state sets whose program moves vertices and shades by OpenGL's light: it stays where the scene is drawn white.
constexpr const char* movingState = "moving";

/// The camera moved on by `step` degrees about the vertical through what it looks at; the light turned likewise. Near and
/// far follow the scene's bounds.
SceneCamera movedCamera(const ChartScene& scene, double step);
osg::Vec4d movedLight(const ChartScene& scene, double step);

/// Files of the user's own, set up as gnomonshot does: ground, light and camera as the options ask or by default. Lights
/// of the files' own shine no more; the first of them is taken where the options give none. What animates takes the pose of the
/// clock's zero and stands still from now on.
/// @throws std::invalid_argument, one sentence, see setUpScene() and placeCamera().
ChartScene chartSceneOf(osg::Node& files, const ViewOptions& options);

/// The scenes that are built in, in the chart's order.
std::vector<std::string> chartSceneNames();
/// @param width,height  of the picture, pixels.
/// @throws std::invalid_argument, one sentence with all names, for another name; std::runtime_error if its model is not
/// installed.
ChartScene chartScene(const std::string& name, int width, int height);

} // namespace gnomon::examples
