// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Object>
#include <osg/UserDataContainer>
#include <osgUtil/RenderStage>

#include <atomic>

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

/// Whether anything could be composed when a stage was last drawn. Only draw can tell, and cull wants to know: the stage
/// keeps it, see keptBy().
class StageVerdict : public osg::Object {
public:
    StageVerdict() = default;
    StageVerdict(const StageVerdict& other, const osg::CopyOp& copyOp) : osg::Object(other, copyOp) {}
    META_Object(gnomon, StageVerdict)

    void refuse(bool refused) { _refused = refused; }
    bool isRefused() const { return _refused; }

protected:
    ~StageVerdict() override = default;

private:
    std::atomic<bool> _refused{false};
};

} // namespace gnomon
