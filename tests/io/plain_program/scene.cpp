// SPDX-License-Identifier: MIT
// A box on a ground, lit by a sun, seen straight from above: 0.025 of the scene's unit a pixel. With `moving` the
// box runs along x, 15 units a second. With `empty` nothing is shown, as where a model is missing. With `multisampled` the window
// has four samples a pixel and no stencil; `samples` ends at once, with 0 if the X server has such a window.
#include <osg/Geode>
#include <osg/GraphicsContext>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osg/ShapeDrawable>
#include <osgViewer/Viewer>

#include <iostream>
#include <string>

#ifndef GL_SAMPLES
#define GL_SAMPLES 0x80A9
#endif

struct RunAlongX : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        const double x = 15.0 * visitor->getFrameStamp()->getSimulationTime();
        static_cast<osg::MatrixTransform*>(node)->setMatrix(osg::Matrix::translate(x, 0, 0));
        traverse(node, visitor);
    }
};

osg::GraphicsContext* multisampledWindow() {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY(); // else it is a window of the first X server
    traits->width = 320;
    traits->height = 240;
    traits->doubleBuffer = true;
    traits->sampleBuffers = 1;
    traits->samples = 4;
    return osg::GraphicsContext::createGraphicsContext(traits);
}

struct TellWindow : osg::GraphicsOperation {
    TellWindow() : osg::GraphicsOperation("TellWindow", false) {}
    void operator()(osg::GraphicsContext*) override {
        GLint samples = 0, stencil = 0;
        glGetIntegerv(GL_SAMPLES, &samples);
        glGetIntegerv(GL_STENCIL_BITS, &stencil);
        std::cout << samples << " samples, " << stencil << " stencil bits" << std::endl;
    }
};

int main(int argc, char** argv) {
    const std::string shown = argc > 1 ? argv[1] : "";
    if (shown == "samples") return multisampledWindow() ? 0 : 1;
    osg::ref_ptr<osg::Geode> ground = new osg::Geode, box = new osg::Geode;
    ground->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, -0.5f), 20, 20, 1)));
    box->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, 0.5f), 1, 1, 1)));
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->addChild(box);
    if (shown == "moving") place->setUpdateCallback(new RunAlongX);
    osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
    sun->getLight()->setPosition(osg::Vec4(2, -1, 2, 0));
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(sun);
    root->addChild(ground);
    root->addChild(place);
    osgViewer::Viewer viewer;
    viewer.setLightingMode(osg::View::NO_LIGHT);
    if (shown == "multisampled") {
        viewer.getCamera()->setGraphicsContext(multisampledWindow());
        viewer.getCamera()->setViewport(0, 0, 320, 240);
        viewer.setRealizeOperation(new TellWindow);
    } else {
        viewer.setUpViewInWindow(0, 0, 320, 240);
    }
    viewer.getCamera()->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    viewer.getCamera()->setProjectionMatrixAsOrtho(-4, 4, -3, 3, 1, 20);
    viewer.getCamera()->setViewMatrixAsLookAt(osg::Vec3d(0, 0, 10), osg::Vec3d(), osg::Vec3d(0, 1, 0));
    root->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    root->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    viewer.setSceneData(shown == "empty" ? nullptr : root.get());
    while (!viewer.done()) viewer.frame();
    return 0;
}
