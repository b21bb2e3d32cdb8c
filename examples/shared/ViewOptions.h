// SPDX-License-Identifier: MIT
#pragma once
#include "CommandLine.h"

#include <gnomon/ShadowSpec.h>
#include <gnomon/SunClock.h>

#include <osg/Vec3d>
#include <osg/Vec4d>

#include <optional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// The sun over a place at a moment.
struct SunMoment {
    SunClock clock;
    double day; ///< Julian, UTC.
};

/// How a scene without lights of its own is lit where no option says otherwise.
struct Lighting {
    double ambient;
    double diffuse; ///< of all lights together.
    double fill;    ///< see ViewOptions.
};

/// What the programs share: scene, lights, shadows and camera as the command line gives them.
struct ViewOptions {
    std::vector<std::string> files;
    std::vector<ShadowSpec> shadows;
    std::string usualShadow = "auto"; ///< specification that takeUsualShadow() takes.
    bool isUsual = false;           ///< the shadow is the usual one: files that hold techniques of their own need none.
    std::vector<osg::Vec4d> lights; ///< homogeneous, world.
    std::optional<SunMoment> sun;   ///< where one of them comes from.
    std::optional<osg::Vec3d> ambient; ///< red, green, blue, as are those below.
    std::optional<osg::Vec3d> diffuse;
    /// Diffuse part of a light that casts no shadow. It shines from the camera's side, 30 degrees high and at least 105 degrees
    /// from the first light, so that shapes stay visible in shadow.
    std::optional<osg::Vec3d> fill;
    std::optional<Lighting> lighting; ///< nullopt: OSG's, without fill.
    std::string receiver;             ///< for every shadow that names none itself.
    std::string casters = "all";      ///< all, none, or a node's name.
    std::string ground = "auto";      ///< auto, none, or the side's length.
    double groundRadii = 4.0;         ///< side of the ground that auto adds, in radii of the scene.
    bool yUp = false;
    bool keepLights = false; ///< no sun where there is no light, and lighting as the scene has it.
    std::optional<osg::Vec3d> eye;
    std::optional<osg::Vec3d> center;
    std::optional<osg::Vec3d> viewUp;
    double fovy = 40.0; ///< degrees, of the picture's height.
    /// Instead of a perspective: half of what the picture's height shows, and how far is seen before and behind the eye.
    std::optional<double> orthographic;
    std::optional<double> zNear;
    std::optional<double> zFar;
    std::optional<osg::Vec3d> background =
        osg::Vec3d(0.2, 0.2, 0.4); ///< nullopt: as an added ground is in the distance.
    int width = 800, height = 600; ///< of the picture, pixels.
    int samples = 1;               ///< a pixel.
    bool needsSamples = false;     ///< they were asked for: a window that has fewer is not to be opened.
};

/// Options of programs whose pictures people look at: soft light, and a ground that ends nowhere. Programs that measure keep
/// OSG's light and a small ground, so that their figures stay comparable.
ViewOptions pictureOptions(int samples);

/// The options of `into`, as a table.
Options viewOptions(ViewOptions& into);

/// "x,y,z,w", a direction or a place. @param most  magnitude of a number. @throws std::invalid_argument, "allowed: …".
osg::Vec4d readLight(const std::string& text, double most = largestNumber);

/// Those of shadows, and those of lights, alone.
void addShadowOptions(Options& table, ViewOptions& into);
void addLightOptions(Options& table, ViewOptions& into);

/// Adds the option of the picture's size.
void addSize(Options& table, ViewOptions& into);

/// Takes what is left of the command line as scene files, if anything. @throws std::invalid_argument if something is an
/// option.
void takeFiles(osg::ArgumentParser& arguments, ViewOptions& into);
/// Takes the usual shadow where none is given.
void takeUsualShadow(ViewOptions& into);

/// Reads the command line of a program that shows scene files, of which one is needed.
/// @param table  its options, those of `into` among them. @param help  of the table: nothing more is read then.
/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
void readViewOptions(osg::ArgumentParser& arguments, const Options& table, ViewOptions& into, const bool& help);

/// Names of several specifications, "none" without any.
std::string techniqueNames(const std::vector<ShadowSpec>& specs);

/// What one option alone cannot tell. @throws std::invalid_argument, one sentence.
void requireConsistent(const ViewOptions& options);

} // namespace gnomon::examples
