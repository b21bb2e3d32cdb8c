// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LightUniform.h>
#include <gnomon/base/FrameReport.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/MarkJob.h>

#include <osgUtil/RenderLeaf>

#include <memory>
#include <string>
#include <vector>

namespace gnomon {

class ProgramVisibilityJob;
class SoftMarkJob;

/// True if two views have the same lens: the same but for near and far, which a nested camera finds for itself.
bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b);

/// A technique's job for one light in one view, and how its marks are to be used.
struct ShadowJob {
    osg::ref_ptr<const MarkJob> marks;
    FrameReport report;  ///< for the technique.
    int light = 0;       ///< OpenGL light number.
    bool relight = true; ///< else blended.
    float dark = 1.0f;
    osg::ref_ptr<const osg::RefMatrix> projection; ///< of the technique's view.
    bool receiverNamed = false;
    std::shared_ptr<const LeafSet> receivers; ///< the leaves of the named receiver, for all jobs; null: none is named.
    bool hidingOnly = false; ///< a receiver loses the light only where it hides what is behind, see LateReceivers.
    std::vector<LightUniform> lightUniforms; ///< of the group.

    /// True if the leaf is of the named receiver.
    bool isNamed(const osgUtil::RenderLeaf* leaf) const { return receivers && receivers->count(leaf) > 0; }
    /// The marks, if their edges are soft; else null.
    const SoftMarkJob* softMarks() const;
    /// The job, if it is for programs alone; else null.
    const ProgramVisibilityJob* programMarks() const;
    /// True if the leaf loses the light where marked: it is of the named receiver, or with none named, of this view.
    bool isReceiver(const osgUtil::RenderLeaf& leaf) const;
    /// True if the leaf is seen through the technique's lens, unlike what a nested camera lays over the view.
    bool isOfView(const osgUtil::RenderLeaf& leaf) const { return isOfView(projectionOf(leaf)); }
    bool isOfView(const osg::Matrixd& lens) const { return isSameLens(lens, *projection); }
};

} // namespace gnomon
