// SPDX-License-Identifier: MIT
#include "Staging.h"
#include "SceneLights.h"

#include <osg/Geometry>
#include <osg/LightModel>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/NodeVisitor>
#include <osgUtil/SmoothingVisitor>

#include <array>

namespace gnomon::examples {
namespace {

osg::Vec4 grey(float level) { return {level, level, level, 1.0f}; }

osg::ref_ptr<osg::Material> white() {
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, grey(1.0f));
    material->setDiffuse(osg::Material::FRONT_AND_BACK, grey(1.0f));
    material->setSpecular(osg::Material::FRONT_AND_BACK, grey(0.0f));
    return material;
}

osg::ref_ptr<osg::StateSet> rootState(Look look) {
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity(grey(look == Look::SHADED ? shadedAmbient : 0.0f));
    state->setAttributeAndModes(model);
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    state->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    if (look == Look::VISIBILITY) {
        state->setAttributeAndModes(white());
        state->setMode(GL_NORMALIZE, osg::StateAttribute::ON); // or a scene under a scale is too dark to be judged
    }
    return state;
}

/// The way the light goes; a lamp's is towards `centre`.
osg::Vec3d directionOf(const osg::Vec4d& light, const osg::Vec3d& centre) {
    const osg::Vec3d place(light.x(), light.y(), light.z());
    osg::Vec3d way = light.w() == 0.0 ? -place : centre - place / light.w();
    way.normalize();
    return way;
}

using Attribute = osg::StateAttribute;

constexpr std::array<Attribute::Type, 8> shapeAttributes{
    Attribute::CULLFACE, Attribute::FRONTFACE, Attribute::POLYGONOFFSET, Attribute::ALPHAFUNC,
    Attribute::DEPTH,    Attribute::COLORMASK, Attribute::POLYGONMODE,   Attribute::PRIMITIVERESTARTINDEX};
constexpr std::array<GLenum, 5> shapeModes{GL_CULL_FACE, GL_ALPHA_TEST, GL_POLYGON_OFFSET_FILL, GL_DEPTH_TEST,
                                           GL_PRIMITIVE_RESTART};
constexpr unsigned clipPlanes = 6;

void keepAttribute(const osg::StateSet& from, Attribute::Type type, osg::StateSet& into, unsigned member = 0) {
    if (const osg::StateSet::RefAttributePair* pair = from.getAttributePair(type, member))
        into.setAttribute(pair->first, pair->second);
}

void keepAttributes(const osg::StateSet& from, osg::StateSet& into) {
    for (const Attribute::Type type : shapeAttributes) keepAttribute(from, type, into);
    for (const GLenum mode : shapeModes) into.setMode(mode, from.getMode(mode));
    for (unsigned plane = 0; plane < clipPlanes; ++plane) {
        keepAttribute(from, Attribute::CLIPPLANE, into, plane);
        into.setMode(GL_CLIP_PLANE0 + plane, from.getMode(GL_CLIP_PLANE0 + plane));
    }
}

/// Of a set that blends, with the material that has the alpha.
void keepBlending(const osg::StateSet& from, osg::StateSet& into) {
    for (const Attribute::Type type : {Attribute::BLENDFUNC, Attribute::MATERIAL}) keepAttribute(from, type, into);
    into.setMode(GL_BLEND, Attribute::ON);
    if (from.useRenderBinDetails()) into.setRenderBinDetails(from.getBinNumber(), from.getBinName());
}

void keepTexture(const osg::StateSet& from, osg::StateSet& into) {
    if (const osg::StateSet::RefAttributePair* pair = from.getTextureAttributePair(0, Attribute::TEXTURE))
        into.setTextureAttribute(0, pair->first, pair->second);
    into.setTextureMode(0, GL_TEXTURE_2D, from.getTextureMode(0, GL_TEXTURE_2D));
}

void keepMotion(const osg::StateSet& from, osg::StateSet& into) {
    if (from.getName() != movingState) return;
    keepAttribute(from, Attribute::PROGRAM, into);
    for (const auto& [name, uniform] : from.getUniformList()) into.addUniform(uniform.first, uniform.second);
}

class Whitener : public osg::NodeVisitor {
public:
    Whitener() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

