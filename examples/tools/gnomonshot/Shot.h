// SPDX-License-Identifier: MIT
#pragma once
#include "SceneSetup.h"
#include "ViewOptions.h"

#include <gnomon/HeadlessContext.h>
#include <gnomon/ShadowDecision.h>

#include <metrics/PixelSets.h>
#include <nlohmann/json.hpp>
#include <osgViewer/Viewer>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// What gnomonshot's command line asks for.
struct ShotOptions {
    ViewOptions view;
    std::optional<int> frames; ///< 1, or 20 with stats.
    std::string out;           ///< picture; empty: none.
    std::string stats;         ///< JSON file; empty: none.
    std::string truth;         ///< file of what is true; empty: none.
    bool recommend = false;    ///< print what could draw the shadows.
    bool help = false;

    int frameCount() const { return frames.value_or(stats.empty() ? 1 : 20); }
};

/// @throws std::invalid_argument, one sentence that names what is wrong and what is allowed.
ShotOptions readShotOptions(osg::ArgumentParser& arguments);

/// What --help prints.
std::string shotHelp();

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
