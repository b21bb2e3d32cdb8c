// SPDX-License-Identifier: MIT
#include <gnomon/compositor/MarkJob.h>

namespace gnomon {

bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b) {
    for (int row = 0; row < 4; ++row)
        for (const int column : {0, 1, 3})
            if (a(row, column) != b(row, column)) return false;
    return true;
}

const SoftMarkJob* ShadowJob::softMarks() const { return dynamic_cast<const SoftMarkJob*>(marks.get()); }

const ProgramVisibilityJob* ShadowJob::programMarks() const {
    return dynamic_cast<const ProgramVisibilityJob*>(marks.get());
}

bool ShadowJob::isReceiver(const osgUtil::RenderLeaf& leaf) const {
    return receiverNamed ? isNamed(&leaf) : isOfView(leaf);
}

} // namespace gnomon
