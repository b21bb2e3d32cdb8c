// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeadlessOptions.h>

#include <osg/Camera>
#include <osg/GraphicsContext>
#include <osg/Image>
#include <osg/Viewport>
#include <osg/ref_ptr>

#include <string>

namespace gnomon {

/// An OpenGL context that draws into memory: pictures without a window and without a display.
///
/// Use it in tests, on servers and in batch programs. The linked library decides between OSMesa (no GPU) and EGL (a GPU
/// if there is one).
///
///     gnomon::HeadlessContext context(256, 256);
///     osgViewer::Viewer viewer;
///     context.attach(*viewer.getCamera());
///     viewer.setSceneData(scene);
///     viewer.frame();
///     osg::ref_ptr<osg::Image> picture = context.image();
///
/// Cost
/// - Memory: width × height × (8 or 32 bytes colour + 4 bytes depth and stencil).
/// Needs
/// - One of two CMake targets; a program links only one.
/// - gnomon::headless: libOSMesa, ahead of libGL; the same as the other target if Gnomon was built where OSMesa is not.
/// - gnomon::headless_egl: libEGL and libGL, and at run time a driver's or Mesa's EGL.
/// Limits
/// - One viewer for each context. The context outlives its viewer.
/// - The size is fixed.
/// Threads
/// - A viewer's draw thread may use it. Call image(), depth() and stencil() only while no other thread draws.
class HeadlessContext {
public:
    /// Size and buffers of a context.
    using Options = HeadlessOptions;

    /// Makes a context of the given size with the other options at their defaults. Throws as the next constructor.
    HeadlessContext(int width, int height);
    /// Makes a context.
    /// @throws std::runtime_error with one sentence if a value is out of range or OpenGL cannot be started.
    explicit HeadlessContext(const Options& options);
    /// Closes the context.
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /// The context as OSG sees it.
    osg::GraphicsContext* graphicsContext() const;

    /// Makes `camera` draw into the whole context: sets its graphics context, its viewport and the aspect ratio of a
    /// perspective projection. The camera's viewer becomes SingleThreaded unless a threading model is chosen.
    /// @throws std::logic_error if the context's viewer is gone.
    void attach(osg::Camera& camera) const;
    /// Makes `camera` draw into a part of the context, in pixels from the lower left corner.
    void attach(osg::Camera& camera, osg::Viewport* part) const;

    /// Copies the colour buffer: RGBA, bottom row first, as OSG keeps images. Unsigned bytes; floats with floatColor.
    osg::ref_ptr<osg::Image> image() const;
    /// Copies the depth buffer: GL_FLOAT, 0 … 1.
    osg::ref_ptr<osg::Image> depth() const;
    /// Copies the stencil buffer: unsigned bytes, all zero if there are no stencil bits.
    osg::ref_ptr<osg::Image> stencil() const;
    /// OpenGL's GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer() const;

private:
    class Window;
    osg::ref_ptr<Window> _window;
};

} // namespace gnomon
