// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/CompositorOptions.h>

#include <osg/Group>

#include <string>
#include <vector>

namespace osgUtil {
class CullVisitor;
}

namespace gnomon {

class FrameDiagnosis;
class ViewEffect;

/// A group that draws its children as ever and, once more, something made of them, by the ShadowBin of each view.
class GNOMON_EXPORT EffectNode : public osg::Group {
public:
    EffectNode();
    EffectNode(const EffectNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);

    /// What the compositor of the view may use; see CompositorOptions for several nodes in one view.
    void setCompositorOptions(const CompositorOptions& options) { _options = options; }
    const CompositorOptions& getCompositorOptions() const { return _options; }

    /// Why what this is for was missing in the last frame, over all its views: one sentence a cause, with the node and
    /// the remedy. Empty if all is well.
    std::vector<std::string> diagnose() const;
    /// Notes a cause for diagnose(); repeated causes count once. Called in cull or draw.
    void report(unsigned frame, const std::string& cause) const;

    void traverse(osg::NodeVisitor& visitor) override;

protected:
    ~EffectNode() override;

    /// What to draw in this view; null if nothing. @param cull  stands at this node, its children have been culled.
    virtual osg::ref_ptr<ViewEffect> makeEffect(osgUtil::CullVisitor& cull) = 0;

private:
    void enlist(osgUtil::CullVisitor& cull);

    CompositorOptions _options;
    const osg::ref_ptr<FrameDiagnosis> _diagnosis;
};

} // namespace gnomon
