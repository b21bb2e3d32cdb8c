// SPDX-License-Identifier: MIT
#include "Peers.h"

#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/MinimalCullBoundsShadowMap>
#include <osgShadow/MinimalDrawBoundsShadowMap>
#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowTexture>
#include <osgShadow/SoftShadowMap>
#include <osgShadow/ViewDependentShadowMap>

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using namespace osgShadow;
using Text = const std::string&;
using Technique = osg::ref_ptr<ShadowTechnique>;

float number(Text text) { return std::stof(text); }

osg::Vec2s square(Text side) {
    const short s = static_cast<short>(std::stoi(side));
    return {s, s};
}

/// "x,y"
osg::Vec2 pair(Text text) { return {number(text), number(text.substr(text.find(',') + 1))}; }

template <typename T>
T& as(PeerParts& parts) {
    return dynamic_cast<T&>(*parts.technique);
}

const std::string* find(const Settings& settings, Text name) {
    for (const auto& [key, value] : settings)
        if (key == name) return &value;
    return nullptr;
}

template <typename T>
Technique make(const Settings&) {
    return new T;
}

Technique makeParallelSplit(const Settings& settings) {
    const std::string* splits = find(settings, "splits");
    return new ParallelSplitShadowMap(nullptr, splits ? std::stoi(*splits) : 3);
}

template <typename T>
Knob sizeKnob(Text fallback = "1024") {
    return {"size", {"4096", "2048", "1024", "512"}, fallback, [](PeerParts& parts, Text value) {
                as<T>(parts).setTextureSize(square(value));
            }};
}

/// ShadowMap hands the negated pair to OpenGL and draws back faces.
template <typename T>
Knob offsetKnob(Text fallback) {
    return {"polygonOffset",
            {"-1,-1", "-2,-4", "0,0", "1,1", "-4,-16", "1,4", "2,4", "4,16"},
            fallback,
            [](PeerParts& parts, Text value) { as<T>(parts).setPolygonOffset(pair(value)); }};
}

std::vector<Knob> shadowMapKnobs() { return {sizeKnob<ShadowMap>(), offsetKnob<ShadowMap>("1,1")}; }

std::vector<Knob> softKnobs() {
    return {sizeKnob<ShadowMap>(),
            {"softnessWidth",
             {"0.001", "0", "0.0025", "0.005", "0.01"},
             "0.005",
             [](PeerParts& parts, Text v) { as<SoftShadowMap>(parts).setSoftnessWidth(number(v)); }},
            offsetKnob<ShadowMap>("1,1"),
            {"jitteringScale", {"16", "32", "64"}, "32", [](PeerParts& parts, Text v) {
                 as<SoftShadowMap>(parts).setJitteringScale(number(v));
             }}};
}

void turnNothing(PeerParts&, Text) {} // the constructor has taken it

std::vector<Knob> parallelSplitKnobs() {
    using PSSM = ParallelSplitShadowMap;
    return {
        {"size",
         {"4096", "2048", "1024", "512"},
         "1024",
         [](PeerParts& parts, Text v) { as<PSSM>(parts).setTextureResolution(static_cast<unsigned>(std::stoi(v))); }},
        {"splits", {"4", "2", "3", "1"}, "3", turnNothing},
        {"filtering",
         {"on", "off"},
         "on",
         [](PeerParts& parts, Text v) { as<PSSM>(parts).enableShadowGLSLFiltering(v == "on"); }},
        {"polygonOffset",
         {"1,1", "2,4", "none", "4,16", "-1,-1", "-2,-4", "-4,-16"},
         "none",
         [](PeerParts& parts, Text v) {
             if (v != "none") as<PSSM>(parts).setPolygonOffset(pair(v));
         }},
        {"splitMode",
         {"exponential", "linear"},
         "exponential",
         [](PeerParts& parts, Text v) {
             as<PSSM>(parts).setSplitCalculationMode(v == "linear" ? PSSM::SPLIT_LINEAR : PSSM::SPLIT_EXP);
         }},
        {"minNearDistance",
         {"default", "0.1 radii", "1 radii", "4 radii"},
         "default",
         [](PeerParts& parts, Text v) {
             if (v != "default") as<PSSM>(parts).setMinNearDistanceForSplits(number(v) * parts.radius);
         }},
    };
}

std::vector<Knob> standardKnobs() { return {sizeKnob<StandardShadowMap>()}; }

/// Not BOUNDING_SPHERE: it asks a render stage for a camera that it has not, and crashes in every scene.
void turnBounds(PeerParts& parts, Text value) {
    as<MinimalShadowMap>(parts).setShadowReceivingCoarseBoundAccuracy(value == "box" ? MinimalShadowMap::BOUNDING_BOX
                                                                                     : MinimalShadowMap::EMPTY_BOX);
}

