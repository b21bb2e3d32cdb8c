// SPDX-License-Identifier: MIT
#include <gnomon/HeadlessContext.h>

#include <gtest/gtest.h>

#include <osg/Geometry>
#include <osg/ShapeDrawable>
#include <osg/Stencil>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Viewer>

#include <algorithm>
#include <set>

namespace {

using gnomon::HeadlessContext;

HeadlessContext::Options sized(int width, int height) {
    HeadlessContext::Options options;
    options.width = width;
    options.height = height;
    return options;
}

/// What the constructor says; empty if it makes a context.
std::string refusal(const HeadlessContext::Options& options) {
    try {
        HeadlessContext context(options);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

/// Unlit square over [-half, half]² in z = 0, to be seen through an identity view.
osg::ref_ptr<osg::Geometry> square(float half, const osg::Vec4& color) {
    osg::ref_ptr<osg::Geometry> quad = osg::createTexturedQuadGeometry(
        osg::Vec3(-half, -half, 0.0f), osg::Vec3(2 * half, 0.0f, 0.0f), osg::Vec3(0.0f, 2 * half, 0.0f));
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(1, &color);
    quad->setColorArray(colors, osg::Array::BIND_OVERALL);
    quad->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    return quad;
}

void lookAlongZ(osg::Camera& camera) {
    camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setClearColor(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
    camera.setViewMatrix(osg::Matrixd());
    camera.setProjectionMatrixAsOrtho(-1, 1, -1, 1, -1, 1);
}

void drawOnce(const HeadlessContext& context, osg::Node* scene) {
    osgViewer::Viewer viewer;
    context.attach(*viewer.getCamera());
    lookAlongZ(*viewer.getCamera());
    viewer.setSceneData(scene);
    viewer.frame();
}

long countRed(const osg::Image& image) {
    long count = 0;
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x) count += image.getColor(x, y)[0] > 0.5f;
    return count;
}

TEST(HeadlessContext, DrawsInTheFirstFrame) {
    HeadlessContext context(64, 64);
    drawOnce(context, square(0.5f, osg::Vec4(1, 0, 0, 1)));
    EXPECT_EQ(countRed(*context.image()), 32 * 32);
    EXPECT_FALSE(context.renderer().empty());
}

TEST(HeadlessContext, KeepsTheBottomRowFirst) {
    HeadlessContext context(8, 8);
    osg::ref_ptr<osg::Geometry> lower = square(1.0f, osg::Vec4(1, 0, 0, 1));
    for (osg::Vec3& vertex : static_cast<osg::Vec3Array&>(*lower->getVertexArray()))
        vertex.y() = std::min(vertex.y(), 0.0f);
    drawOnce(context, lower);
    EXPECT_GT(context.image()->getColor(4, 0)[0], 0.5f);
    EXPECT_LT(context.image()->getColor(4, 7)[0], 0.5f);
}

TEST(HeadlessContext, KeepsColoursAboveOneInFloat) {
    HeadlessContext::Options options = sized(16, 16);
    options.floatColor = true;
    HeadlessContext context(options);
    osg::ref_ptr<osg::Geometry> quad = square(1.0f, osg::Vec4(1, 1, 1, 1));
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT, "void main() { gl_FragColor = vec4(2.5, 0.1, 0.0, 1.0); }"));
    quad->getOrCreateStateSet()->setAttributeAndModes(program);
    drawOnce(context, quad);
    const osg::Vec4 seen = context.image()->getColor(8, 8);
    EXPECT_EQ(context.image()->getDataType(), GLenum(GL_FLOAT));
    EXPECT_FLOAT_EQ(seen[0], 2.5f);
    EXPECT_FLOAT_EQ(seen[1], 0.1f);
}

TEST(HeadlessContext, ShowsDepthAndStencil) {
    HeadlessContext context(17, 9);
    osg::ref_ptr<osg::Geometry> quad = square(2.0f, osg::Vec4(1, 1, 1, 1));
    osg::ref_ptr<osg::Stencil> stencil = new osg::Stencil;
    stencil->setFunction(osg::Stencil::ALWAYS, 0x5a, ~0u);
    stencil->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::REPLACE);
    quad->getOrCreateStateSet()->setAttributeAndModes(stencil);
    drawOnce(context, quad);
    EXPECT_NEAR(reinterpret_cast<const float*>(context.depth()->data())[20], 0.5f, 1e-6f);
    EXPECT_EQ(context.stencil()->data()[17 * 9 - 1], 0x5a);
}

TEST(HeadlessContext, HasNoStencilWhenNoneIsAsked) {
    HeadlessContext::Options options = sized(8, 8);
    options.stencilBits = 0;
    HeadlessContext context(options);
    drawOnce(context, square(1.0f, osg::Vec4(1, 0, 0, 1)));
    EXPECT_EQ(countRed(*context.image()), 64);
    EXPECT_EQ(context.stencil()->data()[0], 0);
}

