// SPDX-License-Identifier: MIT
#include <gnomon/compositor/StageVerdict.h>

#include <osg/UserDataContainer>

namespace gnomon {

StageVerdict& StageVerdict::of(osgUtil::RenderStage& stage) {
    osg::UserDataContainer& kept = *stage.getOrCreateUserDataContainer();
    for (unsigned i = 0; i < kept.getNumUserObjects(); ++i)
        if (auto* verdict = dynamic_cast<StageVerdict*>(kept.getUserObject(i))) return *verdict;
    const osg::ref_ptr<StageVerdict> fresh = new StageVerdict;
    kept.addUserObject(fresh);
    return *fresh;
}

} // namespace gnomon
