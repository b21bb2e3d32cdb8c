// SPDX-License-Identifier: MIT
#pragma once
#include <osgGA/GUIEventHandler>

#include <functional>

namespace gnomon::examples {

/// The middle mouse button, which no longer pans the camera: tells how far it was dragged, pixels to the right and up.
class DragHandler : public osgGA::GUIEventHandler {
public:
    using Move = std::function<void(double right, double up)>;
    explicit DragHandler(Move move) : _move(std::move(move)) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
        using E = osgGA::GUIEventAdapter;
        const bool pushed = event.getEventType() == E::PUSH && event.getButton() == E::MIDDLE_MOUSE_BUTTON;
        const bool released = event.getEventType() == E::RELEASE && event.getButton() == E::MIDDLE_MOUSE_BUTTON;
        const bool dragged = event.getEventType() == E::DRAG && _down;
        const double up = event.getMouseYOrientation() == E::Y_INCREASING_DOWNWARDS ? -1.0 : 1.0;
        if (dragged) _move(double(event.getX()) - _x, up * (double(event.getY()) - _y));
        if (pushed || released) _down = pushed;
        _x = double(event.getX());
        _y = double(event.getY());
        return pushed || released || dragged;
    }

private:
    Move _move;
    bool _down = false;
    double _x = 0.0, _y = 0.0;
};

} // namespace gnomon::examples