TEST(HeadlessContext, ServesTwoCamerasOfOneCompositeViewer) {
    HeadlessContext context(64, 32);
    osgViewer::CompositeViewer viewer;
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
        viewer.addView(view);
        context.attach(*view->getCamera(), new osg::Viewport(32 * i, 0, 32, 32));
        lookAlongZ(*view->getCamera());
        view->setSceneData(square(i ? 0.25f : 0.5f, osg::Vec4(1, 0, 0, 1)));
    }
    viewer.frame();
    EXPECT_EQ(countRed(*context.image()), 16 * 16 + 8 * 8);
}

TEST(HeadlessContext, TwoContextsTakeTurns) {
    HeadlessContext left(16, 16), right(32, 32);
    osgViewer::Viewer a, b;
    left.attach(*a.getCamera());
    right.attach(*b.getCamera());
    osg::ref_ptr<osg::Geometry> scene = square(0.5f, osg::Vec4(1, 0, 0, 1));
    for (osgViewer::Viewer* viewer : {&a, &b}) lookAlongZ(*viewer->getCamera()), viewer->setSceneData(scene);
    for (int frame = 0; frame < 3; ++frame) {
        a.frame();
        b.frame();
        EXPECT_EQ(countRed(*left.image()), 64);
        EXPECT_EQ(countRed(*right.image()), 256);
    }
}

TEST(HeadlessContext, ReadingOnePictureLeavesAnothersContextCurrent) {
    HeadlessContext drawn(16, 16), other(8, 8);
    osgViewer::Viewer viewer;
    drawn.attach(*viewer.getCamera());
    lookAlongZ(*viewer.getCamera());
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    viewer.setSceneData(scene);
    viewer.setReleaseContextAtEndOfFrameHint(false);
    viewer.frame();
    EXPECT_EQ(countRed(*other.image()), 0);
    scene->addChild(square(0.5f, osg::Vec4(1, 0, 0, 1)));
    viewer.frame();
    EXPECT_EQ(countRed(*drawn.image()), 64);
}

TEST(HeadlessContext, OneSceneIsDrawnByAContextAfterTheOther) {
    osg::ref_ptr<osg::Geometry> scene = square(0.5f, osg::Vec4(1, 0, 0, 1));
    std::set<unsigned> numbers;
    for (int i = 0; i < 5; ++i) {
        HeadlessContext context(16, 16);
        numbers.insert(context.graphicsContext()->getState()->getContextID());
        drawOnce(context, scene);
        EXPECT_EQ(countRed(*context.image()), 64);
    }
    EXPECT_EQ(numbers.size(), 1u) << "each context gives its number back";
}

TEST(HeadlessContext, RefusesASecondViewer) {
    HeadlessContext context(16, 16);
    drawOnce(context, square(0.5f, osg::Vec4(1, 0, 0, 1)));
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    EXPECT_THROW(context.attach(*camera), std::logic_error);
}

TEST(HeadlessContext, GivesAPerspectiveCameraTheAspectOfThePicture) {
    HeadlessContext context(200, 100);
    osgViewer::Viewer viewer;
    viewer.getCamera()->setProjectionMatrixAsPerspective(40, 1, 1, 10);
    context.attach(*viewer.getCamera());
    double fovy, aspect, zNear, zFar;
    ASSERT_TRUE(viewer.getCamera()->getProjectionMatrixAsPerspective(fovy, aspect, zNear, zFar));
    EXPECT_NEAR(aspect, 2.0, 1e-12);
    EXPECT_NEAR(fovy, 40.0, 1e-9);
    EXPECT_EQ(viewer.getThreadingModel(), osgViewer::Viewer::SingleThreaded);
    context.attach(*viewer.getCamera(), new osg::Viewport(0, 0, 50, 100));
    ASSERT_TRUE(viewer.getCamera()->getProjectionMatrixAsPerspective(fovy, aspect, zNear, zFar));
    EXPECT_NEAR(aspect, 0.5, 1e-12) << "of its part";
}

TEST(HeadlessContext, RefusesSizesAndBitsInOneSentence) {
    EXPECT_EQ(refusal(sized(0, 10)),
              "HeadlessContext: a picture of 0x10 pixels cannot be made. Allowed: 1x1 to 16384x16384.");
    EXPECT_NE(refusal(sized(1000000, 1000000)), "");
    HeadlessContext::Options options;
    options.stencilBits = 4;
    EXPECT_EQ(refusal(options), "HeadlessContext: 4 stencil bits cannot be had. Allowed: 0, 8.");
    options = {};
    options.depthBits = 7;
    EXPECT_EQ(refusal(options), "HeadlessContext: 7 depth bits cannot be had. Allowed: 16, 24, 32.");
}

} // namespace
