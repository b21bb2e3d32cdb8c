// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"

#include <gnomon/HeadlessContext.h>

#include <osgViewer/Viewer>

namespace gnomon::examples {

/// Draws a scene into memory, without a window or a display. Programs that use it link a headless library.
class ScenePicture {
public:
    /// @param stencilBits  0 or 8.
    /// @throws std::runtime_error, one sentence, if there is no OpenGL.
    ScenePicture(const ViewOptions& view, SceneSetup& setup, int stencilBits = 8);

    /// The scene's time of the next frame, seconds: 30 frames are one, so that each run draws the same.
    double nextTime();
    /// Draws the next frame.
    void frame() { _viewer.frame(nextTime()); }
    /// The last frame drawn, of as many samples as the options ask.
    osg::ref_ptr<osg::Image> image();
    /// The picture after so many frames.
    osg::ref_ptr<osg::Image> draw(int frames = 1);

    osgViewer::Viewer& viewer() { return _viewer; }
    const HeadlessContext& context() const { return _context; }

private:
    const int _samples;
    const SceneSetup& _setup;
    HeadlessContext _context; // before the viewer: it must outlive it
    osgViewer::Viewer _viewer;
    int _drawn = 0;
};

} // namespace gnomon::examples
