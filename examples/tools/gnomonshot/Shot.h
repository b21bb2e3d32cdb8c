// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"
#include "ShotOptions.h"

#include <gnomon/HeadlessContext.h>
#include <gnomon/ShadowDecision.h>
#include <metrics/TruthMaps.h>

#include <osgViewer/Viewer>

#include <nlohmann/json.hpp>

#include <array>
#include <vector>

namespace gnomon::examples {

/// A viewer of one scene that draws into memory, and times what it draws.
class Shot {
public:
    Shot(const ShotOptions& options, osg::Node& files);

    /// Draws the frames asked for; nothing is timed.
    void draw();
    /// Draws and times frames: still ones, then ones under a moving light, each beside one without shadows.
    /// @return what --stats writes.
    nlohmann::json measure();
    osg::ref_ptr<osg::Image> picture() const { return _context.image(); }
    /// What is true of the picture. @throws std::runtime_error, one sentence, if there is not one light.
    metrics::TruthMaps truth();
    std::vector<std::string> diagnose() const { return _setup.diagnose(); }
    /// What each light's shadow was drawn by, where that is chosen automatically.
    std::vector<ShadowDecision> decisions() const;

private:
    double timedFrame(bool shadows);
    unsigned countDraws();
    /// Depth maps that the technique at each place has drawn so far; 0 of one that draws none.
    std::vector<unsigned> mapsDrawn() const;
    /// @param maps  drawn after the first frame, after the still ones and after those under a moving light.
    nlohmann::json shadowPasses(const std::array<std::vector<unsigned>, 3>& maps) const;
    std::size_t countTriangles() const;

    ShotOptions _options;
    HeadlessContext _context; // before the viewer: it must outlive it
    SceneSetup _setup;
    osgViewer::Viewer _viewer;
};

} // namespace gnomon::examples
