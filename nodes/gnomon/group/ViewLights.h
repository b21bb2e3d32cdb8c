// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/casters/Casting.h>

#include <osg/Matrixd>
#include <osgUtil/RenderStage>

#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// Lights whose shadow a group wants in one view, in the order of their numbers; and why there are none, or fewer.
struct GroupLights {
    std::vector<ShadowLight> lights;
    std::vector<std::string> causes;
    /// The most that each light can give to a channel of a colour, by its number. Lights of which that is not known are
    /// missing.
    std::map<int, double> strengths;
};

/// After the whole cull: the lights set on the group, or else those that are on in the stage (LightSources wherever
/// they stand, the viewer's headlight too).
GroupLights lightsOf(const ShadowCasterGroup& group, const osg::Matrixd& eyeFromGroup, osgUtil::RenderStage& stage);

/// After the whole cull: the clip planes of the ClipNodes of a stage, in the group's frame.
/// @param all  false: not those of a nested camera's own stage, nor those in the eye's frame.
std::vector<NumberedPlane> clipPlanesOf(osgUtil::RenderStage& stage, const osg::Matrixd& eyeFromGroup, bool all);

} // namespace gnomon
