// SPDX-License-Identifier: MIT
#include "AddedLamps.h"
#include "Mesh.h"
#include "Paint.h"

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Drawable>
#include <osg/Geode>
#include <osg/LightModel>
#include <osg/PolygonOffset>
#include <osg/Program>

#include <added_lamp_shaders.h>
#include <cmath>
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

constexpr auto forced = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

osg::ref_ptr<osg::Program> additiveProgram() {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, added_lamp::additive_frag));
    return program;
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

AddedLamp::AddedLamp(int number, osg::Node& things, osg::Node& casters) : _map(std::make_unique<DepthPass>(casters)) {
    osg::Light& light = *_source->getLight();
    light.setLightNum(number);
    light.setAmbient(osg::Vec4(0.1f, 0.1f, 0.1f, 1.0f));
    const double half = zNear * std::sin(osg::DegreesToRadians(fieldOfView / 2.0));
    _box->addChild(examples::node(examples::box({-half, -half, 0.01 - zNear}, {half, half, 0.0})));
    _inMap->setTextureUnit(static_cast<unsigned>(number) + 1);
    _inMap->getTexGen()->setMode(osg::TexGen::EYE_LINEAR);
    _pass->addChild(&things);
    setUpPass(number);
    for (osg::Node* child : {static_cast<osg::Node*>(_source), static_cast<osg::Node*>(_inMap),
                             static_cast<osg::Node*>(_pass), static_cast<osg::Node*>(_map->camera())})
        _node->addChild(child);
}

void AddedLamp::setUpPass(int number) {
    const unsigned unit = static_cast<unsigned>(number) + 1; // 0 is the objects' own
    const bool first = number == 0;
    osg::StateSet& set = *_pass->getOrCreateStateSet();
    set.setMode(GL_LIGHT0 + static_cast<GLenum>(number), forced);
    set.setAttributeAndModes(new osg::Depth(first ? osg::Depth::LEQUAL : osg::Depth::EQUAL, 0.0, 1.0, first), forced);
    set.setAttributeAndModes(new osg::BlendFunc(GL_ONE, first ? GL_ZERO : GL_ONE), forced);
    set.setRenderBinDetails(number, "RenderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
    set.setTextureAttribute(unit, _map->texture());
    for (const GLenum mode : {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q})
        set.setTextureMode(unit, mode, osg::StateAttribute::ON);
    set.setAttributeAndModes(additiveProgram(), forced);
    set.addUniform(new osg::Uniform("own", 0));
    set.addUniform(new osg::Uniform("map", static_cast<int>(unit)));
    set.addUniform(new osg::Uniform("unit", static_cast<int>(unit)));
}

void AddedLamp::place(const osg::Matrixd& view) {
    const osg::Matrixd back = osg::Matrixd::inverse(view);
    _source->getLight()->setPosition(osg::Vec4(osg::Vec4d(back.getTrans(), 1.0)));
    _box->setMatrix(back);
    _map->lookFrom(view, osg::Matrixd::perspective(fieldOfView, 1.0, zNear, zFar));
    _inMap->getTexGen()->setPlanesFromMatrix(_map->textureFromScene());
}

void AddedLamp::setColor(const osg::Vec3& color, float share) {
    paintedUnlit(_box, osg::Vec4(color, 1.0f));
    _source->getLight()->setDiffuse(osg::Vec4(color * share, 1.0f));
    _source->getLight()->setSpecular(osg::Vec4(color * share, 1.0f));
}

AddedLamps::AddedLamps(osg::Node& things, int count) {
    osg::ref_ptr<osg::Group> casters = new osg::Group;
    casters->addChild(&things);
    casters->addChild(_boxes);
    for (int i = 0; i < count; ++i) {
        AddedLamp& lamp = _lamps.emplace_back(i, things, *casters);
        _boxes->addChild(lamp.box());
        _node->addChild(lamp.node());
    }
    osg::StateSet& set = *_node->getOrCreateStateSet();
    osg::ref_ptr<osg::LightModel> dark = new osg::LightModel;
    dark->setAmbientIntensity(osg::Vec4(0, 0, 0, 1));
    set.setAttributeAndModes(dark);
    set.setMode(GL_LIGHTING, osg::StateAttribute::ON);
    set.setMode(GL_NORMALIZE, osg::StateAttribute::ON);
    set.setTextureAttributeAndModes(0, drawnTexture(1, [](int, int) { return osg::Vec3(1, 1, 1); }));
    set.addUniform(_bias);
    set.addUniform(_bicubic);
    setUpView(*casters);
    _node->addChild(_boxes);
}

void AddedLamps::setUpView(osg::Node& casters) {
    _view->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
    _view->setRenderOrder(osg::Camera::POST_RENDER);
    _view->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    _view->setAllowEventFocus(false);
    _view->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setReferenceFrame(osg::LightSource::ABSOLUTE_RF); // where it is seen from
    osg::Light& light = *source->getLight();
    light.setPosition(osg::Vec4(0, 0, 0, 1));
    light.setAmbient(osg::Vec4(0.1f, 0.1f, 0.1f, 1.0f));
    light.setDiffuse(osg::Vec4(0.6f, 0.6f, 0.6f, 1.0f));
    light.setSpecular(osg::Vec4(0.5f, 0.5f, 0.5f, 1.0f));
    _view->getOrCreateStateSet()->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    _view->addChild(source);
    _view->addChild(&casters);
    _node->addChild(_view);
    showView(false);
}

void AddedLamps::shineOn(ShadowCasterGroup& group) {
    for (AddedLamp& lamp : _lamps) {
        const auto number = static_cast<GLenum>(lamp.source()->getLight()->getLightNum());
        group.addLight(lamp.source());
        group.getOrCreateStateSet()->setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
    }
}

void AddedLamps::setMaps(bool fastCopy, bool displaced) {
    for (AddedLamp& lamp : _lamps) {
        lamp.map().setFastCopy(fastCopy);
        lamp.map().setDisplaced(displaced);
    }
}

std::string AddedLamps::mapsDrawn() const {
    std::string text = "maps drawn:";
    for (const AddedLamp& lamp : _lamps) text += " " + std::to_string(lamp.map().drawn());
    return text;
}

void AddedLamps::showPasses(bool on) {
    for (AddedLamp& lamp : _lamps) lamp.showPass(on);
}

void AddedLamps::lookFrom(const osg::Matrixd& view, double aspect) {
    _view->setViewMatrix(view);
    _view->setProjectionMatrixAsPerspective(AddedLamp::fieldOfView, aspect, AddedLamp::zNear, AddedLamp::zFar);
}

} // namespace gnomon::examples
