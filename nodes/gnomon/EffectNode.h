// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CompositorOptions.h>
#include <gnomon/Export.h>

#include <osg/Group>

#include <string>
#include <vector>

namespace osgUtil {
class CullVisitor;
}

namespace gnomon {

class FrameDiagnosis;
class ViewEffect;
struct FrameReport;

/// Base class of groups that draw an effect of their children, as HaloNode and PlanarReflectionNode do.
///
/// A new effect derives from it inside Gnomon. The children are drawn as usual. The compositor of each view draws the effect.
class GNOMON_EXPORT EffectNode : public osg::Group {
public:
    /// A group without children.
    EffectNode();
    /// Copies the group.
    EffectNode(const EffectNode& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);

    /// Limits of the view's compositor. See CompositorOptions for several nodes in one view. Default: none.
    void setCompositorOptions(const CompositorOptions& options) { _options = options; }
    /// See setCompositorOptions().
    const CompositorOptions& getCompositorOptions() const { return _options; }

    /// Says why the effect was missing in the last frame, in any view.
    /// A program that never calls it gets each cause once, by osg::notify() at WARN.
    /// @return one sentence a cause, with the node and the remedy; empty if all is well.
    std::vector<std::string> diagnose() const;
    /// Adds a cause to diagnose(). Repeated causes count once. Call it in cull or draw.
    /// @param cause  the end of a sentence that begins with class and name.
    void report(unsigned frame, const std::string& cause) const;

    /// A reporter for one frame, for effects, which outlive the frame's cull. It does as report().
    FrameReport reportIn(unsigned frame) const;

    /// Traverses the children. In a cull traversal it registers the effect with the compositor, too.
    void traverse(osg::NodeVisitor& visitor) override;
    /// Traverses the parents, but not for osgUtil::Optimizer.
    void ascend(osg::NodeVisitor& visitor) override;

protected:
    ~EffectNode() override;

    /// Makes the effect for one view.
    /// @param cull  the cull traversal at this node, after its children.
    /// @return      null if there is nothing to draw.
    virtual osg::ref_ptr<ViewEffect> makeEffect(osgUtil::CullVisitor& cull) = 0;

private:
    void enlist(osgUtil::CullVisitor& cull);

    CompositorOptions _options;
    const osg::ref_ptr<FrameDiagnosis> _diagnosis;
};

} // namespace gnomon
