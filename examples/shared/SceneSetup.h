// SPDX-License-Identifier: MIT
#pragma once
#include "SceneLights.h"
#include "ViewOptions.h"

#include <gnomon/SceneProps.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>

#include <osg/BoundingBox>
#include <osg/Camera>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/Matrixd>

#include <memory>
#include <string>
#include <vector>

namespace gnomon::examples {

/// A scene ready to be viewed: lights, ShadowCasterGroup, ground and techniques as the options ask.
struct SceneSetup {
    osg::ref_ptr<osg::Group> root;
    osg::ref_ptr<ShadowCasterGroup> group;
    std::vector<osg::ref_ptr<ShadowTechnique>> techniques;
    std::unique_ptr<SceneLights> lights;
    osg::BoundingBoxd bounds; ///< of the files, without the ground put under them; world.
    /// Corners of what casts and of its shadow, which a camera without a place is to show; none: all of `bounds`. World.
    std::vector<osg::Vec3d> framed;
    std::optional<double> ground; ///< its lowest height; nullopt: there is none, or nobody asked for a floor. World.
    bool hasAddedGround = false;
    std::string note;     ///< what was added that nobody asked for; empty: nothing.
    std::string receiver; ///< for every shadow that names none itself.

    /// Adds ground, lights and shadows as the options ask, for the scene as it is now. @throws as setUpScene().
    void furnish(const ViewOptions& options);
    /// Puts these in the place of the shadows so far. @throws as setUpScene(); there are no shadows then.
    void cast(std::vector<ShadowSpec> specs);

    /// The same, but the group's composite stays.
    void castAsComposed(const std::vector<ShadowSpec>& specs);
    /// Relight instead of blend, blend instead of relight.
    void toggleComposite();
    bool blends() const { return group->getComposite() == ShadowCasterGroup::BLEND; }

    /// Colour of an added ground in the distance, which ends nowhere before a background of this colour. Without such a ground
    /// a grey as light as a white floor.
    osg::Vec3d farColour() const;
    /// Switches all shadows on or off.
    void show(bool shadows);
    /// What was added that nobody asked for, and what lowLight() says.
    std::vector<std::string> notes() const;
    /// That a light is where no shadow can fall on the ground; empty: all stand above it, or nothing casts.
    std::string lowLight() const;
    /// Whether anything was to cast a shadow.
    bool mayCast() const;
    /// Why shadows were missing in the last frame, all techniques; nothing where none was to cast. See ShadowTechnique::diagnose().
    std::vector<std::string> diagnose() const;
    /// The same for a text that is written in each frame, see ShadowTechnique::lastReport().
    std::vector<std::string> causes() const;
};

/// Why shadows were missing in the last frame: each cause once, whichever of these techniques names it.
std::vector<std::string> diagnoses(const std::vector<osg::ref_ptr<ShadowTechnique>>& techniques);

/// The scene below root and group, and nothing else yet.
SceneSetup groupScene(const ViewOptions& options, osg::Node& files);

/// @throws std::invalid_argument, one sentence, if a name is not in the scene or a specification does not suit it.
SceneSetup setUpScene(const ViewOptions& options, osg::Node& files);

/// Places a perspective camera as the options ask; without an eye so that what casts and its shadow fill the picture, seen
/// from the south-west and above.
/// @throws std::invalid_argument, one sentence.
void placeCamera(osg::Camera& camera, const ViewOptions& options, const SceneSetup& setup);

/// Where the camera is to stand and what it looks at.
struct Lookout {
    osg::Vec3d eye, center, up;
};
/// @throws std::invalid_argument, one sentence.
Lookout lookout(const ViewOptions& options, const SceneSetup& setup);

/// A camera of fixed near and far planes.
struct SceneCamera {
    osg::Matrixd view, projection;
    int width = 0, height = 0; ///< pixels.
    double fraction = 0.0;     ///< of a pixel, that its viewport has too many on each side; OpenGL leaves it out.
};

/// What a camera sees. Where it leaves near and far to OpenSceneGraph, they stand close around `bounds`, near never closer
/// than 1/2000 of far, as OpenSceneGraph itself has it.
SceneCamera sceneCamera(const osg::Camera& camera, int width, int height, const osg::BoundingBoxd& bounds);

} // namespace gnomon::examples
