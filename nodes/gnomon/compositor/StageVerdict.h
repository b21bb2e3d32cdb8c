// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Object>

#include <atomic>

namespace gnomon {

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
