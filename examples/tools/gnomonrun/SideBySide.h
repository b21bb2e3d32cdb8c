// SPDX-License-Identifier: MIT
#pragma once
#include "PictureChange.h"
#include "ShadowedScene.h"
#include "WindowPicture.h"

#include <osgViewer/ViewerBase>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Draws one frame of a program again and again: without shadows, with every technique and both composites, and with
/// osgShadow::ShadowMap. The program's scene stands still meanwhile.
class SideBySide {
public:
    /// @param draw    draws a frame of `viewer` as the program does, without events and updates.
    /// @param folder  for pictures and the table.
    /// @throws std::runtime_error, one sentence, if the program shows no window.
    SideBySide(osgViewer::ViewerBase& viewer, std::function<void()> draw, std::string folder);

    /// Writes NAME.png a picture, and compare.json. @throws std::runtime_error, one sentence, if it cannot.
    /// @param scenes  those that are shown.
    void run(const std::vector<ShadowedScene*>& scenes);
    /// A line each, for people.
    const std::vector<std::string>& lines() const { return _lines; }

private:
    struct Drawn {
        std::string name;
        osg::ref_ptr<osg::Image> picture;
        double milliseconds = 0.0; ///< a frame, median.
        int glErrors = 0;
        PictureChange change; ///< from the picture without shadows.
        std::vector<std::string> causes;
    };

    Drawn draw(const std::string& name);
    void nextFrame();
    void write(const std::vector<Drawn>& all) const;

    osgViewer::ViewerBase& _viewer;
    const std::function<void()> _draw;
    const std::string _folder;
    osg::ref_ptr<osg::GraphicsContext> _window;
    osg::ref_ptr<WindowPicture> _picture;
    std::vector<std::string> _lines;
};

} // namespace gnomon::examples
