// SPDX-License-Identifier: MIT
#pragma once
#include "GlComplaints.h"

#include <support/Scene.h>

#include <gnomon/EffectNode.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace test {

/// Depth is as without an effect, stencil is zero, and OpenGL has nothing against it.
/// @param root  holds it.
/// @param set   switches it on and off.
template <class Switch>
void expectNothingIsLeft(osg::Node* root, const View& view, const Switch& set) {
    Camera camera(root, view);
    GlComplaints complaints(camera);
    set(false);
    camera.frame();
    const osg::ref_ptr<osg::Image> depth = camera.context().depth();
    set(true);
    for (int i = 0; i < 2; ++i) camera.frame();
    EXPECT_EQ(complaints.all(), std::vector<std::string>());
    const osg::ref_ptr<osg::Image> after = camera.context().depth(), bits = camera.context().stencil();
    EXPECT_EQ(std::memcmp(depth->data(), after->data(), depth->getTotalSizeInBytes()), 0);
    EXPECT_TRUE(std::all_of(bits->data(), bits->data() + bits->getTotalSizeInBytes(), [](int b) { return b == 0; }));
}

/// One stencil bit is enough, or a framebuffer of Gnomon's own; where there is neither, it says so.
/// @param root     holds the effect.
/// @param without  the picture without it.
inline void expectOneBitIsEnough(osg::Node* root, const gnomon::EffectNode& effect, const View& view,
                                 const Picture& without) {
    const Picture with = render(root, view);
    gnomon::HeadlessContext::Options none;
    none.stencilBits = 0;
    EXPECT_EQ(Camera(root, view, none).frame().different(with), 0) << "without stencil bits";
    for (const unsigned reserved : {0x7fu, 0xfeu})
        EXPECT_EQ(render(reserving(root, reserved), view).different(with), 0) << reserved;
    reserving(root, 0xffu);
    Camera camera(root, view);
    EXPECT_EQ(camera.frame().different(with), 0) << "it works in a framebuffer of its own";
    camera.frame(); // the first has the number of the frames before, whose causes may count as another view's
    EXPECT_EQ(effect.diagnose(), std::vector<std::string>());
    const NoFramebufferCopies copies(camera);
    EXPECT_EQ(camera.frame().different(without), 0);
    ASSERT_FALSE(effect.diagnose().empty());
    EXPECT_NE(effect.diagnose().back().find("every stencil bit is reserved"), std::string::npos);
    reserving(root, 0u);
}

} // namespace test
