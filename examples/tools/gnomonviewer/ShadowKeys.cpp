// SPDX-License-Identifier: MIT
#include "ShadowKeys.h"

namespace gnomon::examples {
namespace {

constexpr double step = 5.0; // degrees

} // namespace

const std::vector<Key<ShadowControls>>& shadowKeys() {
    static const std::vector<Key<ShadowControls>> keys = {
        {'n', "Next shadow technique, or none.", [](ShadowControls& c, Hud&) { c.nextTechnique(); }},
        {'r', "Relight or blend.", [](ShadowControls& c, Hud&) { c.toggleComposite(); }},
        {'j', "Turn the light 5 degrees anticlockwise, seen from above.",
         [](ShadowControls& c, Hud&) { c.turnLight(-step); }},
        {'k', "Turn the light 5 degrees clockwise.", [](ShadowControls& c, Hud&) { c.turnLight(step); }},
        {'u', "Raise the light 5 degrees.", [](ShadowControls& c, Hud&) { c.raiseLight(step); }},
        {'d', "Lower the light 5 degrees.", [](ShadowControls& c, Hud&) { c.raiseLight(-step); }},
        {'x', "Stencil cure of planar shadows off and on: double darkening.",
         [](ShadowControls& c, Hud&) { c.toggle(&PlanarCures::stencil); }},
        {'o', "Offset cure off and on: fight with the ground.",
         [](ShadowControls& c, Hud&) { c.toggle(&PlanarCures::offset); }},
        {'p', "Clip cure off and on: anti-shadows.", [](ShadowControls& c, Hud&) { c.toggle(&PlanarCures::clip); }},
        {'v', "How maps lie: the maps, the width of their texels, their parts of the view, or nothing.",
         [](ShadowControls& c, Hud&) { c.nextView(); }},
        {'g', "Hide or show Gnomon's text.", [](ShadowControls&, Hud& hud) { hud.toggle(); }},
    };
    return keys;
}

} // namespace gnomon::examples
