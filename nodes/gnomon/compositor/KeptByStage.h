// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Object>
#include <osg/UserDataContainer>
#include <osgUtil/RenderStage>

#include <atomic>
#include <thread>

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

/// What the draw of a stage tells its later culls: the stage keeps it, see keptBy().
class StageVerdict : public osg::Object {
public:
    StageVerdict() = default;
    StageVerdict(const StageVerdict& other, const osg::CopyOp& copyOp) : osg::Object(other, copyOp) {}
    META_Object(gnomon, StageVerdict)

    /// Whether nothing could be composed when the stage was last drawn. Only draw can tell.
    void refuse(bool refused) { _refused = refused; }
    bool isRefused() const { return _refused; }

    /// Draw: true if the scene graph may be read for a leaf's name: the frame is held, or one thread culls and draws it. Else the
    /// stage's next frame is held for it.
    bool askToName() {
        _wantsNames = true;
        return _isHeld || _culls == std::this_thread::get_id();
    }
    /// Cull: whether the next frame's update waits for the draw of this one. @param needed  for other reasons.
    bool hold(bool needed) {
        _culls = std::this_thread::get_id();
        const bool wanted = _wantsNames.exchange(false);
        return _isHeld = needed || wanted;
    }

protected:
    ~StageVerdict() override = default;

private:
    std::atomic<bool> _refused{false}, _isHeld{true}, _wantsNames{true};
    std::atomic<std::thread::id> _culls{};
};

} // namespace gnomon
