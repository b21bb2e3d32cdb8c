// SPDX-License-Identifier: MIT
#include "ShadowKeys.h"

namespace gnomon::examples {
namespace {

constexpr double step = 5.0; // degrees

} // namespace

const std::vector<Key<ShadowControls>>& shadowKeys() {
    static const std::vector<Key<ShadowControls>> keys = {
        {'n', "Next shadow technique, or none.", [](ShadowControls& c, Hud&) { c.nextTechnique(); }},
        {'r', "Switch between relight and blend.", [](ShadowControls& c, Hud&) { c.toggleComposite(); }},
        {'j', "Turn the light 5 degrees anticlockwise, seen from above.",
         [](ShadowControls& c, Hud&) { c.turnLight(-step); }},
        {'k', "Turn the light 5 degrees clockwise.", [](ShadowControls& c, Hud&) { c.turnLight(step); }},
        {'u', "Raise the light 5 degrees.", [](ShadowControls& c, Hud&) { c.raiseLight(step); }},
        {'d', "Lower the light 5 degrees.", [](ShadowControls& c, Hud&) { c.raiseLight(-step); }},
        {'x', "Planar shadows: stencil off and on, against double darkening.",
         [](ShadowControls& c, Hud&) { c.toggle(&PlanarCures::stencil); }},
        {'o', "Planar shadows: depth offset off and on, against z-fighting.",
         [](ShadowControls& c, Hud&) { c.toggle(&PlanarCures::offset); }},
        {'p', "Planar shadows: clipping off and on, against anti-shadows.",
         [](ShadowControls& c, Hud&) { c.toggle(&PlanarCures::clip); }},
        {'v', "Show shadow maps, their texels, their cascades; or shadow volumes; or nothing.",
         [](ShadowControls& c, Hud&) { c.nextView(); }},
        {'i', "Show or hide what each technique did in the last frame.",
         [](ShadowControls& c, Hud&) { c.toggleReports(); }},
        {'g', "Hide or show Gnomon's text.", [](ShadowControls&, Hud& hud) { hud.toggle(); }},
    };
    return keys;
}

} // namespace gnomon::examples
