// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Matrixd>
#include <osgUtil/RenderLeaf>

#include <set>

namespace gnomon {

class ShadowCasterGroup;

/// One view in one frame, as a technique sees it after cull. OSG's convention: row vectors, eye = group * eyeFromGroup.
struct ViewFrame {
    osg::Matrixd eyeFromGroup;       ///< modelview of the ShadowCasterGroup.
    osg::Matrixd groupFromTechnique; ///< identity unless a transform stands between group and technique.
    osg::Matrixd projection;         ///< as drawn, near and far included.
    const ShadowCasterGroup* group = nullptr;
    float dark = 0.5f; ///< of the ShadowCasterGroup.
    unsigned frameNumber = 0;
    const std::set<const osgUtil::RenderLeaf*>* receivers =
        nullptr; ///< leaves of the named receiver; null if none is named.
};

} // namespace gnomon
