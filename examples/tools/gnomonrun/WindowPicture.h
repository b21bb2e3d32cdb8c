// SPDX-License-Identifier: MIT
#pragma once
#include <osg/GraphicsContext>
#include <osg/Image>

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

} // namespace gnomon::examples
