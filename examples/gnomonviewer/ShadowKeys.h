// SPDX-License-Identifier: MIT
#pragma once
#include "Hud.h"
#include "ShadowControls.h"

#include <osgGA/GUIEventHandler>

#include <string>

namespace gnomon::examples {

/// gnomonviewer's own keys; none is one of osgviewer's.
class ShadowKeys : public osgGA::GUIEventHandler {
public:
    ShadowKeys(ShadowControls& controls, Hud& hud) : _controls(controls), _hud(&hud) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    void getUsage(osg::ApplicationUsage& usage) const override;

private:
    ShadowControls& _controls;
    osg::ref_ptr<Hud> _hud;
};

/// A line a key, for --help.
std::string shadowKeysHelp();

} // namespace gnomon::examples
