// SPDX-License-Identifier: MIT
#pragma once
#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowTechnique>

#include <string>
#include <utility>
#include <vector>

namespace gnomon::examples {

/// Settings by name, as the chart prints them.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// A technique of osgShadow on its way to be set up.
struct PeerParts {
    osg::ref_ptr<osgShadow::ShadowTechnique> technique;
    osg::ref_ptr<osgShadow::ShadowSettings> settings; ///< which ViewDependentShadowMap alone reads.
    double radius = 1.0;                              ///< of the scene: lengths are multiples of it.
};

/// One public setter: what a sweep tries, and what the class has by itself.
struct Knob {
    std::string name;
    std::vector<std::string> values; ///< in the order in which a sweep tries them.
    std::string fallback;            ///< the class's own default; one of `values`.
    void (*turn)(PeerParts& parts, const std::string& value);
};

/// One of osgShadow's techniques: how to make it, and its knobs, those that matter most first. Left out are
/// settings that only number texture units or draw debugging aids, and limits of distance for scenes larger than what is
/// to be shadowed (setMaxFarDistance, setMaxFarPlane, setMaximumShadowMapDistance and their like). ViewDependentShadowMap keeps its default shader hint: its own
/// shader does not compile on Mesa.
struct Peer {
    std::string name;
    osg::ref_ptr<osgShadow::ShadowTechnique> (*make)(const Settings& settings);
    std::vector<Knob> knobs;
    std::string lightOnly;   ///< ambientBias that is only light where V = 1 and black where V = 0; empty: has none.
    std::string scenesLight; ///< ambientBias that is right for ambient 0.3 and diffuse 0.7 of a level ground.
    Settings fixed;          ///< what makes a variant of one class.
    bool partsCastAndReceive = true; ///< false: needs receivers that do not cast, and casts on nothing else.
};

const std::vector<Peer>& peers();

/// The peer's knob of this name. @throws std::invalid_argument if it has none.
const Knob& knobOf(const Peer& peer, const std::string& name);

/// Makes and sets up a technique; what `settings` lacks keeps the class's default.
/// @throws std::invalid_argument for a name that is no knob.
PeerParts makePeer(const Peer& peer, const Settings& settings, double radius);

/// ambientBias as "x,y" where the class has it; else nothing happens.
void setAmbientBias(osgShadow::ShadowTechnique& technique, const std::string& bias);

} // namespace gnomon::examples
