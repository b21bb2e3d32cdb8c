// SPDX-License-Identifier: MIT
#include "IntoTexture.h"

#include <osg/GLExtensions>
#include <osg/Geometry>

namespace test {
namespace {

void prepare(osg::Texture2D& texture, const Target& target, const View& view) {
    texture.setTextureSize(view.width, view.height);
    texture.setInternalFormat(static_cast<GLint>(target.color));
    texture.setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture.setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
}

osg::ref_ptr<osg::Camera> cameraInto(osg::Texture2D* texture, const Target& target, const View& view,
                                     osg::Node* scene) {
    osg::ref_ptr<osg::Camera> into = new osg::Camera;
    into->setRenderOrder(osg::Camera::PRE_RENDER);
    into->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    into->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    into->setViewport(0, 0, view.width, view.height);
    into->setViewMatrix(view.view);
    into->setProjectionMatrix(view.projection);
    into->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    into->setClearColor({0.0f, 0.0f, 0.25f, 1.0f});
    into->attach(osg::Camera::COLOR_BUFFER0, texture, 0, 0, false, target.samples, target.samples);
    into->attach(target.depth, target.depthFormat);
    if (target.samples) into->setImplicitBufferAttachmentMask(0, 0);
    into->addChild(scene);
    return into;
}

osg::ref_ptr<osg::Camera> show(osg::Texture2D* texture) {
    osg::ref_ptr<osg::Geometry> quad =
        osg::createTexturedQuadGeometry({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.0f, 0.0f, 1.0f, 1.0f);
    quad->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
    quad->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    osg::ref_ptr<osg::Camera> over = new osg::Camera;
    over->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    over->setProjectionMatrix(osg::Matrixd::ortho2D(0.0, 1.0, 0.0, 1.0));
    over->setRenderOrder(osg::Camera::NESTED_RENDER);
    over->addChild(quad);
    return over;
}

} // namespace

IntoTexture::IntoTexture(osg::Node* scene, const View& view, const Target& target, bool besideTheScene) {
    prepare(*texture, target, view);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    into = cameraInto(texture, target, view, scene);
    root->addChild(into);
    const osg::ref_ptr<osg::Camera> shown = show(texture);
    root->addChild(shown);
    View window = view;
    if (besideTheScene) {
        root->addChild(scene);
        window.width *= 2;
        shown->setRenderOrder(osg::Camera::POST_RENDER);
        shown->setViewport(view.width, 0, view.width, view.height);
    }
    camera = std::make_unique<Camera>(root, window);
    camera->viewer().getCamera()->setViewport(0, 0, view.width, view.height);
    complaints = std::make_unique<GlComplaints>(*camera);
    osg::GraphicsContext& context = *camera->context().graphicsContext();
    context.getState()->get<osg::GLExtensions>()->glRenderbufferStorageMultisampleCoverageNV = nullptr; // a stub
}

} // namespace test
