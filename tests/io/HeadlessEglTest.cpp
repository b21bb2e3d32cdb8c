// SPDX-License-Identifier: MIT
// What EGL alone has to show; HeadlessContextTest.cpp is run with it too.
#include <gnomon/HeadlessContext.h>

#include <gtest/gtest.h>

#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include <cstdlib>
#include <dlfcn.h>
#include <iostream>

namespace {

using gnomon::HeadlessContext;

TEST(HeadlessEgl, DoesNotLoadOSMesa) {
    HeadlessContext context(8, 8);
    EXPECT_FALSE(dlopen("libOSMesa.so.8", RTLD_NOLOAD | RTLD_NOW));
    EXPECT_FALSE(dlsym(RTLD_DEFAULT, "OSMesaMakeCurrent"));
}

TEST(HeadlessEgl, GivesThirtyTwoDepthBits) {
    HeadlessContext::Options options;
    options.width = options.height = 8;
    options.depthBits = 32;
    HeadlessContext context(options);
    osgViewer::Viewer viewer;
    context.attach(*viewer.getCamera());
    viewer.getCamera()->setClearDepth(0.1);
    viewer.getCamera()->setClearStencil(7);
    viewer.getCamera()->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    viewer.setSceneData(new osg::Group);
    viewer.frame();
    EXPECT_NEAR(reinterpret_cast<const float*>(context.depth()->data())[0], 0.1f, 1e-9);
    EXPECT_EQ(context.stencil()->data()[63], 7);
}

/// A camera that draws into a framebuffer object before the picture, and into whatever is left bound after it.
TEST(HeadlessEgl, DrawsInFloatAfterACameraWithItsOwnBuffers) {
    HeadlessContext::Options options;
    options.width = options.height = 8;
    options.floatColor = true;
    HeadlessContext context(options);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(8, 8);
    texture->setInternalFormat(GL_RGBA);
    osg::ref_ptr<osg::Camera> before = new osg::Camera;
    before->setRenderOrder(osg::Camera::PRE_RENDER);
    before->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    before->attach(osg::Camera::COLOR_BUFFER, texture);
    before->setViewport(0, 0, 8, 8);
    osgViewer::Viewer viewer;
    context.attach(*viewer.getCamera());
    viewer.getCamera()->setClearColor({0.25f, 0.0f, 0.0f, 1.0f});
    viewer.setSceneData(before);
    viewer.frame();
    viewer.getCamera()->setClearColor({0.5f, 0.0f, 0.0f, 1.0f});
    viewer.frame();
    EXPECT_EQ(context.image()->getColor(4, 4)[0], 0.5f);
}

/// The loader of EGL finds no driver: there is no other way to be without one where one is installed.
[[noreturn]] void makeContextWithoutDriver() {
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json", 1);
    try {
        HeadlessContext context(8, 8);
    } catch (const std::runtime_error& error) {
        std::cerr << error.what() << std::endl;
        std::_Exit(1);
    }
    std::_Exit(0);
}

TEST(HeadlessEglDeathTest, SaysInOneSentenceThatThereIsNoDevice) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe"; // a new process, where EGL has not looked yet
    EXPECT_EXIT(makeContextWithoutDriver(), testing::ExitedWithCode(1),
                "^HeadlessContext: EGL finds no device that renders without a display\\. Install [^.]*\\.\n$");
}

} // namespace
