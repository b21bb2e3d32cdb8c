// SPDX-License-Identifier: MIT
#include "Contender.h"
#include "ChartResults.h"
#include "GnomonStaging.h"
#include "PeerStaging.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {
namespace {

struct GnomonPoint {
    const char* technique;
    const char* setting;
    const char* spec; ///< see gnomon::ShadowSpec.
    Receives receives;
};

constexpr GnomonPoint gnomonPoints[] = {
    {"planar", "relight", "planar", Receives::FLAT},
    {"planar", "blend", "planar:composite=blend", Receives::FLAT},
    {"box", "relight", "box", Receives::TERRAIN},
    {"hull", "relight", "hull", Receives::TERRAIN},
    {"hull", "blend", "hull:composite=blend", Receives::TERRAIN},
    {"map", "size 512", "map:size=512", Receives::EVERYTHING},
    {"map", "size 1024", "map", Receives::EVERYTHING},
    {"map", "size 2048", "map:size=2048", Receives::EVERYTHING},
    {"map", "bilinear, size 1024", "map:filter=bilinear", Receives::EVERYTHING},
    {"map", "nearest, size 1024", "map:filter=nearest", Receives::EVERYTHING},
    {"map", "blend, nearest, size 256, one map", "map:filter=nearest,composite=blend,size=256,cascades=1",
     Receives::EVERYTHING},
    {"map", "blend, nearest, size 512, one map", "map:filter=nearest,composite=blend,size=512,cascades=1",
     Receives::EVERYTHING},
    {"map", "blend, nearest, size 1024, one map", "map:filter=nearest,composite=blend,cascades=1",
     Receives::EVERYTHING},
    {"map", "blend, nearest, size 512", "map:filter=nearest,composite=blend,size=512", Receives::EVERYTHING},
    {"map", "blend, nearest, size 1024", "map:filter=nearest,composite=blend", Receives::EVERYTHING},
    {"map", "blend, size 512", "map:composite=blend,size=512", Receives::EVERYTHING},
    {"map", "blend, size 1024", "map:composite=blend", Receives::EVERYTHING},
    {"map", "blend, size 2048", "map:composite=blend,size=2048", Receives::EVERYTHING},
    {"map, smooth", "relight", "map:edges=smooth", Receives::EVERYTHING},
    {"map, smooth", "blend, size 512", "map:edges=smooth,composite=blend,size=512", Receives::EVERYTHING},
    {"map, smooth", "blend", "map:edges=smooth,composite=blend", Receives::EVERYTHING},
    {"map, smooth", "blend, size 1536", "map:edges=smooth,composite=blend,size=1536", Receives::EVERYTHING},
    {"map, smooth", "blend, size 2048", "map:edges=smooth,composite=blend,size=2048", Receives::EVERYTHING},
    {"map, smooth", "blend, fine", "map:edges=smooth,composite=blend,filter=fine,size=4096", Receives::EVERYTHING},
    {"map, smooth", "blend, bilinear", "map:edges=smooth,composite=blend,filter=bilinear", Receives::EVERYTHING},
    {"map, smooth", "blend, bilinear, size 512", "map:edges=smooth,composite=blend,filter=bilinear,size=512",
     Receives::EVERYTHING},
    {"map, soft", "size 1024", "map:edges=soft", Receives::EVERYTHING},
    {"map, soft", "size 2048", "map:edges=soft,size=2048", Receives::EVERYTHING},
    {"map, soft", "blend, size 1024", "map:edges=soft,composite=blend", Receives::EVERYTHING},
    {"map, soft", "blend, size 2048", "map:edges=soft,composite=blend,size=2048", Receives::EVERYTHING},
    {"volume", "relight", "volume", Receives::EVERYTHING},
    {"volume", "blend", "volume:composite=blend", Receives::EVERYTHING},
    {"auto", "error 4", "auto:error=4", Receives::EVERYTHING},
    {"auto", "error 1", "auto", Receives::EVERYTHING},
    {"auto", "error 0.4", "auto:error=0.4", Receives::EVERYTHING},
    {"auto", "blend, error 4", "auto:error=4,composite=blend", Receives::EVERYTHING},
    {"auto", "blend, error 1", "auto:composite=blend", Receives::EVERYTHING},
    {"auto", "blend, error 0.4", "auto:error=0.4,composite=blend", Receives::EVERYTHING},
    {"traced", "relight", "traced", Receives::EVERYTHING},
    {"traced", "blend", "traced:composite=blend", Receives::EVERYTHING},
};

ShadowSpec specFor(const std::string& text, Receives receives, const ChartScene& scene) {
    ShadowSpec spec = parseShadowSpec(text);
    if (receives == Receives::EVERYTHING) return spec;
    const bool flat = receives == Receives::FLAT;
    spec.receiver = flat ? scene.receiver : scene.terrain;
    if (spec.receiver.empty())
        throw std::invalid_argument(spec.technique + " needs a " + (flat ? "flat receiver" : "terrain") +
                                    ", but the scene names none.");
    return spec;
}

} // namespace

Contender plainContender() {
    Contender result{"", "none", "", {}, {}};
    result.stage = [](const ChartScene& scene, Look look) { return std::make_unique<PlainStaging>(scene, look); };
    return result;
}

std::vector<Contender> gnomonContenders() {
    std::vector<Contender> result;
    for (const GnomonPoint& point : gnomonPoints) {
        result.push_back(gnomonContender(point.spec, point.receives));
        result.back().technique = point.technique;
        result.back().setting = point.setting;
    }
    return result;
}

Contender gnomonContender(const std::string& spec, Receives receives) {
    Contender result{ourKit, "", "", {{"--shadow", spec}}, {}};
    result.receives = receives;
    result.learns = parseShadowSpec(spec).technique == "auto";
    result.stage = [spec, receives](const ChartScene& scene, Look look) {
        return std::make_unique<GnomonStaging>(specFor(spec, receives, scene), scene, look);
    };
    return result;
}

std::vector<std::string> chartTechniques() {
    std::vector<std::string> names;
    for (const GnomonPoint& point : gnomonPoints)
        if (names.empty() || names.back() != point.technique) names.emplace_back(point.technique);
    for (const Peer& peer : peers()) names.push_back(peer.name);
    return names;
}

bool isAsked(const std::string& technique, const std::vector<std::string>& parts) {
    const auto isIn = [&](const std::string& part) { return technique.find(part) != std::string::npos; };
    return parts.empty() || std::any_of(parts.begin(), parts.end(), isIn);
}

void requireKnown(const std::vector<std::string>& parts) {
    const std::vector<std::string> names = chartTechniques();
    for (const std::string& part : parts)
        if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return isAsked(name, {part}); }))
            throw std::invalid_argument("no technique's name contains \"" + part + "\". See --list.");
}

Contender peerContender(const Peer& peer, const std::string& setting, const Settings& settings) {
    Contender result{"osgShadow", peer.name, setting, settings, {}};
    if (!peer.partsCastAndReceive) result.receives = Receives::FLAT;
    result.stage = [&peer, settings](const ChartScene& scene, Look look) {
        return std::make_unique<PeerStaging>(peer, settings, scene, look);
    };
    return result;
}

} // namespace gnomon::examples
