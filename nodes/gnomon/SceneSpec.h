// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowSpec.h>

#include <osg/Node>
#include <osg/ref_ptr>

#include <string>
#include <vector>

namespace gnomon {

/// A whole scene's shadows, with what a bare model lacks for them: a sun, a ground. Written as one string.
///
/// The suffix ".(...).gnomon" of file names holds such a string. In C++ it saves lines in tools and first trials; take
/// ShadowSpec to add shadows to a scene that has its lights.
///
///     viewer.setSceneData(gnomon::shadowedScene(*model, gnomon::parseSceneSpec("map:edges=smooth+ground")));
///
/// Syntax: items with "+" between them, each NAME or NAME:key=value,key=value; ";" may stand for ",". The names are
/// those of the techniques; ground, with the key side; sun, with azimuth and elevation; and nosun. shadowSpecHelp() lists the
/// techniques' keys.
struct SceneSpec {
    std::vector<ShadowSpec> shadows; ///< Never empty after parseSceneSpec(): without a technique it is auto.
    bool hasGround = false;          ///< Puts a white ground under the scene, see makeGround().
    double groundSide = 0.0;         ///< Side of that ground, scene's unit. Default, 0: four times the scene's radius.
    /// Adds a sun if the scene has no light. It is light 0, in the place of a viewer's headlight. Default: true.
    bool addsSun = true;
    bool hasSun = false;         ///< Adds the sun even if the scene has a light.
    double sunAzimuth = 135.0;   ///< Azimuth of that sun, see sunAt(). Degrees. Default: south-east.
    double sunElevation = 45.0;  ///< Elevation of that sun, degrees.
};

/// Parses a string of items. An empty string stands for "auto".
/// @throws std::invalid_argument with one sentence that names the mistake and lists what is allowed.
GNOMON_EXPORT SceneSpec parseSceneSpec(const std::string& text);

/// Names of the items that are not techniques.
GNOMON_EXPORT std::vector<std::string> sceneParts();

/// Puts a scene under a new ShadowCasterGroup with the shadows, the sun and the ground of `spec`.
///
/// The scene's LightSources cast, or else the sun. It asks for stencil bits, and for alpha bits if edges may be smooth
/// or soft, for windows that are made later.
/// @throws std::invalid_argument with one sentence, as addShadows().
GNOMON_EXPORT osg::ref_ptr<ShadowCasterGroup> shadowedScene(osg::Node& scene, const SceneSpec& spec);

} // namespace gnomon