/// A margin keeps casters that are not in view: the projection is trimmed to what is.
std::vector<Knob> minimalKnobs() {
    std::vector<Knob> knobs = standardKnobs();
    knobs.push_back(
        {"minLightMargin", {"0.5 radii", "2 radii", "0 radii", "1 radii"}, "0 radii", [](PeerParts& parts, Text v) {
             as<MinimalShadowMap>(parts).setMinLightMargin(number(v) * static_cast<float>(parts.radius));
         }});
    knobs.push_back({"coarseBounds", {"box", "none"}, "box", turnBounds});
    return knobs;
}

void turnMaps(PeerParts& parts, Text value) {
    parts.settings->setNumShadowMapsPerLight(static_cast<unsigned>(std::stoi(value)));
}

void turnProjection(PeerParts& parts, Text value) {
    parts.settings->setShadowMapProjectionHint(value == "perspective" ? ShadowSettings::PERSPECTIVE_SHADOW_MAP
                                                                      : ShadowSettings::ORTHOGRAPHIC_SHADOW_MAP);
}

std::vector<Knob> viewDependentKnobs() {
    return {{"size",
             {"4096", "2048", "1024", "512"},
             "2048",
             [](PeerParts& parts, Text v) { parts.settings->setTextureSize(square(v)); }},
            {"nearFar",
             {"primitives", "bounding volumes", "camera's"},
             "camera's",
             [](PeerParts& parts, Text v) {
                 using Cull = osg::CullSettings;
                 parts.settings->setComputeNearFarModeOverride(
                     v == "primitives"         ? Cull::COMPUTE_NEAR_FAR_USING_PRIMITIVES
                     : v == "bounding volumes" ? Cull::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES
                                               : Cull::DO_NOT_COMPUTE_NEAR_FAR);
             }},
            {"cutOffAngle",
             {"2", "15", "30"},
             "2",
             [](PeerParts& parts, Text v) { parts.settings->setPerspectiveShadowMapCutOffAngle(number(v)); }},
            {"projection", {}, "perspective", turnProjection},
            {"maps", {}, "1", turnMaps}};
}

Peer viewDependent(Text name, Text projection, Text maps) {
    Peer peer{name, make<ViewDependentShadowMap>, viewDependentKnobs(), "", "", {}};
    peer.fixed = {{"projection", projection}, {"maps", maps}};
    return peer;
}

template <typename T>
Peer minimal(Text name) {
    return {name, make<T>, minimalKnobs(), "", "", {}};
}

std::vector<Peer> makePeers() {
    return {
        {"ShadowMap", make<ShadowMap>, shadowMapKnobs(), "0,1", "0.3,0.7", {}},
        {"SoftShadowMap", make<SoftShadowMap>, softKnobs(), "0,1", "0.3,0.7", {}},
        {"ParallelSplit", makeParallelSplit, parallelSplitKnobs(), "0,1", "0,0.7", {}},
        {"Standard", make<StandardShadowMap>, standardKnobs(), "", "", {}},
        minimal<MinimalShadowMap>("Minimal"),
        minimal<MinimalCullBoundsShadowMap>("MinimalCullBounds"),
        minimal<MinimalDrawBoundsShadowMap>("MinimalDrawBounds"),
        minimal<LightSpacePerspectiveShadowMapVB>("LightSpacePerspective VB"),
        minimal<LightSpacePerspectiveShadowMapCB>("LightSpacePerspective CB"),
        minimal<LightSpacePerspectiveShadowMapDB>("LightSpacePerspective DB"),
        viewDependent("ViewDependent ortho", "orthographic", "1"),
        viewDependent("ViewDependent ortho x2", "orthographic", "2"),
        viewDependent("ViewDependent perspective", "perspective", "1"),
        viewDependent("ViewDependent perspective x2", "perspective", "2"),
        {"ShadowTexture", make<ShadowTexture>, {}, "", "", {}, false},
    };
}

void turnAll(PeerParts& parts, const Peer& peer, const Settings& settings) {
    for (const auto& [name, value] : settings) {
        if (name == "ambientBias")
            setAmbientBias(*parts.technique, value);
        else
            knobOf(peer, name).turn(parts, value);
    }
}

} // namespace

const std::vector<Peer>& peers() {
    static const std::vector<Peer> table = makePeers();
    return table;
}

const Knob& knobOf(const Peer& peer, const std::string& name) {
    for (const Knob& knob : peer.knobs)
        if (knob.name == name) return knob;
    throw std::invalid_argument(peer.name + " has no setting \"" + name + "\".");
}

PeerParts makePeer(const Peer& peer, const Settings& settings, double radius) {
    PeerParts parts{peer.make(settings), new ShadowSettings, radius};
    turnAll(parts, peer, peer.fixed);
    turnAll(parts, peer, settings);
    return parts;
}

void setAmbientBias(ShadowTechnique& technique, const std::string& bias) {
    if (auto* map = dynamic_cast<ShadowMap*>(&technique)) map->setAmbientBias(pair(bias));
    if (auto* splits = dynamic_cast<ParallelSplitShadowMap*>(&technique)) splits->setAmbientBias(pair(bias));
}

} // namespace gnomon::examples
