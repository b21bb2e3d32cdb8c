// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/base/ProgramText.h>
#include <gnomon/casters/Caster.h>
#include <gnomon/casters/Casting.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/LateReceivers.h>
#include <gnomon/compositor/ResolvedState.h>

#include <osg/Matrixd>
#include <osg/Vec3>
#include <osg/ref_ptr>
#include <osgUtil/StateGraph>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace gnomon {

/// A technique met in the cull of one stage, and what it needs to know of the view.
struct EnlistedTechnique {
    osg::ref_ptr<const ShadowTechnique> technique;
    osg::ref_ptr<const ShadowCasterGroup> group;
    osg::Matrixd eyeFromGroup;
    osg::Matrixd groupFromTechnique;
    osg::ref_ptr<osg::RefMatrix> projection;    ///< shared with the leaves: near and far are set in it after the cull.
    osg::Vec3 viewPoint;                        ///< eye space, see CasterView.
    float lodScale = 1.0f;                      ///< of the cull.
    osg::Node::NodeMask mask = ~0u;             ///< the same, see CasterView.
    const osgUtil::StateGraph* state = nullptr; ///< that it was met in; valid as long as the stage's leaves.
    unsigned frameNumber = 0;
    double frameTime = 0.0; ///< seconds, see timeOf().

    /// A cause for its diagnose().
    void report(const std::string& cause) const { technique->report(frameNumber, cause); }
};

/// What a technique's prepare() is told of the view, but for its receivers.
ViewFrame viewOf(const EnlistedTechnique& entry, const osg::Viewport& viewport);

using Leaves = std::vector<const osgUtil::RenderLeaf*>;

/// The programs of one view: which casters it draws where their arrays stand, which leaves are moved; and for diagnose() what
/// shadows cannot follow. Asked for once a view.
///
/// Cost    a look at each state's program, and once at each program's text. standing(): the leaves are sorted once, where those of
///         casters are in another order.
class ViewPrograms {
public:
    ViewPrograms() = default;
    explicit ViewPrograms(osgUtil::RenderStage& stage);

    /// Where the view has leaves whose vertices, depth and fragments are those that their arrays give: their depth stands, then,
    /// and hides what is behind them. What a cull or a draw callback, an occluder or small feature culling leaves out, does
    /// not.
    const DrawablePlaces& standing(const osg::Matrixd& projection) const;
    /// Stands for what standing() is made of: all leaves, where they are, and whether they count.
    std::uint64_t standingValue() const;

    /// For a technique of this group with these receivers.
    void report(const EnlistedTechnique& entry, const Leaves& receiving, const Leaves& receivingLate) const;

    /// View matrix of the camera that draws the leaves.
    const osg::Matrixd& eyeFromWorld() const { return _eyeFromWorld; }

    /// True if the leaf's program moves its vertices, so that it is not where its box is.
    bool moves(const osgUtil::RenderLeaf& leaf) const { return _moved && _moved->count(&leaf) > 0; }
    /// All such leaves; null if there are none.
    const std::shared_ptr<const LeafSet>& moved() const { return _moved; }

private:
    void reportMoved(const EnlistedTechnique& entry) const;
    std::string firstUnseen(const ShadowCasterGroup& group, const Leaves& receiving, const Leaves& receivingLate) const;

    std::vector<DrawnLeaf> _moving;                  ///< Their program moves vertices.
    std::vector<DrawnLeaf> _unseen;                  ///< Their program is not known.
    std::shared_ptr<const LeafSet> _moved;           ///< Both, to be asked for by address.
    std::set<const osgUtil::RenderLeaf*> _setDepths; ///< Their program sets a depth of its own.
    osg::Matrixd _eyeFromWorld;

    void findStanding(const osg::Matrixd& projection) const;

    std::vector<DrawnLeaf> _all;
    mutable std::optional<DrawablePlaces> _standing;     ///< Of what is drawn as its arrays stand, once asked for,
    mutable osg::Matrixd _lens;                          ///< by this lens.
    mutable std::optional<std::uint64_t> _standingValue; ///< once asked for.
};

/// What one stage draws, as its ShadowBin of number `number` sees it after the cull.
struct StageLeaves {
    /// @param all  false: those that are drawn before the bin are enough.
    StageLeaves(osgUtil::RenderStage& stage, int number, bool all)
        : early(leavesBelow(stage, number)), late(all ? lateReceivers(stage, number) : LateReceivers()) {
        if (!all) return;
        programs = ViewPrograms(stage);
        for (const auto* leaves : {&early, &late.leaves}) findDisplaced(*leaves);
    }

    std::vector<DrawnLeaf> early; ///< before the bin.
    LateReceivers late;
    ViewPrograms programs;
    std::map<const osgUtil::RenderLeaf*, DepthPlacement> displaced; ///< those whose depths are not the projection's.

private:
    void findDisplaced(const std::vector<DrawnLeaf>& leaves) {
        const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
        DepthPlacement placement;
        for (const DrawnLeaf& entry : leaves) {
            if (entry.leaf->_parent != graph) placement = depthPlacementOf(graph = entry.leaf->_parent);
            if (!placement.isPlain()) displaced[entry.leaf] = placement;
        }
    }
};

/// A technique in the stage that it was met in.
struct TechniqueInStage {
    const EnlistedTechnique& entry;
    const std::vector<EnlistedTechnique>& all; ///< that were met there.
    const StageLeaves& drawn;
    osgUtil::RenderStage& stage;
};

/// Those of the leaves that receive from a technique, as its lens sees them: its named receiver's, or all.
Leaves receivingOf(const EnlistedTechnique& entry, const std::vector<DrawnLeaf>& leaves, osgUtil::RenderStage& stage);

/// What a technique receives with in one view.
struct Receiving {
    Leaves early; ///< before the bin.
    Leaves late;
};

} // namespace gnomon
