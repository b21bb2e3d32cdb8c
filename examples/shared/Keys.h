// SPDX-License-Identifier: MIT
#pragma once
#include "Hud.h"

#include <osgGA/GUIEventHandler>

#include <algorithm>
#include <string>
#include <vector>

namespace gnomon::examples {

/// A key of a program's own, and what it does to what the user controls.
template <class Controls>
struct Key {
    char key;
    const char* says;
    void (*act)(Controls& controls, Hud& hud);
};

/// The one of this letter; null if there is none.
template <class Controls>
const Key<Controls>* findKey(const std::vector<Key<Controls>>& keys, int letter) {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.key == letter; });
    return found == keys.end() ? nullptr : &*found;
}

/// A program's own keys; none of them is to be one of osgviewer's. Table and controls outlive it.
template <class Controls>
class KeyHandler : public osgGA::GUIEventHandler {
public:
    KeyHandler(const std::vector<Key<Controls>>& keys, Controls& controls, Hud& hud)
        : _keys(keys), _controls(controls), _hud(&hud) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
        if (event.getHandled() || event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return false;
        const Key<Controls>* key = findKey(_keys, event.getKey());
        if (!key) return false;
        key->act(_controls, *_hud);
        return true;
    }

    void getUsage(osg::ApplicationUsage& usage) const override {
        for (const Key<Controls>& key : _keys) usage.addKeyboardMouseBinding(key.key, key.says);
    }

private:
    const std::vector<Key<Controls>>& _keys;
    Controls& _controls;
    osg::ref_ptr<Hud> _hud;
};

/// A line a key, for --help.
template <class Controls>
std::string keysHelp(const std::vector<Key<Controls>>& keys) {
    std::string text;
    for (const Key<Controls>& key : keys) text += std::string("  ") + key.key + "        " + key.says + "\n";
    return text;
}

} // namespace gnomon::examples
