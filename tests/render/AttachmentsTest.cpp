// SPDX-License-Identifier: MIT
// Framebuffer objects of several colour attachments: lit colours in the first, something else in the next.
#include "GlComplaints.h"
#include "TwoGrounds.h"

#include <osg/BlendFunc>
#include <osg/Program>
#include <osg/Texture2DArray>

#include <algorithm>
#include <cstring>

using namespace test;

namespace {

const View from = perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.5}, 240, 180);

/// Colours under light 0, and normals.
osg::ref_ptr<osg::Program> colorsAndNormals() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(
        osg::Shader::VERTEX, litColor + std::string("varying vec3 n; varying vec4 color;\n"
                                                    "void main() { gl_Position = ftransform(); color = litColor();\n"
                                                    "  n = normalize(gl_NormalMatrix * gl_Normal); }")));
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

/// Has OpenGL read from an attachment from there on.
struct Reads : osg::Drawable {
    explicit Reads(GLenum of = GL_COLOR_ATTACHMENT0_EXT) : attachment(of) {
        setSupportsDisplayList(false);
        setCullingActive(false);
    }
    Reads(const Reads& other, const osg::CopyOp& copyOp) : osg::Drawable(other, copyOp), attachment(other.attachment) {}
    META_Object(test, Reads)
    void drawImplementation(osg::RenderInfo&) const override { glReadBuffer(attachment); }
    const GLenum attachment;
};

/// The third frame. @param spec  empty for no shadow.
Attachments draw(const std::string& spec, bool blends, GLenum read = 0) {
    Scene scene = groundScene({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}, 4.0, {1.0, 0.3, 1.2, 0.0});
    scene.root->getOrCreateStateSet()->setAttribute(colorsAndNormals());
    if (blends)
        find(*scene.root, "ground")
            ->getOrCreateStateSet()
            ->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
    if (!spec.empty()) scene.addShadow(spec);
    if (read) scene.root->addChild(new Reads(read));
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

/// Both layers of a texture array in the third frame, and what the technique says. @param spec  empty for no shadow.
std::vector<std::uint32_t> layers(const std::string& spec, std::vector<std::string>& causes) {
    Scene scene = groundScene({box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0})}, 4.0, {1.0, 0.3, 1.2, 0.0});
    osg::ref_ptr<osg::Program> twice = new osg::Program;
    twice->addShader(new osg::Shader(
        osg::Shader::VERTEX,
        std::string("#version 150 compatibility\nout vec4 lit;\n") + litColor +
            "void main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; lit = litColor(); }"));
    twice->addShader(
        new osg::Shader(osg::Shader::GEOMETRY,
                        "#version 150 compatibility\nlayout(triangles) in; in vec4 lit[]; out vec4 color;\n"
                        "layout(triangle_strip, max_vertices = 6) out;\n"
                        "void main() { for (int i = 0; i < 6; ++i) { gl_Layer = i / 3; color = lit[i % 3];\n"
                        "  gl_Position = gl_in[i % 3].gl_Position; EmitVertex(); if (i == 2) EndPrimitive(); } }"));
    twice->addShader(new osg::Shader(osg::Shader::FRAGMENT, "#version 150 compatibility\nin vec4 color;\n"
                                                            "void main() { gl_FragColor = color; }"));
    scene.content->getOrCreateStateSet()->setAttribute(twice);
    if (!spec.empty()) scene.addShadow(spec);
    Camera camera(scene.root, from);
    osg::Camera& into = *camera.viewer().getCamera();
    into.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    const auto attach = [&](osg::Camera::BufferComponent buffer, GLint format, GLenum source, GLenum type) {
        osg::ref_ptr<osg::Texture2DArray> array = new osg::Texture2DArray;
        array->setTextureSize(from.width, from.height, 2);
        array->setInternalFormat(format);
        array->setSourceFormat(source);
        array->setSourceType(type);
        array->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
        into.attach(buffer, array, 0, osg::Camera::FACE_CONTROLLED_BY_GEOMETRY_SHADER);
        return array;
    };
    const auto colors = attach(osg::Camera::COLOR_BUFFER, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
    attach(osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, GL_DEPTH_STENCIL_EXT,
           GL_UNSIGNED_INT_24_8_EXT);
    for (int frame = 0; frame < 3; ++frame) camera.frame();
    osg::GraphicsContext& context = *camera.context().graphicsContext();
    context.makeCurrent();
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(from.width * from.height * 2));
    colors->getTextureObject(context.getState()->getContextID())->bind();
    glGetTexImage(GL_TEXTURE_2D_ARRAY_EXT, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    if (!spec.empty()) causes = dynamic_cast<gnomon::ShadowTechnique&>(*scene.group->getChild(1)).diagnose();
    return pixels;
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
                                         "hull:composite=blend", "volume:edges=smooth",
                                         "planar:edges=smooth,composite=blend", "traced:edges=smooth"));

} // namespace

TEST_P(ColorAttachments, ButTheFirstStayAsTheyAre) {
    for (const bool blends : {false, true}) {
        const Attachments bare = draw("", blends), actual = draw(GetParam(), blends);
        EXPECT_GT(different(*actual.colors, *bare.colors), 500) << blends;
        EXPECT_EQ(different(*actual.normals, *bare.normals), 0) << blends;
        EXPECT_EQ(actual.complaints, std::vector<std::string>()) << blends;
    }
}

TEST_P(ColorAttachments, WhicheverIsReadTheShadowsAreTheSame) {
    const Attachments usual = draw(GetParam(), false, GL_COLOR_ATTACHMENT0_EXT),
                      actual = draw(GetParam(), false, GL_COLOR_ATTACHMENT1_EXT);
    EXPECT_EQ(different(*actual.colors, *usual.colors), 0);
    EXPECT_EQ(actual.complaints, std::vector<std::string>());
}

// Whatever marks do, they lie in the first layer: the second would be lit where the first is not.
TEST(LayeredFramebuffer, HasAShadowInNoLayerAndSaysSo) {
    std::vector<std::string> causes;
    const std::vector<std::uint32_t> lit = layers("", causes);
    ASSERT_FALSE(std::equal(lit.begin(), lit.begin() + from.width, lit.begin() + from.width * from.height / 2));
    ASSERT_TRUE(
        std::equal(lit.begin(), lit.begin() + from.width * from.height, lit.begin() + from.width * from.height));
    for (const std::string spec :
         {"planar:composite=blend", "map", "map:edges=smooth", "volume:composite=blend", "auto"}) {
        EXPECT_TRUE(layers(spec, causes) == lit) << spec;
        const auto says = [](const std::string& cause) { return cause.find("has layers") != std::string::npos; };
        EXPECT_TRUE(std::any_of(causes.begin(), causes.end(), says)) << spec;
    }
}
