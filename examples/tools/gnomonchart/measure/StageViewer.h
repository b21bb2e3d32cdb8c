// SPDX-License-Identifier: MIT
#pragma once
#include "Contender.h"
#include "FrameTime.h"

#include <gnomon/HeadlessContext.h>
#include <metrics/Visibility.h>

#include <osg/Image>
#include <osgViewer/Viewer>

#include <memory>
#include <string>

namespace gnomon::examples {

using ShadedPicture = metrics::Grid<glm::dvec3>; ///< linear light.

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

/// A contender's visibility scene on a screen: white in the light alone, float colours.
///
/// V = A / B: A is the frame, B the same with nothing in the passes that cast. Full shadow is black in such a scene, so
/// that no third picture is needed. Under BLEND there is some ambient light, which a shadow blackens, too.
class Sight {
public:
    /// @throws see Contender::stage.
    Sight(const Contender& contender, const ChartScene& scene);

    void setCamera(const SceneCamera& camera) { _viewer.setCamera(camera); }
    void setLight(const osg::Vec4d& light) { _viewer.staging().setLight(light); }
    metrics::Visibility visibility();
    /// Why shadows were missing in the last visibility.
    const std::vector<std::string>& diagnosis() const { return _diagnosis; }
    /// How its shadow was chosen, see Staging::decisions().
    const std::vector<ShadowDecision>& decisions() const { return _decisions; }

private:
    metrics::Picture frame();

    StageViewer _viewer;
    std::vector<std::string> _diagnosis;
    std::vector<ShadowDecision> _decisions;
};

/// The contender's picture as a user sees it; with the light out if it is not to shine.
ShadedPicture shadedPicture(const Contender& contender, const ChartScene& scene, bool shines = true);

} // namespace gnomon::examples
