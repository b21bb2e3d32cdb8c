// SPDX-License-Identifier: MIT
#pragma once
#include "Peers.h"
#include "Staging.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::examples {

/// What a technique shadows in a scene: all of it, ChartScene::receiver, or ChartScene::terrain.
enum class Receives { EVERYTHING, FLAT, TERRAIN };

/// One way to shadow a scene: a point on the chart.
struct Contender {
    std::string kit;       ///< "Gnomon" or "osgShadow".
    std::string technique; ///< the curve's name.
    std::string setting;   ///< the point's name.
    Settings settings;     ///< all that differs from the technique's own defaults.

    /// @throws std::invalid_argument, one sentence, if it does not suit the scene.
    std::function<std::unique_ptr<Staging>(const ChartScene& scene, Look look)> stage;
    Receives receives = Receives::EVERYTHING;
};

/// The scene without shadows, which all are timed against.
Contender plainContender();

/// Gnomon's techniques, each over its quality knob. A new one is a line of the table in Contender.cpp.
std::vector<Contender> gnomonContenders();

/// A peer at these settings. `setting` names the point.
Contender peerContender(const Peer& peer, const std::string& setting, const Settings& settings);

} // namespace gnomon::examples
