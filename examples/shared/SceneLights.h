// SPDX-License-Identifier: MIT
#pragma once
#include "ViewOptions.h"

#include <gnomon/SceneProps.h>
#include <gnomon/ShadowCasterGroup.h>

#include <osg/Group>
#include <osg/MatrixTransform>

#include <optional>
#include <vector>

namespace gnomon::examples {

constexpr double framingAzimuth = 215.0; ///< degrees, of a camera without a place, seen from the scene.

/// Puts a light, which shines from below `mount`, at a homogeneous place of the world: a lamp at the origin of its mount,
/// which is in double; a sun's direction needs no more than float.
void standLight(osg::MatrixTransform& mount, osg::Light& light, const osg::Vec4d& place);

/// The lights of a program: those of the command line, or a sun if neither it nor the scene has one; and the scene's
/// own. Lamps stand in double precision, so that they may be far from the origin.
class SceneLights {
public:
    /// Adds LightSources to `root`, which must be above `group` without a transform between, and tells `group` of all
    /// lights. @param centre  of the scene, world.
    SceneLights(const ViewOptions& options, osg::Group& root, ShadowCasterGroup& group, const osg::Vec3d& centre);

    /// Switches the scene's own lights on for a node beside the scene, which may have them on for itself only.
    void shineOn(osg::Node& node) const;

    /// Way from a point to a light. Degrees; azimuth from north = +y through east = +x, elevation from level.
    struct Direction {
        double azimuth, elevation;
    };
    /// Of the first of the program's own lights, as it was given; nullopt if all are the scene's.
    std::optional<Direction> given(const osg::Vec3d& seenFrom) const;
    /// Stands the program's own lights elsewhere than they were given: turned about the vertical through `centre`,
    /// degrees, clockwise from above, and raised, degrees.
    void move(const Direction& by, const osg::Vec3d& centre);

    /// Turns the program's own lights to this angle about up, from where they were given. Degrees, anticlockwise from
    /// above.
    void turn(double degrees);

    std::size_t count() const { return _own.size() + _scene.size(); }
    /// Where all of them that cast shadows are now, homogeneous, world.
    std::vector<osg::Vec4d> places() const;
    /// Colour of a white level ground, 0 to 1. @param at  where; nullopt: in the distance, where lamps do not light it.
    osg::Vec3d groundColour(const std::optional<osg::Vec3d>& at) const;

private:
    struct Own {
        osg::Vec4d given, place; ///< place: where it is now.
        osg::ref_ptr<osg::MatrixTransform> mount;
        osg::ref_ptr<osg::LightSource> source;
    };

    void add(const osg::Vec4d& place, osg::Group& root);
    void addFill(const osg::Vec3d& diffuse, osg::Group& root);
    void standFill(const osg::Vec3d& centre);
    int freeNumber() const;
    void colour(const ViewOptions& options, osg::Group& root);
    void tellGroup();

    osg::ref_ptr<ShadowCasterGroup> _group;
    std::vector<Own> _own;
    std::vector<osg::ref_ptr<osg::LightSource>> _scene;
    osg::ref_ptr<osg::LightSource> _fill; ///< null: there is none. Casts no shadow.
    const double _viewAzimuth;            ///< degrees, of the camera as it first stands, seen from what it looks at.
    osg::Vec3d _ambient{0.1, 0.1, 0.1};   ///< of the scene as a whole; OSG's without an option.
};

} // namespace gnomon::examples
