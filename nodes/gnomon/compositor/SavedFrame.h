// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenPass.h>
#include <gnomon/gl/FrameColorCopy.h>
#include <gnomon/gl/FrameDepths.h>

#include <osg/Object>
#include <osg/State>
#include <osg/StateSet>
#include <osg/Viewport>
#include <osg/ref_ptr>

#include <string>

namespace gnomon {

/// Colours and depths that a viewport shows before something is drawn there, to be put back in part after that.
///
/// Cost    two copies of the viewport, and twice its size in textures.
/// Needs   OpenGL 3.0.
/// Threads one a context.
class SavedFrame : public osg::Object {
public:
    SavedFrame();
    SavedFrame(const SavedFrame& other, const osg::CopyOp& copyOp);
    META_Object(gnomon, SavedFrame)

    /// Called within a CleanState, as all that follows.
    void save(osg::State& state, const osg::Viewport& viewport);
    /// False where OpenGL cannot read what was bound: a framebuffer object of several samples.
    bool hasColors() const { return _hasColors; }

    /// Of what was saved.
    FrameColorCopy& colors() { return _colors; }
    /// Where the pass allows: depths become those that were saved.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    std::string drawDepths(ScreenPass& pass);

    void resizeGLObjectBuffers(unsigned maxSize) override;
    void releaseGLObjects(osg::State* state) const override;

protected:
    ~SavedFrame() override = default;

private:
    mutable FrameColorCopy _colors;
    mutable FrameDepths _depths;
    bool _hasColors = false;
    const osg::ref_ptr<osg::StateSet> _program;
};

} // namespace gnomon
