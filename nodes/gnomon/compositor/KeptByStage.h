// SPDX-License-Identifier: MIT
#pragma once
#include <osg/UserDataContainer>
#include <osgUtil/RenderStage>

namespace gnomon {

/// What a stage keeps from frame to frame, among its user objects: one of each class, made if it has none.
template <class Kept>
Kept& keptBy(osgUtil::RenderStage& stage) {
    osg::UserDataContainer& all = *stage.getOrCreateUserDataContainer();
    for (unsigned i = 0; i < all.getNumUserObjects(); ++i)
        if (auto* known = dynamic_cast<Kept*>(all.getUserObject(i))) return *known;
    const osg::ref_ptr<Kept> fresh = new Kept;
    all.addUserObject(fresh);
    return *fresh;
}

} // namespace gnomon
