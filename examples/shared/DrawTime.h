// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>
#include <osgGA/GUIEventHandler>

#include <memory>
#include <string>

namespace gnomon::examples {

/// How long a window's frames take to draw, between two glFinish(), switched on and off by the key m.
class DrawTime : public osgGA::GUIEventHandler {
public:
    DrawTime();

    /// "drawn in 12.3 ms, 81 frames/s" of the last frame; empty while off.
    std::string line() const;

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    void getUsage(osg::ApplicationUsage& usage) const override;

private:
    struct Clock;

    std::shared_ptr<Clock> _clock; ///< shared with the camera's callbacks.
    bool _on = false;
};

} // namespace gnomon::examples
