// SPDX-License-Identifier: MIT
#include "ShadowKeys.h"

#include <osgViewer/View>

#include <algorithm>
#include <array>

namespace gnomon::examples {
namespace {

constexpr double step = 5.0; // degrees

struct Key {
    char key;
    const char* says;
    void (*act)(ShadowControls&, Hud&);
};

constexpr std::array<Key, 10> keys = {{
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
    {'g', "Hide or show Gnomon's text.", [](ShadowControls&, Hud& hud) { hud.toggle(); }},
}};

} // namespace

bool ShadowKeys::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) {
    if (event.getHandled() || event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return false;
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.key == event.getKey(); });
    if (found == keys.end()) return false;
    found->act(_controls, *_hud);
    return true;
}

void ShadowKeys::getUsage(osg::ApplicationUsage& usage) const {
    for (const Key& key : keys) usage.addKeyboardMouseBinding(key.key, key.says);
}

std::string shadowKeysHelp() {
    std::string text;
    for (const Key& key : keys) text += std::string("  ") + key.key + "        " + key.says + "\n";
    return text;
}

} // namespace gnomon::examples
