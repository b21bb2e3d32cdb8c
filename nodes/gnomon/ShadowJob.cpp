// SPDX-License-Identifier: MIT
#include <gnomon/ProgramJob.h>
#include <gnomon/ShadowJob.h>
#include <gnomon/SoftMarkJob.h>

namespace gnomon {

bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b) {
    for (int row = 0; row < 4; ++row)
        for (const int column : {0, 1, 3})
            if (a(row, column) != b(row, column)) return false;
    return true;
}

const SoftMarkJob* ShadowJob::softMarks() const { return dynamic_cast<const SoftMarkJob*>(marks.get()); }

const ProgramJob* ShadowJob::programMarks() const { return dynamic_cast<const ProgramJob*>(marks.get()); }

bool ShadowJob::isReceiver(const osgUtil::RenderLeaf& leaf) const {
    return receiverNamed ? receivers.count(&leaf) > 0 : isOfView(leaf);
}

} // namespace gnomon
