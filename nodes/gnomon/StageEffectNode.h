// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/FrameCauses.h>

#include <osg/Group>

#include <string>
#include <vector>

namespace osgUtil {
class CullVisitor;
}

namespace gnomon {

class StageEffect;

/// A group that draws its children as ever and, once more, something made of them, by the ShadowBin of each view.
class GNOMON_EXPORT StageEffectNode : public osg::Group {
public:
    StageEffectNode() = default;
    StageEffectNode(const StageEffectNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osg::Group(other, copyOp) {}

    /// Why what this is for was missing in the last frame, over all its views: one sentence a cause, with the node and
    /// the remedy. Empty if all is well.
    std::vector<std::string> diagnose() const { return _causes.all(); }
    /// Notes a cause for diagnose(); repeated causes count once. Called in cull or draw.
    void report(unsigned frame, const std::string& cause) const;

    void traverse(osg::NodeVisitor& visitor) override;

protected:
    ~StageEffectNode() override = default;

    /// What to draw in this view; null if nothing. @param cull  stands at this node, its children have been culled.
    virtual osg::ref_ptr<StageEffect> makeEffect(osgUtil::CullVisitor& cull) = 0;

private:
    void enlist(osgUtil::CullVisitor& cull);

    mutable FrameCauses _causes;
};

} // namespace gnomon
