// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>
#include <osg/GraphicsContext>
#include <osg/Image>
#include <osg/Viewport>
#include <osg/ref_ptr>

#include <string>

namespace gnomon {

/// A picture without a display: an OpenGL context that draws into memory, through OSMesa (no GPU) or EGL (a GPU where
/// there is one). Which of them is the choice of the library linked.
///
///     gnomon::HeadlessContext context(256, 256);
///     osgViewer::Viewer viewer;
///     context.attach(*viewer.getCamera());
///     viewer.setSceneData(scene);
///     viewer.frame();
///     osg::ref_ptr<osg::Image> picture = context.image();
///
/// Cost    width × height × (8 or 32 bytes colour + 4 bytes depth and stencil).
/// Needs   the CMake target gnomon::headless (libOSMesa, ahead of libGL), or gnomon::headless_egl (libEGL and libGL; a
///         driver's or Mesa's EGL at run time). A program links one of them.
/// Limits  one viewer a context, OSG keeps GL objects by context number; the context outlives its viewer. Fixed size.
/// Threads a viewer's draw thread may use it; image(), depth(), stencil() only while no other thread draws.
class HeadlessContext {
public:
    struct Options {
        int width = 800;         ///< pixels, 1 … 16384 (the driver's own limit if lower).
        int height = 600;        ///< pixels, the same.
        int depthBits = 24;      ///< 16, 24 or 32.
        int stencilBits = 8;     ///< 0 or 8. Shadows need some.
        bool floatColor = false; ///< 32-bit float colour instead of 8-bit.
    };

    HeadlessContext(int width, int height);
    /// @throws std::runtime_error with one sentence if a value is out of range or the context cannot be made.
    explicit HeadlessContext(const Options& options);
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    osg::GraphicsContext* graphicsContext() const;

    /// Makes `camera` draw into this context, into all of it: graphics context, viewport, and the aspect of a
    /// perspective projection. A viewer the camera belongs to becomes SingleThreaded unless a threading model was
    /// chosen before.
    /// @throws std::logic_error if this context's viewer has gone already.
    void attach(osg::Camera& camera) const;
    /// The same for a part of it, in pixels from the lower left corner.
    void attach(osg::Camera& camera, osg::Viewport* part) const;

    /// Copy of the colour buffer: RGBA, bottom row first as OSG keeps images; unsigned bytes, or floats with
    /// floatColor.
    osg::ref_ptr<osg::Image> image() const;
    /// Copy of the depth buffer, GL_FLOAT in [0, 1].
    osg::ref_ptr<osg::Image> depth() const;
    /// Copy of the stencil buffer, unsigned bytes; all zero if there are no stencil bits.
    osg::ref_ptr<osg::Image> stencil() const;
    /// GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer() const;

private:
    class Window;
    osg::ref_ptr<Window> _window;
};

} // namespace gnomon
