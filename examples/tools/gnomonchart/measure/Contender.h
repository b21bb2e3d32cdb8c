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
    bool isBrief = true; ///< whether a brief chart has it: a technique at its defaults, at its best, or as advised.
};

/// The scene without shadows, which all are timed against.
Contender plainContender();

/// Gnomon's techniques, each over its quality knob. A new one is a line of the table in Contender.cpp.
std::vector<Contender> gnomonContenders();

/// Gnomon's technique of a specification, at a point that is on no chart.
/// @param spec  see gnomon::ShadowSpec; without receiver.
Contender gnomonContender(const std::string& spec, Receives receives);

/// Names of all techniques that are measured.
std::vector<std::string> chartTechniques();

/// A peer at these settings. `setting` names the point.
Contender peerContender(const Peer& peer, const std::string& setting, const Settings& settings);

/// A contender of a run or, with a peer, the best that a search among its settings finds.
struct Entrant {
    Contender contender;
    const Peer* sought = nullptr;
};

/// Gnomon's contenders, and peers at their defaults and, if asked for, at their best.
/// @param parts  of techniques' names; none: all.
/// @param brief  only those that are brief.
/// @throws std::invalid_argument, one sentence, if a part is in no technique's name.
std::vector<Entrant> entrants(const std::vector<std::string>& parts, bool best, bool brief = false);

} // namespace gnomon::examples
