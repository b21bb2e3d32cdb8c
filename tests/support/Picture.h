// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeadlessContext.h>
#include <osg/Image>
#include <osg/Matrixd>
#include <osg/Node>
#include <osgViewer/Viewer>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace test {

/// Where a picture is taken from. Near and far are used as they are.
struct View {
    int width = 256, height = 256;
    osg::Matrixd view, projection;
};

/// Straight down on z = 0, orthographic: the square [-half, half]² fills the picture, +x to the right and +y up.
View fromAbove(double half, int size = 256);
View perspective(const osg::Vec3d& eye, const osg::Vec3d& centre, int width = 400, int height = 300, double fovy = 40.0,
                 double near = 1.0, double far = 100.0);

/// Colours of a picture, one 0xAABBGGRR a pixel, bottom row first.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint32_t> pixels;

    std::uint32_t at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }
    /// Pixels of grey value `grey`.
    int count(unsigned grey) const;
    /// Pixels that differ from `other` in any bit.
    int different(const Picture& other) const;
};

std::uint32_t grey(unsigned value);

/// A context's picture, or so many of its columns from `left` on.
Picture pictureOf(const gnomon::HeadlessContext& context, int left = 0, int width = 0);

/// Lets a camera look from there, near and far as they are given, upon a dark blue; nothing is left out for being small.
void settle(osg::Camera& camera, const View& view);

/// A viewer without a window, single-threaded, that keeps running: for tests that change a scene between frames.
class Camera {
public:
    Camera(osg::Node* root, const View& view, const gnomon::HeadlessContext::Options& options = {});
    /// Draws one frame.
    Picture frame();
    void setView(const View& view);
    osgViewer::Viewer& viewer() { return _viewer; }
    gnomon::HeadlessContext& context() { return *_context; }

private:
    std::unique_ptr<gnomon::HeadlessContext> _context; // outlives the viewer
    osgViewer::Viewer _viewer;
};

/// While it lives, the OpenGL of a camera's context cannot copy between framebuffers. Draws a frame first.
class NoFramebufferCopies {
public:
    explicit NoFramebufferCopies(Camera& camera);
    ~NoFramebufferCopies();
    NoFramebufferCopies(const NoFramebufferCopies&) = delete;
    NoFramebufferCopies& operator=(const NoFramebufferCopies&) = delete;

private:
    struct Functions;
    std::unique_ptr<Functions> _functions;
};

/// The first frame of a scene.
Picture render(osg::Node* root, const View& view);

} // namespace test
