// SPDX-License-Identifier: MIT
#pragma once
#include "FrameTime.h"
#include "Staging.h"

#include <gnomon/HeadlessContext.h>

#include <osgViewer/Viewer>

#include <memory>

namespace gnomon::examples {

/// Draws one staging into memory, in a context of its own: no other viewer's objects are in it. Scenes with a clock of
/// their own stand at its zero.
class StageViewer {
public:
    enum class Colour { BYTES, FLOATS };

    StageViewer(std::unique_ptr<Staging> staging, const SceneCamera& camera, Colour colour);

    void setCamera(const SceneCamera& camera);
    Staging& staging() { return *_staging; }
    void draw();
    /// The same, timed.
    FrameTime time();
    osg::ref_ptr<osg::Image> image() const { return _context.image(); }
    osgViewer::Viewer& viewer() { return _viewer; }

private:
    HeadlessContext _context; // before the viewer: it must outlive it
    std::unique_ptr<Staging> _staging;
    osgViewer::Viewer _viewer;
    bool _first = true;
};

} // namespace gnomon::examples
