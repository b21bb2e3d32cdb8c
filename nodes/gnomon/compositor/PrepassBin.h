// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/FrameColorCopy.h>

#include <osg/State>
#include <osg/VertexArrayState>
#include <osgUtil/RenderBin>

#include <memory>

namespace gnomon {

/// The first bin of a stage: draws what drawables' programs need to look up shadows, and saves the colours that the stage is
/// drawn over.
class PrepassBin : public osgUtil::RenderBin {
public:
    PrepassBin() = default;
    PrepassBin(const PrepassBin& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osgUtil::RenderBin(other, copyOp) {}
    osg::Object* cloneType() const override { return new PrepassBin; }
    osg::Object* clone(const osg::CopyOp& copyOp) const override { return new PrepassBin(*this, copyOp); }
    const char* libraryName() const override { return "gnomon"; }
    const char* className() const override { return "PrepassBin"; }

    /// Lets the programs of a stage find the first of the jobs that are for them, until the stage is reset.
    static void show(const std::vector<ShadowJob>& jobs, osgUtil::RenderStage& stage);

    /// Lets the stage's colours be saved before anything is drawn, until it is reset.
    static void saveColors(osgUtil::RenderStage& stage);
    /// Those colours; null if they were not asked for, or OpenGL cannot read them: a framebuffer object of several samples.
    static FrameColorCopy* savedColors(osgUtil::RenderStage& stage);

    /// Lets it be seen what the stage begins with.
    static void watch(osgUtil::RenderStage& stage);
    /// True if osg::State's default material stood when a watched stage began to draw: not in a context's first frame.
    static bool followsDefault(osgUtil::RenderStage& stage);

    void drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) override;

protected:
    ~PrepassBin() override;

private:
    void drawAhead(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous);

    ShadowJob _job;
    bool _followsDefault = false;
    std::unique_ptr<FrameColorCopy> _colors; ///< null if they are not to be saved.
};

/// Makes osg::State dispatch the next drawable's arrays whatever it has dispatched before. It knows arrays by their
/// addresses, and takes a new one at the address of a deleted one for that. Call it before and after drawables of the
/// kit, whose arrays come and go with techniques.
inline void forgetArrays(osg::State& state) {
    const unsigned unit = state.getClientActiveTextureUnit();
    state.bindVertexArrayObject(state.getCurrentVertexArrayState()); // whose arrays they are
    state.disableAllVertexArrays();                                  // goes through all units
    state.setClientActiveTextureUnit(unit);
}

} // namespace gnomon
