// SPDX-License-Identifier: MIT
// Framebuffer objects of several colour attachments: lit colours in the first, something else in the next.
#include "GlComplaints.h"

#include <gtest/gtest.h>
#include <support/Scene.h>

#include <osg/BlendFunc>
#include <osg/Program>

#include <cstring>

using namespace test;

namespace {

const View from = perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.5}, 240, 180);

/// Colours under light 0, and normals.
osg::ref_ptr<osg::Program> colorsAndNormals() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(
        osg::Shader::VERTEX, "varying vec3 n; varying vec4 color;\n"
                             "void main() { gl_Position = ftransform(); n = normalize(gl_NormalMatrix * gl_Normal);\n"
                             "  float c = max(dot(n, normalize(gl_LightSource[0].position.xyz)), 0.0);\n"
                             "  color = vec4(0.3, 0.2, 0.1, 1.0) + c * gl_LightSource[0].diffuse; }"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, "varying vec3 n; varying vec4 color;\n"
                                                              "void main() { gl_FragData[0] = vec4(color.rgb, 0.5);\n"
                                                              "  gl_FragData[1] = vec4(0.5 * n + 0.5, 0.5); }"));
    return program;
}

struct Attachments {
    osg::ref_ptr<osg::Image> colors, normals;
    std::vector<std::string> complaints;
};

osg::ref_ptr<osg::Image> blank() {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(from.width, from.height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    image->setInternalTextureFormat(GL_RGBA8);
    return image;
}

/// The third frame. @param spec  empty for no shadow.
Attachments draw(const std::string& spec, bool blends) {
    Scene scene = groundScene({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}, 4.0, {1.0, 0.3, 1.2, 0.0});
    scene.root->getOrCreateStateSet()->setAttribute(colorsAndNormals());
    if (blends)
        find(*scene.root, "ground")
            ->getOrCreateStateSet()
            ->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
    if (!spec.empty()) scene.addShadow(spec);
    Camera camera(scene.root, from);
    Attachments drawn{blank(), blank(), {}};
    osg::Camera& into = *camera.viewer().getCamera();
    into.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    into.attach(osg::Camera::COLOR_BUFFER0, drawn.colors);
    into.attach(osg::Camera::COLOR_BUFFER1, drawn.normals);
    into.attach(osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT);
    const GlComplaints complaints(camera);
    for (int frame = 0; frame < 3; ++frame) camera.frame();
    drawn.complaints = complaints.all();
    return drawn;
}

int different(const osg::Image& a, const osg::Image& b) {
    int count = 0;
    for (unsigned i = 0; i < a.getTotalSizeInBytes(); i += 4) count += std::memcmp(a.data() + i, b.data() + i, 4) != 0;
    return count;
}

class ColorAttachments : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Buffers, ColorAttachments,
                         testing::Values("planar", "planar:receiver=ground", "planar:composite=blend",
                                         "planar:composite=blend,receiver=ground", "map", "map:composite=blend",
                                         "map:edges=smooth", "map:edges=smooth,composite=blend", "traced",
                                         "hull:composite=blend"));

} // namespace

TEST_P(ColorAttachments, ButTheFirstStayAsTheyAre) {
    for (const bool blends : {false, true}) {
        const Attachments bare = draw("", blends), actual = draw(GetParam(), blends);
        EXPECT_GT(different(*actual.colors, *bare.colors), 500) << blends;
        EXPECT_EQ(different(*actual.normals, *bare.normals), 0) << blends;
        EXPECT_EQ(actual.complaints, std::vector<std::string>()) << blends;
    }
}
