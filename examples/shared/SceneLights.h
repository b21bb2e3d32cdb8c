// SPDX-License-Identifier: MIT
#pragma once
#include "ViewOptions.h"

#include <gnomon/ShadowCasterGroup.h>

#include <osg/Group>
#include <osg/MatrixTransform>

#include <vector>

namespace gnomon::examples {

/// The lights of a program: those of the command line, or a sun if neither it nor the scene has one; and the scene's
/// own. Lamps stand in double precision, so that they may be far from the origin.
class SceneLights {
public:
    /// Adds LightSources to `root`, which must be above `group` without a transform between, and tells `group` of all
    /// lights.
    SceneLights(const ViewOptions& options, osg::Group& root, ShadowCasterGroup& group);

    /// Turns the program's own lights to this angle about up, from where they were given. Degrees, anticlockwise from
    /// above.
    void turn(double degrees);

    std::size_t count() const { return _own.size() + _scene.size(); }

private:
    struct Own {
        osg::Vec4d place;
        osg::ref_ptr<osg::MatrixTransform> mount;
        osg::ref_ptr<osg::LightSource> source;
    };

    void add(const osg::Vec4d& place, osg::Group& root);
    int freeNumber() const;
    void colour(const ViewOptions& options);
    void tellGroup(const osg::Matrixd& turned);

    osg::ref_ptr<ShadowCasterGroup> _group;
    std::vector<Own> _own;
    std::vector<osg::ref_ptr<osg::LightSource>> _scene;
};

} // namespace gnomon::examples
