// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/base/FrameReport.h>
#include <gnomon/compositor/DrawnLeaves.h>

#include <set>
#include <vector>

namespace gnomon {

using Leaves = std::vector<const osgUtil::RenderLeaf*>;

/// What the programs of one view do that shadows cannot follow, for diagnose(). Asked for once a view.
///
/// Cost    a look at each state's program, and once at each program's text.
class ProgramCauses {
public:
    ProgramCauses() = default;
    explicit ProgramCauses(osgUtil::RenderStage& stage);

    /// For a technique of this group with these receivers.
    void report(const FrameReport& report, const ShadowCasterGroup& group, const Leaves& receiving,
                const Leaves& receivingLate) const;

    /// True if the leaf's program moves its vertices, so that it is not where its box is.
    bool moves(const osgUtil::RenderLeaf& leaf) const;

private:
    std::vector<DrawnLeaf> _moving;                  ///< Their program moves vertices.
    std::set<const osgUtil::RenderLeaf*> _ownDepths; ///< Their program sets a depth of its own.
    osg::Matrixd _eyeFromWorld;
};

} // namespace gnomon
