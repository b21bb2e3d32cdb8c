// SPDX-License-Identifier: MIT
#include "Contender.h"
#include "GnomonStaging.h"
#include "PeerStaging.h"

#include <stdexcept>

namespace gnomon::examples {
namespace {

struct GnomonPoint {
    const char* setting;
    const char* spec;  ///< see gnomon::ShadowSpec.
    bool flatReceiver; ///< falls on what ChartScene::receiver names.
};

constexpr GnomonPoint gnomonPoints[] = {
    {"relight", "planar", true},
    {"blend", "planar:composite=blend", true},
    {"relight", "traced", false},
    {"blend", "traced:composite=blend", false},
};

ShadowSpec specFor(const GnomonPoint& point, const ChartScene& scene) {
    ShadowSpec spec = parseShadowSpec(point.spec);
    if (point.flatReceiver && scene.receiver.empty())
        throw std::invalid_argument(spec.technique + " needs a flat receiver, and the scene names none.");
    if (point.flatReceiver) spec.receiver = scene.receiver;
    return spec;
}

Contender gnomonContender(const GnomonPoint& point) {
    Contender result{"Gnomon", parseShadowSpec(point.spec).technique, point.setting, {{"--shadow", point.spec}}, {}};
    result.stage = [point](const ChartScene& scene, Look look) {
        return std::make_unique<GnomonStaging>(specFor(point, scene), scene, look);
    };
    return result;
}

} // namespace

Contender plainContender() {
    Contender result{"", "none", "", {}, {}};
    result.stage = [](const ChartScene& scene, Look look) { return std::make_unique<PlainStaging>(scene, look); };
    return result;
}

std::vector<Contender> gnomonContenders() {
    std::vector<Contender> result;
    for (const GnomonPoint& point : gnomonPoints) result.push_back(gnomonContender(point));
    return result;
}

Contender peerContender(const Peer& peer, const std::string& setting, const Settings& settings) {
    Contender result{"osgShadow", peer.name, setting, settings, {}};
    result.stage = [&peer, settings](const ChartScene& scene, Look look) {
        return std::make_unique<PeerStaging>(peer, settings, scene, look);
    };
    return result;
}

} // namespace gnomon::examples
