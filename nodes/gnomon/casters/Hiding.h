// SPDX-License-Identifier: MIT
#pragma once
#include <osg/StateAttribute>
#include <osg/StateSet>

namespace gnomon {

/// Which sides of a caster's triangles hide what is behind them, in a view that draws it: their depth stands then.
enum class Hiding {
    Both,
    Fronts, ///< Back faces are culled.
    Neither ///< One sees through both, somewhere at least, or that is not known.
};

/// What decides that, as the state sets on a path leave it by OpenSceneGraph's rules of inheritance.
///
/// Something sees through what is drawn late and blends, has an alpha test, a clip plane, a stipple, a program that discards,
/// lines in place of triangles, or no plain depth; and through the culled side of a face.
class HidingState {
public:
    /// From the outermost set on.
    void apply(const osg::StateSet& set);
    /// @param mirrored  the drawable's frame turns triangles round, but OpenGL's sense of front and back stays.
    Hiding hiding(bool mirrored) const;

private:
    using Value = osg::StateAttribute::GLModeValue;
    using Attribute = osg::StateSet::RefAttributePair;

    Value _blend = 0, _alphaTest = 0, _cull = 0, _stipple = 0, _depthTest = osg::StateAttribute::ON;
    Value _clip[6] = {};
    bool _late = false; ///< drawn in bin 8 or later.
    bool _discards = false;
    const Attribute *_face = nullptr, *_front = nullptr, *_polygons = nullptr, *_depth = nullptr, *_program = nullptr;
};

} // namespace gnomon
