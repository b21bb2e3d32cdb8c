// SPDX-License-Identifier: MIT
#include "DepthPass.h"

#include <osg/Drawable>
#include <osg/Geode>
#include <osg/PolygonOffset>

#include <vector>

namespace gnomon::examples {
namespace {

void clearNearest(int x, int y, int width, int height) {
    glScissor(x, y, width, height);
    glClear(GL_DEPTH_BUFFER_BIT);
}

void drawBorder() {
    constexpr int size = DepthPass::size, width = DepthPass::border;
    glEnable(GL_SCISSOR_TEST);
    glClearDepth(0.0);
    clearNearest(0, 0, size, width);
    clearNearest(0, size - width, size, width);
    clearNearest(0, 0, width, size);
    clearNearest(size - width, 0, width, size);
    glDisable(GL_SCISSOR_TEST);
}

void setUpTexture(osg::Texture2D& texture) {
    texture.setTextureSize(DepthPass::size, DepthPass::size);
    texture.setInternalFormat(GL_DEPTH_COMPONENT16);
    texture.setSourceFormat(GL_DEPTH_COMPONENT);
    texture.setSourceType(GL_UNSIGNED_SHORT);
    texture.setShadowComparison(true);
    texture.setShadowCompareFunc(osg::Texture::LEQUAL);
    for (const auto side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
        texture.setWrap(side, osg::Texture::CLAMP_TO_EDGE);
    for (const auto use : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture.setFilter(use, osg::Texture::LINEAR);
}

void setUpCamera(osg::Camera& camera) {
    camera.setReferenceFrame(osg::Camera::ABSOLUTE_RF);
    camera.setRenderOrder(osg::Camera::PRE_RENDER);
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera.attach(osg::Camera::DEPTH_BUFFER, GLenum(GL_DEPTH_COMPONENT16));
    camera.setViewport(0, 0, DepthPass::size, DepthPass::size);
    camera.setClearMask(GL_DEPTH_BUFFER_BIT);
    camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
    osg::StateSet& set = *camera.getOrCreateStateSet();
    set.setAttribute(new osg::PolygonOffset(1.0f, 0.0f));
    set.setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
}

} // namespace

/// Drawn after all else: the border, then the copy, after which the camera rests.
class DepthPass::Copy : public osg::Drawable {
public:
    Copy(osg::Camera& camera, osg::Texture2D& texture) : _camera(camera), _texture(texture) {
        setCullingActive(false);
        setUseDisplayList(false);
        setSupportsDisplayList(false);
        getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");
    }

    void drawImplementation(osg::RenderInfo& info) const override {
        drawBorder();
        info.getState()->applyTextureAttribute(0, &_texture);
        if (fast)
            glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, size, size);
        else
            copySlowly();
        ++drawn;
        _camera.setNodeMask(0);
    }

    bool fast = true;
    mutable int drawn = 0;

private:
    static void copySlowly() {
        std::vector<GLushort> depths(std::size_t(size) * size);
        glReadPixels(0, 0, size, size, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, depths.data());
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size, size, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, depths.data());
    }

    osg::Camera& _camera; // which this is below
    osg::Texture2D& _texture;
};

DepthPass::DepthPass(osg::Node& scene) : _copy(new Copy(*_camera, *_texture)) {
    setUpTexture(*_texture);
    setUpCamera(*_camera);
    setDisplaced(true);
    _camera->addChild(&scene);
    _camera->addChild(_copy);
}

DepthPass::~DepthPass() = default;

void DepthPass::lookFrom(const osg::Matrixd& view, const osg::Matrixd& projection) {
    constexpr double inner = double(size - 2 * border) / size;
    _camera->setViewMatrix(view);
    _camera->setProjectionMatrix(projection * osg::Matrixd::scale(inner, inner, 1.0));
    redraw();
}

osg::Matrixd DepthPass::textureFromScene() const {
    return _camera->getViewMatrix() * _camera->getProjectionMatrix() * osg::Matrixd::translate(1.0, 1.0, 1.0) *
           osg::Matrixd::scale(0.5, 0.5, 0.5);
}

void DepthPass::setDisplaced(bool on) {
    _camera->getStateSet()->setMode(GL_POLYGON_OFFSET_FILL, on);
    redraw();
}

void DepthPass::setFastCopy(bool on) {
    _copy->fast = on;
    redraw();
}

int DepthPass::drawn() const { return _copy->drawn; }

} // namespace gnomon::examples
