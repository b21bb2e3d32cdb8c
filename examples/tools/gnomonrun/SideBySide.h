// SPDX-License-Identifier: MIT
#pragma once
#include "ShadowedScene.h"

#include <osg/GraphicsContext>
#include <osg/Image>
#include <osgViewer/ViewerBase>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// The picture of a window at each swap of its buffers: all of its cameras, whichever order they are drawn in. It waits
/// until OpenGL has drawn all.
class WindowPicture : public osg::GraphicsContext::SwapCallback {
public:
    /// Does as the window's own callback, if it has one, besides.
    explicit WindowPicture(osg::GraphicsContext& window);

    void swapBuffersImplementation(osg::GraphicsContext* window) override;
    /// The last one, RGBA bytes; null before the first.
    const osg::Image* last() const { return _picture; }

private:
    osg::ref_ptr<osg::GraphicsContext::SwapCallback> _own;
    osg::ref_ptr<osg::Image> _picture;
};

/// Which pixels of a picture are not those of the same picture without shadows. Both are RGBA bytes of one size.
struct PictureChange {
    int width = 0, height = 0;
    std::vector<std::uint8_t>
        darker; ///< a pixel each: 1 if a channel is darker by more than `least`, and none brighter.
    int darkerPixels = 0;
    int brighterPixels = 0; ///< with a channel that is brighter by more than `least`.
};

/// @param least  of 255: smaller differences do not count.
PictureChange changeOf(const osg::Image& without, const osg::Image& with, int least = 2);

/// Pixels at which two changes differ although neither has an edge near. @param reach  pixels that are near.
int disagreement(const PictureChange& a, const PictureChange& b, int reach = 3);

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
