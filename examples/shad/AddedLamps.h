// SPDX-License-Identifier: MIT
#pragma once
#include "Mesh.h"

#include <gnomon/ShadowCasterGroup.h>

#include <osg/BlendFunc>
#include <osg/Camera>
#include <osg/Depth>
#include <osg/Drawable>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/TexGenNode>
#include <osg/Texture2D>

#include <added_lamp_shaders.h>
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::examples {

/// A scene's depths as a lamp sees them, in a texture of 512 × 512 texels of 16 bits: drawn into a framebuffer of its own
/// when they are asked for, inside a border of 2 texels of the nearest depth, and copied from there.
///
/// Limits  one context, one thread. A bias at look-up leaves light on what is closer behind its blocker than it.
/// Source: CS-4470, part 2, newshadowmap() of shad.c.
class DepthPass {
public:
    static constexpr int size = 512, border = 2; ///< texels.

    explicit DepthPass(osg::Node& scene) : _copy(new Copy(*_camera, *_texture)) {
        setUpTexture(*_texture);
        setUpCamera(*_camera);
        setDisplaced(true);
        _camera->addChild(&scene);
        _camera->addChild(_copy);
    }

    ~DepthPass() = default;
    DepthPass(const DepthPass&) = delete;
    DepthPass& operator=(const DepthPass&) = delete;

    /// To be put into the graph, above no transform that counts.
    osg::Camera* camera() { return _camera; }
    /// Compares: a look-up says whether a depth is at most that of the map, weighted over 2 × 2 texels.
    osg::Texture2D* texture() { return _texture; }

    /// Draws it anew in the next frame, from elsewhere or as it was.
    void lookFrom(const osg::Matrixd& view, const osg::Matrixd& projection) {
        constexpr double inner = double(size - 2 * border) / size;
        _camera->setViewMatrix(view);
        _camera->setProjectionMatrix(projection * osg::Matrixd::scale(inner, inner, 1.0));
        redraw();
    }

    void redraw() { _camera->setNodeMask(~0u); }
    /// Where in the texture a point is, and how deep: 0 … 1 each after division by w.
    osg::Matrixd textureFromScene() const {
        return _camera->getViewMatrix() * _camera->getProjectionMatrix() * osg::Matrixd::translate(1.0, 1.0, 1.0) *
               osg::Matrixd::scale(0.5, 0.5, 0.5);
    }

    /// Draws surfaces deeper by as much as their slope changes depth within a texel. Default on.
    void setDisplaced(bool on) {
        _camera->getStateSet()->setMode(GL_POLYGON_OFFSET_FILL, on);
        redraw();
    }

    /// Copies from framebuffer to texture without the CPU between; default on. Off: read back and sent again.
    void setFastCopy(bool on) {
        _copy->fast = on;
        redraw();
    }

    /// How often it was drawn.
    int drawn() const { return _copy->drawn; }

private:
    /// Drawn after all else: the border, then the copy, after which the camera rests.
    class Copy : public osg::Drawable {
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

    static void clearNearest(int x, int y, int width, int height) {
        glScissor(x, y, width, height);
        glClear(GL_DEPTH_BUFFER_BIT);
    }

    static void drawBorder() {
        constexpr int width = border;
        glEnable(GL_SCISSOR_TEST);
        glClearDepth(0.0);
        clearNearest(0, 0, size, width);
        clearNearest(0, size - width, size, width);
        clearNearest(0, 0, width, size);
        clearNearest(size - width, 0, width, size);
        glDisable(GL_SCISSOR_TEST);
    }

    static void setUpTexture(osg::Texture2D& texture) {
        texture.setTextureSize(size, size);
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

    static void setUpCamera(osg::Camera& camera) {
        camera.setReferenceFrame(osg::Camera::ABSOLUTE_RF);
        camera.setRenderOrder(osg::Camera::PRE_RENDER);
        camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
        camera.attach(osg::Camera::DEPTH_BUFFER, GLenum(GL_DEPTH_COMPONENT16));
        camera.setViewport(0, 0, size, size);
        camera.setClearMask(GL_DEPTH_BUFFER_BIT);
        camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        camera.setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
        osg::StateSet& set = *camera.getOrCreateStateSet();
        set.setAttribute(new osg::PolygonOffset(1.0f, 0.0f));
        set.setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    }

    osg::ref_ptr<osg::Camera> _camera = new osg::Camera;
    osg::ref_ptr<osg::Texture2D> _texture = new osg::Texture2D;
    osg::ref_ptr<Copy> _copy;
};

/// One of several spotlights that have a depth map and a pass each: the first pass draws, the others are added to it, so
/// that each light's shadow keeps what the others send. A map modulates all of its pass, so the shadow takes the light's
/// own ambient light, too. Outside its map, a square, a lamp gives no light.
///
/// Source: CS-4470, part 2, drawit() of shad.c.
class AddedLamp {
public:
    static constexpr double zNear = 0.1, zFar = 10.0, fieldOfView = 40.0; ///< of its map, degrees.
    static constexpr int most = 4;

    /// @param number  0 … most - 1: OpenGL's light; 0 is the first pass. @param things  what it lights.
    /// @param casters  what its map holds.
    AddedLamp(int number, osg::Node& things, osg::Node& casters) : _map(std::make_unique<DepthPass>(casters)) {
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

    /// Light and pass, to be put beside the others'. Above it are uniforms "bias" (float: of depth at look-up, -1 … 1 from
    /// near to far) and "bicubic" (bool: 4 × 4 texels instead of 2 × 2).
    osg::Group* node() { return _node; }
    osg::LightSource* source() { return _source; }
    /// A small box in the lamp's colour, before its near plane.
    osg::Node* box() { return _box; }
    DepthPass& map() { return *_map; }
    const DepthPass& map() const { return *_map; }

    /// The map is drawn anew. @param view  of the things, from the lamp.
    void place(const osg::Matrixd& view) {
        const osg::Matrixd back = osg::Matrixd::inverse(view);
        _source->getLight()->setPosition(osg::Vec4(osg::Vec4d(back.getTrans(), 1.0)));
        _box->setMatrix(back);
        _map->lookFrom(view, osg::Matrixd::perspective(fieldOfView, 1.0, zNear, zFar));
        _inMap->getTexGen()->setPlanesFromMatrix(_map->textureFromScene());
    }

    /// @param share  of the colour that it sends out.
    void setColor(const osg::Vec3& color, float share) {
        paintedUnlit(_box, osg::Vec4(color, 1.0f));
        _source->getLight()->setDiffuse(osg::Vec4(color * share, 1.0f));
        _source->getLight()->setSpecular(osg::Vec4(color * share, 1.0f));
    }

    void showPass(bool on) { _pass->setNodeMask(on ? ~0u : 0u); }

private:
    static constexpr auto forced = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

    static osg::ref_ptr<osg::Program> additiveProgram() {
        osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::FRAGMENT, added_lamp::additive_frag));
        return program;
    }

    void setUpPass(int number) {
        const unsigned unit = static_cast<unsigned>(number) + 1; // 0 is the objects' own
        const bool first = number == 0;
        osg::StateSet& set = *_pass->getOrCreateStateSet();
        set.setMode(GL_LIGHT0 + static_cast<GLenum>(number), forced);
        set.setAttributeAndModes(new osg::Depth(first ? osg::Depth::LEQUAL : osg::Depth::EQUAL, 0.0, 1.0, first),
                                 forced);
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

    osg::ref_ptr<osg::Group> _node = new osg::Group, _pass = new osg::Group;
    osg::ref_ptr<osg::LightSource> _source = new osg::LightSource;
    osg::ref_ptr<osg::MatrixTransform> _box = new osg::MatrixTransform;
    osg::ref_ptr<osg::TexGenNode> _inMap = new osg::TexGenNode;
    std::unique_ptr<DepthPass> _map;
};

/// Spotlights on some things, the sum of their passes, and the view from one of them.
class AddedLamps {
public:
    /// @param count  1 … AddedLamp::most.
    AddedLamps(osg::Node& things, int count) {
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

    /// Lights that nothing but these may be added to: there is no ambient light beside theirs.
    osg::Group* node() { return _node; }
    AddedLamp& operator[](std::size_t i) { return _lamps[i]; }
    const AddedLamp& operator[](std::size_t i) const { return _lamps[i]; }

    /// Lets them be the lights of a group, too, whose shadows take away what passes leave out.
    void shineOn(ShadowCasterGroup& group) {
        for (AddedLamp& lamp : _lamps) {
            const auto number = static_cast<GLenum>(lamp.source()->getLight()->getLightNum());
            group.addLight(lamp.source());
            group.getOrCreateStateSet()->setMode(GL_LIGHT0 + number, osg::StateAttribute::ON);
        }
    }

    /// See DepthPass; all maps are drawn anew.
    void setMaps(bool fastCopy, bool displaced) {
        for (AddedLamp& lamp : _lamps) {
            lamp.map().setFastCopy(fastCopy);
            lamp.map().setDisplaced(displaced);
        }
    }

    /// "maps drawn: 1 1 4", how often each.
    std::string mapsDrawn() const {
        std::string text = "maps drawn:";
        for (const AddedLamp& lamp : _lamps) text += " " + std::to_string(lamp.map().drawn());
        return text;
    }

    /// Draws the passes, or nothing but the lamps.
    void showPasses(bool on) {
        for (AddedLamp& lamp : _lamps) lamp.showPass(on);
    }

    void showBoxes(bool on) { _boxes->setNodeMask(on ? ~0u : 0u); }
    /// Of depth at look-up, -1 … 1 from near to far.
    void setBias(float bias) { _bias->set(bias); }
    void setBicubic(bool on) { _bicubic->set(on); }
    /// Sees the things as from a lamp, in its light alone, without shadows, which are what it does not see.
    /// @param aspect  width to height.
    void lookFrom(const osg::Matrixd& view, double aspect) {
        _view->setViewMatrix(view);
        _view->setProjectionMatrixAsPerspective(AddedLamp::fieldOfView, aspect, AddedLamp::zNear, AddedLamp::zFar);
    }

    void showView(bool on) { _view->setNodeMask(on ? ~0u : 0u); }

private:
    void setUpView(osg::Node& casters) {
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

    osg::ref_ptr<osg::Group> _node = new osg::Group, _boxes = new osg::Group;
    osg::ref_ptr<osg::Camera> _view = new osg::Camera;
    osg::ref_ptr<osg::Uniform> _bias = new osg::Uniform("bias", 0.0f), _bicubic = new osg::Uniform("bicubic", false);
    std::deque<AddedLamp> _lamps;
};

} // namespace gnomon::examples
