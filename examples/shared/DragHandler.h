// SPDX-License-Identifier: MIT
#pragma once
#include <osgGA/GUIEventHandler>

#include <functional>

namespace gnomon::examples {

/// A mouse button that no longer moves the camera: tells how far it was dragged, pixels to the right and up.
class DragHandler : public osgGA::GUIEventHandler {
public:
    using Move = std::function<void(double right, double up)>;
    using Takes = std::function<bool(const osgGA::GUIEventAdapter& pushed)>;

    static bool middleButton(const osgGA::GUIEventAdapter& pushed) {
        return pushed.getButton() == osgGA::GUIEventAdapter::MIDDLE_MOUSE_BUTTON;
    }

    /// @param takes  whether it is for this handler that a button was pushed.
    explicit DragHandler(Move move, Takes takes = middleButton) : _move(std::move(move)), _takes(std::move(takes)) {}

    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
        using E = osgGA::GUIEventAdapter;
        const bool pushed = event.getEventType() == E::PUSH && _takes(event);
        const bool released = event.getEventType() == E::RELEASE && _down;
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
    Takes _takes;
    bool _down = false;
    double _x = 0.0, _y = 0.0;
};

/// A button while shift is held, or else while `alone` holds.
inline DragHandler::Takes shiftAnd(int button, const std::function<bool()>& alone) {
    return [=](const osgGA::GUIEventAdapter& pushed) {
        const bool shift = (pushed.getModKeyMask() & osgGA::GUIEventAdapter::MODKEY_SHIFT) != 0;
        return pushed.getButton() == button && (shift || alone());
    };
}

} // namespace gnomon::examples
