// SPDX-License-Identifier: MIT
#pragma once
#include "FrameTime.h"
#include "Staging.h"
#include "Yardstick.h"

#include <gnomon/HeadlessContext.h>

#include <osg/Image>
#include <osgViewer/Viewer>

#include <memory>
#include <string>

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

/// Red, green and blue as they stand in an image whose lowest row comes first.
ShadedPicture coloursOf(const osg::Image& image);

/// Bytes, clamped, without gamma: as a window shows it.
osg::ref_ptr<osg::Image> bytesOf(const ShadedPicture& picture);

/// A name for a file: small letters, digits and "-".
std::string fileName(const std::vector<std::string>& parts, const std::string& ending);

} // namespace gnomon::examples
