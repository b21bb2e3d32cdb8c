// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowLight.h>

#include <osg/Matrixd>
#include <osgUtil/RenderStage>

#include <string>
#include <vector>

namespace gnomon {

/// Lights whose shadow a group wants in one view, in the order of their numbers; and why there are none, or fewer.
struct GroupLights {
    std::vector<ShadowLight> lights;
    std::vector<std::string> causes;
};

/// After the whole cull: the lights set on the group, or else those that are on in the stage (LightSources wherever
/// they stand, the viewer's headlight too).
GroupLights lightsOf(const ShadowCasterGroup& group, const osg::Matrixd& eyeFromGroup, osgUtil::RenderStage& stage);

} // namespace gnomon
