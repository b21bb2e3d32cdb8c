// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/compositor/DrawnLeaves.h>

#include <osg/Referenced>
#include <osgUtil/RenderStage>

#include <vector>

namespace gnomon {

class CompositorStage;

/// What one node has drawn into one view besides shadows, by the view's ShadowBin.
class ViewEffect : public osg::Referenced {
public:
    /// When among the others it is drawn: shadows that relight come first.
    enum class Turn {
        BeforeBlending, ///< shadows that blend darken it.
        Last            ///< no shadow touches it.
    };
    Turn turn() const { return _turn; }

    FrameReport report; ///< for the node.

    /// After the whole cull. @param leaves  those that the stage draws before its ShadowBin.
    virtual void prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) = 0;
    /// Leaves depth as it is, and the stencil bits that are not reserved at 0, as it finds them.
    virtual void draw(const CompositorStage& draw) const = 0;

protected:
    explicit ViewEffect(Turn turn) : _turn(turn) {}
    ~ViewEffect() override = default;

private:
    const Turn _turn;
};

} // namespace gnomon