    void apply(osg::Node& node) override {
        const bool before = _alphaTested;
        const osg::ref_ptr<const osg::StateSet> above = _texture;
        if (osg::StateSet* state = node.getStateSet()) node.setStateSet(shapeOf(*state));
        traverse(node);
        _alphaTested = before;
        _texture = above;
    }

    void apply(osg::Geometry& geometry) override {
        if (!geometry.getNormalArray()) osgUtil::SmoothingVisitor::smooth(geometry);
        apply(static_cast<osg::Node&>(geometry));
    }

private:
    osg::ref_ptr<osg::StateSet> shapeOf(const osg::StateSet& state) {
        osg::ref_ptr<osg::StateSet> shape = new osg::StateSet;
        keepAttributes(state, *shape);
        keepMotion(state, *shape);
        const Attribute::GLModeValue test = state.getMode(GL_ALPHA_TEST);
        if (!(test & Attribute::INHERIT)) _alphaTested = (test & Attribute::ON) != 0;
        _texture = textureBelow(state);
        const bool blends = (state.getMode(GL_BLEND) & Attribute::ON) != 0;
        if (blends) keepBlending(state, *shape);
        if (_alphaTested || blends) keepTexture(*_texture, *shape);
        return shape;
    }

    /// What is in force below `state`, which may leave it as it is above.
    osg::ref_ptr<const osg::StateSet> textureBelow(const osg::StateSet& state) const {
        osg::ref_ptr<osg::StateSet> own = new osg::StateSet, all = new osg::StateSet(*_texture);
        keepTexture(state, *own);
        all->merge(*own);
        return all;
    }

    bool _alphaTested = false;
    osg::ref_ptr<const osg::StateSet> _texture = new osg::StateSet; ///< in force, tested or not.
};

} // namespace

Staging::Staging(const ChartScene& scene, Look look)
    : _root(new osg::Group),
      _content(look == Look::SHADED ? scene.content : whiteCopy(*scene.content)),
      _light(new osg::Light(0)),
      _mount(new osg::MatrixTransform),
      _centre(scene.center),
      _look(look),
      _around(scene.around) {
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->setLight(_light);
    _mount->addChild(source);
    _root->addChild(_mount);
    _root->setStateSet(rootState(look));
    _light->setAmbient(grey(0.0f));
    setShining(true);
    Staging::setLight(scene.light);
}

osg::Vec4 Staging::background() const { return _look == Look::SHADED ? osg::Vec4(0.2f, 0.2f, 0.4f, 1.0f) : grey(0.0f); }

void Staging::setLight(const osg::Vec4d& light) {
    standLight(*_mount, *_light, light);
    _light->setDirection(osg::Vec3(directionOf(light, _centre)));
}

void Staging::setShining(bool shines) {
    const float level = !shines ? 0.0f : _look == Look::SHADED ? shadedDiffuse : 1.0f;
    _light->setDiffuse(grey(level));
    _light->setSpecular(grey(_look == Look::SHADED ? level : 0.0f));
}

PlainStaging::PlainStaging(const ChartScene& scene, Look look) : Staging(scene, look) { _root->addChild(_content); }

osg::ref_ptr<osg::Group> whiteCopy(const osg::Group& content) {
    const osg::CopyOp copy(osg::CopyOp::DEEP_COPY_NODES | osg::CopyOp::DEEP_COPY_DRAWABLES);
    osg::ref_ptr<osg::Group> result = osg::clone(&content, copy);
    Whitener whitener;
    result->accept(whitener);
    return result;
}

} // namespace gnomon::examples
